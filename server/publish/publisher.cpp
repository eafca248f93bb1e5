#include "server/publish/publisher.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>
#include <zmq.hpp>

#include "proto/messages_json.h"
#include "server/publish/data_socket.h"
#include "server/publish/encode.h"
#include "server/publish/live_streams.h"
#include "server/publish/lossless_streams.h"
#include "server/publish/recorder.h"

namespace headrace::publish {

using Clock = std::chrono::steady_clock;

namespace {

struct CommandLine {
    std::string json;
    double time{};  // [s]
};
struct Errand {
    server::Token token{};
    std::variant<PublisherRequest, CommandLine> what;
};

zmq::socket_t make_socket(zmq::context_t& context, zmq::socket_type type, const std::string& endpoint) {
    zmq::socket_t socket(context, type);
    socket.set(zmq::sockopt::linger, 0);
    socket.set(zmq::sockopt::affinity,
               std::uint64_t{2});  // not the I/O thread of the control socket: frames do not delay commands
    socket.set(zmq::sockopt::heartbeat_ivl, 5'000);
    socket.set(zmq::sockopt::heartbeat_timeout, 60'000);  // large transfers trip short ones
    if (endpoint.find('[') != std::string::npos) socket.set(zmq::sockopt::ipv6, true);
    return socket;
}

std::string listen(zmq::socket_t& socket, const std::string& endpoint) {
    try {
        socket.bind(endpoint);
    } catch (const zmq::error_t& error) {
        throw std::runtime_error("cannot listen on " + endpoint + ": " + error.what() +
                                 "; is another headraced running there? choose another --bind");
    }
    return socket.get(zmq::sockopt::last_endpoint);
}

}  // namespace

void tell_counts(PublisherCounts counts, proto::SimStatusReply& status) {
    status.streams = std::ssize(counts.readers);
    status.readers = std::move(counts.readers);
    status.recordings = static_cast<std::int64_t>(counts.recordings);
}

struct Publisher::Impl {
    Impl(zmq::context_t& context, const PublisherOptions& options, FrameHub& frame_hub, server::EventLog& event_log,
         const server::StatusBoard& status_board, server::ProbeBoard& probe_board, server::Outbox& replies)
        : hub(frame_hub),
          events(event_log),
          board(status_board),
          outbox(replies),
          events_socket(make_socket(context, zmq::socket_type::xpub, options.events_endpoint)),
          frames_socket(make_socket(context, zmq::socket_type::xpub, options.frames_endpoint)),
          data(make_socket(context, zmq::socket_type::router, options.data_endpoint)),
          live(hub, frames_socket, options.session),
          lossless(hub, data, options.session, events, board),
          recorder({hub, events, board, probe_board}, options.session, options.data_folder),
          data_socket(
              hub, data, lossless, board, options.session, static_cast<std::size_t>(options.soft_message_limit),
              [this] { deliver_captures(); }, [this] { refresh_counts(); }) {
        events_socket.set(zmq::sockopt::sndhwm, 10'000);
        events_socket.set(zmq::sockopt::xpub_verbose, true);
        // What subscribers send are topics.
        events_socket.set(zmq::sockopt::maxmsgsize, std::int64_t{1} << 16);
        frames_socket.set(zmq::sockopt::maxmsgsize, std::int64_t{1} << 16);
        frames_socket.set(zmq::sockopt::sndhwm, 2);
        frames_socket.set(zmq::sockopt::xpub_verbose, true);
        data.set(zmq::sockopt::router_mandatory, true);
        data.set(zmq::sockopt::sndhwm, 2'048);  // above the largest window
        data.set(zmq::sockopt::maxmsgsize, options.hard_message_limit);
        events_endpoint = listen(events_socket, options.events_endpoint);
        frames_endpoint = listen(frames_socket, options.frames_endpoint);
        data_endpoint = listen(data, options.data_endpoint);
        events.add_listener(hub.doorbell());
        probe_board.add_listener(hub.doorbell());
    }

    // ---- the thread -------------------------------------------------------------------------------------------------

    void run() {
        while (!stopping) {
            try {
                turn();
            } catch (const std::exception& problem) {
                report_problem(problem.what());
            }
        }
        try {
            say_goodbye();
        } catch (const std::exception& problem) {
            report_problem(problem.what());
        }
    }

    void turn() {
        wait();
        hub.doorbell().quiet();
        recorder.take_probes();
        deliver_captures();
        for (const DemandId id : hub.take_failed())
            fail_consumer(id, "a frame could not be kept: the window was full (on_stall: fail), or memory is short");
        run_errands();
        live.read_subscriptions();
        read_event_subscriptions();
        data_socket.read_requests();
        next_stall_check = lossless.check_stalls();
        refresh_counts();
        publish_events();
        publish_status();
    }

    void say_goodbye() {
        // The last words get a second to leave.
        data.set(zmq::sockopt::linger, 1'000);
        events_socket.set(zmq::sockopt::linger, 1'000);
        deliver_captures();
        run_errands();
        recorder.stop_all("because the server stops");
        publish_events();
        data_socket.read_requests();
        data_socket.refuse_waiting(
            {proto::ErrorCode::shutting_down, "the server is shutting down", "", "start it again"});
    }

    void report_problem(const char* what) noexcept {
        try {
            proto::Event event;
            event.type = "server.problem";
            event.message = std::string("publisher: ") + what;
            events.add(std::move(event));
        } catch (const std::exception&) {
            // No memory even for the report; the next turn may fare better.
        }
    }

    void wait() {
        zmq::pollitem_t items[] = {{nullptr, hub.doorbell().fd(), ZMQ_POLLIN, 0},
                                   {events_socket.handle(), 0, ZMQ_POLLIN, 0},
                                   {frames_socket.handle(), 0, ZMQ_POLLIN, 0},
                                   {data.handle(), 0, ZMQ_POLLIN, 0}};
        auto deadline = next_stall_check;
        if (is_status_wanted) deadline = std::min(deadline, next_status);
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        zmq::poll(items, std::size(items), std::max(left, std::chrono::milliseconds(0)));
    }

    void deliver_captures() {
        for (const CaptureFor& capture : hub.take()) {
            try {
                // Captures nobody claims belong to a consumer that has gone meanwhile.
                [[maybe_unused]] const bool claimed = live.deliver(capture) || lossless.deliver(capture) ||
                                                      recorder.deliver(capture) || data_socket.deliver(capture);
            } catch (const std::exception& problem) {
                fail_consumer(capture.demand, problem.what());
            }
        }
    }

    // A consumer that lost a frame is told so and ends: nothing is lost silently, and its credits hold nobody up.
    void fail_consumer(DemandId demand, const std::string& why) {
        if (live.drop(demand)) report_problem(("a live stream ended: " + why).c_str());
        lossless.fail(demand, why);
        recorder.fail(demand, why);
        data_socket.refuse(demand, {proto::ErrorCode::internal_error, why, "", "ask for fewer fields"});
    }

    void run_errands() {
        std::vector<Errand> todo;
        {
            const std::lock_guard lock(mutex);
            todo.swap(errands);
        }
        for (Errand& errand : todo) {
            if (const auto* line = std::get_if<CommandLine>(&errand.what)) {
                recorder.write_command(line->json, line->time);
                continue;
            }
            auto outcome = carry_out(std::get<PublisherRequest>(errand.what));
            refresh_counts();  // who reads the status after the reply sees the change
            outbox.put(errand.token, std::move(outcome));
        }
    }

    proto::Result<proto::Reply> carry_out(const PublisherRequest& wanted) {
        try {
            // What happened before the request comes before its effect: a recording that ends here has it all.
            recorder.take_probes();
            deliver_captures();
            publish_events();
            return std::visit([&](const auto& request) { return handle(request); }, wanted);
        } catch (const std::exception& problem) {
            return proto::Error{proto::ErrorCode::internal_error, problem.what(), "", ""};
        }
    }

    void refresh_counts() {
        recordings = static_cast<std::uint32_t>(recorder.size());
        if (live.size() + lossless.size() == 0 && !has_readers) return;
        std::vector<proto::StreamState> fresh = live.states();
        for (proto::StreamState& state : lossless.states()) fresh.push_back(std::move(state));
        has_readers = !fresh.empty();
        const std::lock_guard lock(readers_mutex);
        readers.swap(fresh);
    }

    PublisherCounts read_counts() const {
        const std::lock_guard lock(readers_mutex);
        return {recordings, readers};
    }

    template <class Reply>
    static proto::Result<proto::Reply> widen(proto::Result<Reply> result) {
        if (!result) return result.error();
        return proto::Reply(std::move(*result));
    }

    proto::Result<proto::Reply> handle(const proto::StreamOpen& request) { return widen(live.open(request)); }
    proto::Result<proto::Reply> handle(const proto::StreamAck& request) { return widen(lossless.ack(request)); }
    proto::Result<proto::Reply> handle(const proto::StreamClose& request) {
        return widen(lossless.has(request.stream) ? lossless.close(request.stream) : live.close(request.stream));
    }
    proto::Result<proto::Reply> handle(const proto::RecordStart& request) { return widen(recorder.start(request)); }
    proto::Result<proto::Reply> handle(const proto::RecordStop& request) {
        return widen(recorder.stop(request.recording));
    }

    // ---- events and status ------------------------------------------------------------------------------------------

    void publish_events() {
        const proto::EventsSinceReply news = events.since({published_seq, 0.0, {}, 1'000'000});
        published_seq = news.last_seq;
        for (const proto::Event& event : news.events) {
            recorder.write_event(event);
            const std::string topic = event.type.substr(0, event.type.find('.'));
            events_socket.send(text_message(topic, proto::event_text(event)), zmq::send_flags::dontwait);
        }
    }

    void read_event_subscriptions() {
        zmq::message_t message;
        for (int k = 0; k < kMostPerTurn && events_socket.recv(message, zmq::recv_flags::dontwait); ++k) {
            const std::string text = message.to_string();
            if (text.empty() || !matches(text.substr(1), "status")) continue;
            if (text[0] == '\1')
                status_subscriptions.insert(text.substr(1));
            else
                status_subscriptions.erase(text.substr(1));
        }
        is_status_wanted = !status_subscriptions.empty();
    }

    void publish_status() {
        const auto now = Clock::now();
        if (!is_status_wanted || now < next_status) return;
        next_status = now + std::chrono::seconds(1);
        proto::SimStatusReply status = board.read()->status;
        tell_counts(read_counts(), status);
        status.uptime_s = std::chrono::duration<double>(now - started).count();
        events_socket.send(text_message("status", proto::to_json(status).dump()), zmq::send_flags::dontwait);
    }

    FrameHub& hub;
    server::EventLog& events;
    const server::StatusBoard& board;
    server::Outbox& outbox;

    zmq::socket_t events_socket, frames_socket, data;
    std::string events_endpoint, frames_endpoint, data_endpoint;

    LiveStreams live;
    LosslessStreams lossless;
    Recorder recorder;
    DataSocket data_socket;

    const Clock::time_point started{Clock::now()};
    std::uint64_t published_seq{0};
    std::set<std::string> status_subscriptions;
    bool is_status_wanted{false};
    Clock::time_point next_status{};
    Clock::time_point next_stall_check{Clock::now() + std::chrono::hours(1)};

    // What others may ask for at any time.
    std::atomic<std::uint32_t> recordings{0};
    mutable std::mutex readers_mutex;
    std::vector<proto::StreamState> readers;
    bool has_readers{false};  // as last told; the publisher thread's

    std::mutex mutex;
    std::vector<Errand> errands;
    std::atomic<bool> stopping{false};
    std::thread thread;
};

Publisher::Publisher(zmq::context_t& context, const PublisherOptions& options, FrameHub& hub, server::EventLog& events,
                     const server::StatusBoard& board, server::ProbeBoard& probes, server::Outbox& outbox)
    : impl_(std::make_unique<Impl>(context, options, hub, events, board, probes, outbox)) {}

Publisher::~Publisher() {
    stop();
}

const std::string& Publisher::events_endpoint() const {
    return impl_->events_endpoint;
}
const std::string& Publisher::frames_endpoint() const {
    return impl_->frames_endpoint;
}
const std::string& Publisher::data_endpoint() const {
    return impl_->data_endpoint;
}

PublisherCounts Publisher::counts() const {
    return impl_->read_counts();
}

void Publisher::start() {
    impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
}

void Publisher::stop() {
    if (!impl_->thread.joinable()) return;
    impl_->stopping = true;
    impl_->hub.doorbell().ring();
    impl_->thread.join();
}

void Publisher::post(server::Token token, PublisherRequest request) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->errands.push_back({token, std::move(request)});
    }
    impl_->hub.doorbell().ring();
}

void Publisher::log_command(std::string json, double time) {
    if (impl_->recordings.load() == 0) return;
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->errands.push_back({0, CommandLine{std::move(json), time}});
    }
    impl_->hub.doorbell().ring();
}

}  // namespace headrace::publish
