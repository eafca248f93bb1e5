#include "client/record.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "client/call.h"
#include "client/endpoints.h"
#include "client/probe_recording.h"
#include "client/text.h"
#include "proto/envelope.h"
#include "proto/recording.h"

namespace headrace::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kFirstSilence = 2s;  // without a frame during a run, before the stream is taken over anew
constexpr auto kLongestSilence = 60s;
constexpr auto kDrainPatience = 10s;  // without a frame while those still under way are awaited
constexpr std::int64_t kWindow = 64;  // asked for; the server grants less for large frames

proto::Result<proto::RecordingMetadata> collect_metadata(Connection& connection) {
    auto scene = connection.request("scene.get", proto::Json::object(), Patience::query);
    if (!scene) return scene.error();
    auto objects = call<proto::ObjectsListReply>(connection, "objects.list", proto::ObjectsList{});
    if (!objects) return objects.error();
    auto status = call<proto::SimStatusReply>(connection, "sim.status", proto::SimStatus{});
    if (!status) return status.error();
    const proto::HelloReply& hello = connection.hello();
    return proto::RecordingMetadata{scene->dump(), proto::objects_text(objects->objects), hello.session,
                                    hello.program + " " + hello.version, status->strategy.value_or("")};
}

}  // namespace

struct Recorder::Impl {
    Impl(Connection& server, RecordOptions wanted) : connection(server), options(std::move(wanted)) {}

    proto::Status attach(const proto::StreamOpen& request);
    proto::Status open_stream();
    void take_frame(std::span<const std::byte> message);
    void acknowledge();
    proto::Status close_stream();

    Connection& connection;
    RecordOptions options;
    std::unique_ptr<proto::RecordingWriter> writer;
    std::optional<ProbeRecording> probes;  // once the stream has told where the recording begins
    std::unique_ptr<RpcSocket> data;
    std::string stream;
    std::int64_t window{1};
    double first_time{};
    double end_time{std::numeric_limits<double>::infinity()};
    std::optional<double> last_time;
    std::uint64_t last_seq{0};  // received
    std::uint64_t acked{0};
    std::uint64_t events_seen{0};
    std::optional<proto::Error> failure;  // of the file
    Clock::time_point last_sign{Clock::now()};
    Clock::duration silence{kFirstSilence};
    bool is_closed{false};
};

// A fresh data socket with the stream on it.
proto::Status Recorder::Impl::attach(const proto::StreamOpen& request) {
    const auto endpoint = data_endpoint(connection.endpoint(), connection.hello());
    if (!endpoint) return endpoint.error();
    auto socket = RpcSocket::connect(*endpoint);
    if (!socket) return socket.error();
    data = *std::move(socket);
    const std::int64_t id = connection.next_id();
    data->send(proto::rpc_request_text(id, "stream.open", proto::to_json(request)));
    // The first frames may overtake the reply; they name their stream.
    auto result = connection.await_reply(*data, id, Patience::while_alive,
                                         [this](std::span<const std::byte> frame) { take_frame(frame); });
    if (!result) return result.error();
    auto reply = proto::from_json<proto::StreamOpenReply>(*result, "result");
    if (!reply) return reply.error();
    stream = reply->stream;
    window = std::max<std::int64_t>(1, reply->window);
    if (!request.resume) first_time = reply->time;
    last_sign = Clock::now();
    return proto::Done{};
}

proto::Status Recorder::Impl::open_stream() {
    proto::StreamOpen request;
    request.mode = proto::StreamMode::lossless;
    if (options.fields) request.fields = *options.fields;
    request.precision = options.precision;
    request.interval = options.interval;
    request.every_steps = options.every_steps;
    request.window = kWindow;
    return attach(request);
}

void Recorder::Impl::take_frame(std::span<const std::byte> message) {
    proto::FrameHeader header;
    std::memcpy(&header, message.data(), sizeof header);  // the socket hands on nothing shorter
    const std::string_view topic(header.topic, strnlen(header.topic, sizeof header.topic));
    if (!stream.empty() && topic != stream) return;
    last_sign = Clock::now();
    if (header.seq <= last_seq) return;  // sent again after a takeover
    last_seq = header.seq;
    last_time = header.time;
    silence = kFirstSilence;
    const double slack = 1e-9 * std::max(1.0, std::abs(end_time));  // times are sums of rounded time steps
    if (header.time > end_time + slack || failure) return;
    if (auto written = writer->write_frame(message); !written) failure = written.error();
    // Half a window at a time keeps the server sending without an answer to each frame.
    if (last_seq - acked >= static_cast<std::uint64_t>(std::max<std::int64_t>(1, window / 2))) acknowledge();
}

void Recorder::Impl::acknowledge() {
    if (acked == last_seq || stream.empty()) return;
    acked = last_seq;
    // A notification: nothing to wait for, and one that comes after the stream's end hurts nobody.
    const proto::Json ack{
        {"jsonrpc", "2.0"}, {"method", "stream.ack"}, {"params", proto::to_json(proto::StreamAck{stream, last_seq})}};
    data->send(ack.dump());
}

proto::Status Recorder::Impl::close_stream() {
    const std::int64_t id = connection.next_id();
    data->send(proto::rpc_request_text(id, "stream.close", proto::to_json(proto::StreamClose{stream})));
    const auto on_frame = [this](std::span<const std::byte> frame) {
        take_frame(frame);
        acknowledge();
    };
    auto result = connection.await_reply(*data, id, Patience::while_alive, on_frame);
    if (!result) return result.error();
    auto reply = proto::from_json<proto::StreamCloseReply>(*result, "result");
    if (!reply) return reply.error();
    last_sign = Clock::now();
    while (last_seq < reply->last_seq && !failure) {
        if (const auto received = data->receive(100ms); received && !received->frame.empty()) on_frame(received->frame);
        if (Clock::now() - last_sign > kDrainPatience)
            return proto::Error{proto::ErrorCode::connection_failed,
                                "the last " + plural(static_cast<std::int64_t>(reply->last_seq - last_seq), "frame") +
                                    " did not arrive",
                                options.file.string(), ""};
    }
    return proto::Done{};
}

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Recorder::~Recorder() {
    (void)close();
}

proto::Result<std::unique_ptr<Recorder>> Recorder::open(Connection& connection, const RecordOptions& options) {
    auto impl = std::make_unique<Impl>(connection, options);
    // Events are counted from here, before the objects are read: a change in between is told twice, never missed.
    proto::EventsSince now;
    now.types = {"server.started"};
    auto events = call<proto::EventsSinceReply>(connection, "events.since", now);
    if (!events) return events.error();
    impl->events_seen = events->last_seq;

    auto metadata = collect_metadata(connection);
    if (!metadata) return metadata.error();
    auto scene = proto::parse_scene(metadata->scene_json);
    if (!scene) return scene.error();
    if (!impl->options.fields) impl->options.fields = scene->output.fields;
    if (!impl->options.interval && !impl->options.every_steps) impl->options.interval = scene->output.interval;

    proto::RecordingOptions file_options;
    file_options.overwrite = options.overwrite;
    auto writer = proto::RecordingWriter::create(options.file, *metadata, file_options);
    if (!writer) return writer.error();
    impl->writer = *std::move(writer);
    if (auto opened = impl->open_stream(); !opened) {
        impl->writer.reset();
        std::error_code ignored;
        std::filesystem::remove(options.file, ignored);  // it holds no frame
        return opened.error();
    }
    impl->probes.emplace(connection, *impl->writer, impl->first_time);
    return std::unique_ptr<Recorder>(new Recorder(std::move(impl)));
}

proto::Status Recorder::receive(std::chrono::milliseconds patience) {
    const auto deadline = Clock::now() + patience;
    while (!impl_->failure) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
        const auto received = impl_->data->receive(std::max(left, 0ms));
        if (!received) break;
        if (!received->frame.empty()) impl_->take_frame(received->frame);
        if (left <= 0ms) break;
    }
    impl_->acknowledge();
    if (impl_->failure) return *impl_->failure;
    return proto::Done{};
}

proto::Status Recorder::take_events() {
    for (;;) {
        proto::EventsSince query;
        query.seq = impl_->events_seen;
        auto reply = call<proto::EventsSinceReply>(impl_->connection, "events.since", query);
        if (!reply) return reply.error();
        impl_->events_seen = reply->last_seq;
        for (const proto::Event& event : reply->events) {
            if (event.type == "status") continue;  // once a second, and the frames say the same
            if (auto written = impl_->writer->write_event(event); !written) return written.error();
            const auto failed = event.data.find("stream");
            const auto* name = failed != event.data.end() ? std::get_if<std::string>(&failed->second) : nullptr;
            if (event.type == "stream.failed" && name != nullptr && *name == impl_->stream)
                return proto::Error{proto::ErrorCode::timed_out, event.message, impl_->options.file.string(),
                                    "the file is complete up to there"};
        }
        if (reply->events.empty()) break;
    }
    return impl_->probes->take(impl_->end_time);
}

proto::Status Recorder::reattach_when_silent() {
    if (Clock::now() - impl_->last_sign < impl_->silence) return proto::Done{};
    // Waiting twice as long each time lets a frame through that takes longer than that.
    impl_->silence = std::min<Clock::duration>(2 * impl_->silence, kLongestSilence);
    proto::StreamOpen request;
    request.mode = proto::StreamMode::lossless;
    request.resume = impl_->stream;
    request.acked = impl_->last_seq;
    return impl_->attach(request);
}

void Recorder::set_last_time(double time) {
    impl_->end_time = time;
}

proto::Status Recorder::close() {
    if (impl_->is_closed) return proto::Done{};
    impl_->is_closed = true;
    auto closed = impl_->close_stream();
    auto events = take_events();
    auto finished = impl_->writer->finish();
    if (impl_->failure) return *impl_->failure;
    if (!closed) return closed.error();
    if (!events) return events.error();
    return finished;
}

proto::Status Recorder::abandon() {
    impl_->is_closed = true;
    return impl_->writer->finish();
}

std::uint64_t Recorder::frames() const {
    return impl_->writer->frames();
}
std::uint64_t Recorder::gaps() const {
    return impl_->writer->gaps();
}
double Recorder::first_time() const {
    return impl_->first_time;
}
std::optional<double> Recorder::last_time() const {
    return impl_->last_time;
}

std::string Recorder::summary() const {
    return recording_summary(frames(), gaps());
}

}  // namespace headrace::client
