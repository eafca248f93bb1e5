#include "server/publish/lossless_streams.h"

#include <algorithm>
#include <utility>

#include "server/publish/encode.h"
#include "server/publish/report.h"

namespace headrace::publish {

using proto::Error;
using proto::ErrorCode;
using std::chrono::duration;

namespace {

Error no_such_stream(const std::string& stream, const char* path) {
    return {ErrorCode::stream_not_found, "no lossless stream \"" + stream + "\"", path,
            "it was closed, has failed, or belongs to an earlier session of the server; open a new one"};
}

// Bytes of a frame of so many particles, nearly: the header and the table are small beside them.
std::size_t frame_bytes(const proto::StreamOpen& request, std::int64_t particles) {
    std::size_t row = 0;
    for (const proto::FieldInfo& info : proto::kFields) {
        if (!request.fields.contains(info.field)) continue;
        const std::size_t real = request.precision == proto::Precision::f8 ? 8 : 4;
        row += info.is_integer ? 4 : real * (info.is_vector ? 3 : 1);
    }
    return row * static_cast<std::size_t>(particles);
}

// Large frames get a smaller window: what is kept for a resume stays bounded.
std::int64_t fitting_window(const proto::StreamOpen& request, std::size_t bytes) {
    const auto fit = static_cast<std::int64_t>(LosslessStreams::kMostWindowBytes / std::max<std::size_t>(1, bytes));
    return std::clamp<std::int64_t>(fit, 1, request.window);
}

}  // namespace

proto::Result<proto::StreamOpenReply> LosslessStreams::open(const proto::StreamOpen& request, const Peer& peer) {
    if (request.resume) return resume(request, peer);
    if (streams_.size() >= kMost)
        return Error{ErrorCode::limit_exceeded, "there are " + std::to_string(kMost) + " lossless streams already", "",
                     "stream.close some first"};
    Demand demand;
    demand.fields = request.fields;
    demand.precision = request.precision;
    demand.trigger = request.interval ? Trigger::interval : Trigger::every_steps;
    demand.interval = request.interval.value_or(0.0);
    demand.every_steps = request.every_steps.value_or(1);
    demand.when_full = request.on_stall == proto::OnStall::pause ? WhenFull::hold : WhenFull::fail;
    const auto now = board_.read();
    proto::StreamOpenReply reply;
    reply.stream = "data/" + std::to_string(++opened_);
    reply.mode = proto::StreamMode::lossless;
    reply.window = fitting_window(request, frame_bytes(request, now->status.particles));
    reply.step = now->status.step;
    reply.time = now->status.time;

    demand.credits = reply.window;
    Stream stream;
    stream.request = request;
    stream.peer = peer;
    stream.window = reply.window;
    stream.demand = hub_.add(demand);
    streams_.emplace(reply.stream, std::move(stream));
    report("stream.opened", reply.stream, "lossless stream opened");
    return reply;
}

proto::Result<proto::StreamOpenReply> LosslessStreams::resume(const proto::StreamOpen& request, const Peer& peer) {
    const auto place = streams_.find(*request.resume);
    if (place == streams_.end()) return no_such_stream(*request.resume, "params.resume");
    Stream& stream = place->second;
    const std::uint64_t acked = request.acked.value_or(stream.acked);
    if (acked < stream.acked || acked > stream.seq)
        return Error{ErrorCode::invalid_params,
                     "sequence number " + std::to_string(acked) + " is not between the last acknowledged " +
                         std::to_string(stream.acked) + " and the last sent " + std::to_string(stream.seq),
                     "params.acked", "give the last sequence number that arrived"};
    stream.peer = peer;
    stream.acked = acked;
    drop_acked(stream);
    stream.sent = acked;
    hub_.restart_hold(stream.demand);  // the new reader gets the whole stall time-out
    const auto now = board_.read();
    return proto::StreamOpenReply{
        place->first, proto::StreamMode::lossless, stream.window, acked + 1, now->status.step, now->status.time};
}

void LosslessStreams::flush(const std::string& stream) {
    const auto place = streams_.find(stream);
    if (place != streams_.end()) send_unsent(place->second);
}

proto::Result<proto::StreamAckReply> LosslessStreams::ack(const proto::StreamAck& request) {
    const auto place = streams_.find(request.stream);
    if (place == streams_.end()) return no_such_stream(request.stream, "params.stream");
    Stream& stream = place->second;
    if (request.seq > stream.seq)
        return Error{ErrorCode::invalid_params,
                     "sequence number " + std::to_string(request.seq) + " was not sent yet; the last is " +
                         std::to_string(stream.seq),
                     "params.seq", "acknowledge what has arrived"};
    stream.acked = std::max(stream.acked, request.seq);
    const proto::StreamAckReply reply{stream.acked};
    drop_acked(stream);
    if (stream.is_closing && stream.unacked.empty()) streams_.erase(place);
    // The peer takes messages again: so may its other streams.
    for (auto& [id, other] : streams_) send_unsent(other);
    return reply;
}

proto::Result<proto::StreamCloseReply> LosslessStreams::close(const std::string& name) {
    const auto place = streams_.find(name);
    if (place == streams_.end()) return no_such_stream(name, "params.stream");
    Stream& stream = place->second;
    hub_.remove(stream.demand);
    const proto::StreamCloseReply reply{stream.seq, stream.seq};
    if (!stream.is_closing) report("stream.closed", name, "lossless stream closed");
    stream.is_closing = true;
    stream.closed_at = Clock::now();
    if (stream.unacked.empty()) streams_.erase(place);
    return reply;
}

std::vector<proto::StreamState> LosslessStreams::states() const {
    std::vector<proto::StreamState> states;
    for (const auto& [topic, stream] : streams_)
        states.push_back({topic, proto::StreamMode::lossless, !stream.is_closing, stream.seq,
                          std::ssize(stream.unacked), stream.window});
    return states;
}

bool LosslessStreams::deliver(const CaptureFor& capture) {
    const auto place = std::find_if(streams_.begin(), streams_.end(),
                                    [&](const auto& entry) { return entry.second.demand == capture.demand; });
    if (place == streams_.end()) return false;
    auto& [topic, stream] = *place;
    Sent sent{++stream.seq, encode_capture(*capture.capture, stream.request.fields, topic, session_, stream.seq)};
    const std::int64_t window = fitting_window(stream.request, sent.message.size());
    if (window != stream.window) hub_.set_credits(stream.demand, stream.window = window);
    stream.unacked.push_back(std::move(sent));
    send_unsent(stream);
    return true;
}

// Sends what this peer has not got yet. A peer that is gone or full is left alone: acknowledgements and resumes come
// back here.
void LosslessStreams::send_unsent(Stream& stream) {
    for (Sent& sent : stream.unacked) {
        if (sent.seq <= stream.sent) continue;
        zmq::message_t copy;
        copy.copy(sent.message);  // shares the bytes
        try {
            if (!socket_.send(zmq::buffer(stream.peer.identity), zmq::send_flags::sndmore | zmq::send_flags::dontwait))
                return;
            if (stream.peer.has_delimiter)
                socket_.send(zmq::message_t(), zmq::send_flags::sndmore | zmq::send_flags::dontwait);
            if (!socket_.send(copy, zmq::send_flags::dontwait)) return;
        } catch (const zmq::error_t&) {
            return;  // EHOSTUNREACH: waits for a resume, or for its time-out
        }
        stream.sent = sent.seq;
    }
}

void LosslessStreams::drop_acked(Stream& stream) {
    std::int64_t released = 0;
    while (!stream.unacked.empty() && stream.unacked.front().seq <= stream.acked) {
        stream.unacked.pop_front();
        ++released;
    }
    if (released == 0) return;
    stream.stall_reported = false;
    stream.closed_at = Clock::now();
    hub_.release(stream.demand, released);
}

bool LosslessStreams::fail(DemandId demand, const std::string& why) {
    const auto place = std::find_if(streams_.begin(), streams_.end(),
                                    [&](const auto& entry) { return entry.second.demand == demand; });
    if (place == streams_.end()) return false;
    if (!place->second.is_closing) fail(place, why);
    return true;
}

std::chrono::steady_clock::time_point LosslessStreams::check_stalls() {
    constexpr auto kReportAfter = std::chrono::seconds(1);
    constexpr auto kRetryAfter = std::chrono::milliseconds(100);  // what a full or absent peer did not take
    const Clock::time_point now = Clock::now();
    Clock::time_point next = now + std::chrono::hours(1);
    for (auto place = streams_.begin(); place != streams_.end();) {
        Stream& stream = place->second;
        const auto current = place++;
        if (stream.sent < stream.seq && now >= stream.retry_at) {
            stream.retry_at = now + kRetryAfter;
            send_unsent(stream);
        }
        if (stream.sent < stream.seq) next = std::min(next, std::max(stream.retry_at, now + kRetryAfter));
        const auto since = stream.is_closing ? std::optional(stream.closed_at) : hub_.holding_since(stream.demand);
        if (!since) continue;
        const auto deadline =
            *since + std::chrono::duration_cast<Clock::duration>(duration<double>(stream.request.stall_timeout));
        if (now >= deadline) {
            fail(current, "no acknowledgement for " + std::to_string(stream.request.stall_timeout) + " s");
            continue;
        }
        if (!stream.is_closing && !stream.stall_reported && now >= *since + kReportAfter) {
            stream.stall_reported = true;
            report("stream.stalled", current->first, "the run waits for acknowledgements of this stream");
        }
        const bool may_report = !stream.is_closing && !stream.stall_reported;
        next = std::min({next, deadline, may_report ? *since + kReportAfter : deadline});
    }
    return next;
}

void LosslessStreams::fail(std::map<std::string, Stream>::iterator place, const std::string& why) {
    hub_.remove(place->second.demand);
    if (!place->second.is_closing || !place->second.unacked.empty())
        report("stream.failed", place->first,
               why + "; frames after " + std::to_string(place->second.acked) + " may be lost");
    streams_.erase(place);
}

void LosslessStreams::report(const std::string& type, const std::string& stream, const std::string& message) const {
    publish::report(events_, board_, type, message, {{"stream", stream}});
}

}  // namespace headrace::publish
