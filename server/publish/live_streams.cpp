#include "server/publish/live_streams.h"

#include <algorithm>

#include "server/publish/encode.h"

namespace headrace::publish {

using proto::Error;
using proto::ErrorCode;

proto::Result<proto::StreamOpenReply> LiveStreams::open(const proto::StreamOpen& request) {
    if (streams_.size() >= kMost)
        return Error{ErrorCode::limit_exceeded, "there are " + std::to_string(kMost) + " live streams already", "",
                     "stream.close some, or share one: a stream serves any number of subscribers"};
    const std::string topic = "frame/" + std::to_string(++opened_);
    Demand demand;
    demand.fields = request.fields;
    demand.precision = request.precision;
    demand.trigger = request.rate ? Trigger::rate : Trigger::every_steps;
    demand.interval = request.rate ? 1.0 / *request.rate : 0.0;
    demand.when_full = WhenFull::skip;
    demand.credits = 2;

    Stream stream;
    stream.request = request;
    stream.active = is_subscribed(topic);
    stream.demand = hub_.add(demand, stream.active);
    streams_.emplace(topic, stream);

    proto::StreamOpenReply reply;
    reply.stream = topic;
    reply.mode = proto::StreamMode::live;
    return reply;
}

proto::Result<proto::StreamCloseReply> LiveStreams::close(const std::string& stream) {
    const auto place = streams_.find(stream);
    if (place == streams_.end())
        return Error{ErrorCode::stream_not_found, "no stream \"" + stream + "\"", "params.stream",
                     "open one with stream.open"};
    hub_.remove(place->second.demand);
    const proto::StreamCloseReply reply{place->second.seq, place->second.seq};
    streams_.erase(place);
    return reply;
}

std::vector<proto::StreamState> LiveStreams::states() const {
    std::vector<proto::StreamState> states;
    for (const auto& [topic, stream] : streams_)
        states.push_back({topic, proto::StreamMode::live, stream.active, stream.seq, {}, {}});
    return states;
}

bool LiveStreams::drop(DemandId demand) {
    const auto place = std::find_if(streams_.begin(), streams_.end(),
                                    [&](const auto& entry) { return entry.second.demand == demand; });
    if (place == streams_.end()) return false;
    hub_.remove(demand);
    streams_.erase(place);
    return true;
}

bool LiveStreams::deliver(const CaptureFor& capture) {
    const auto place = std::find_if(streams_.begin(), streams_.end(),
                                    [&](const auto& entry) { return entry.second.demand == capture.demand; });
    if (place == streams_.end()) return false;
    auto& [topic, stream] = *place;
    if (stream.active)
        socket_.send(encode_capture(*capture.capture, stream.request.fields, topic, session_, ++stream.seq),
                     zmq::send_flags::dontwait);
    hub_.release(stream.demand);
    return true;
}

void LiveStreams::read_subscriptions() {
    zmq::message_t message;
    for (int k = 0; k < kMostPerTurn && socket_.recv(message, zmq::recv_flags::dontwait); ++k) {
        const std::string text = message.to_string();
        if (text.empty() || (text[0] != '\0' && text[0] != '\1')) continue;  // not a subscription
        const std::string prefix = text.substr(1);
        const bool subscribed = text[0] == '\1';
        if (subscribed)
            subscriptions_.insert(prefix);
        else
            subscriptions_.erase(prefix);
        for (auto& [topic, stream] : streams_) {
            if (!matches(prefix, topic)) continue;
            stream.active = is_subscribed(topic);
            hub_.set_active(stream.demand, stream.active);
            // Who joins late gets the present state at once, also while nothing runs.
            if (subscribed) hub_.request_frame(stream.demand);
        }
    }
}

bool LiveStreams::is_subscribed(const std::string& topic) const {
    return std::any_of(subscriptions_.begin(), subscriptions_.end(),
                       [&](const std::string& prefix) { return matches(prefix, topic); });
}

}  // namespace headrace::publish
