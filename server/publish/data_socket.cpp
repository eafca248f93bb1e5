#include "server/publish/data_socket.h"

#include <exception>
#include <utility>
#include <vector>

#include "proto/envelope.h"
#include "server/publish/encode.h"
#include "server/state_table.h"

namespace headrace::publish {

using proto::Error;
using proto::ErrorCode;

namespace {

constexpr std::size_t kMostWaiting = 64;

template <class Reply>
std::string reply_text(const std::string& id, const proto::Result<Reply>& result) {
    return result ? proto::rpc_result_text(id, proto::to_json(*result)) : proto::rpc_error_text(id, result.error());
}

}  // namespace

void DataSocket::read_requests() {
    zmq::message_t identity;
    for (int k = 0; k < kMostPerTurn && socket_.recv(identity, zmq::recv_flags::dontwait); ++k) {
        Peer peer{identity.to_string(), false};
        std::vector<zmq::message_t> parts;
        while (socket_.get(zmq::sockopt::rcvmore)) {
            parts.emplace_back();
            if (!socket_.recv(parts.back(), zmq::recv_flags::none)) break;
        }
        if (parts.size() > 1 && parts.front().size() == 0) {
            peer.has_delimiter = true;
            parts.erase(parts.begin());
        }
        if (parts.size() == 1)
            handle(peer, parts.front().to_string_view());
        else
            answer(peer, proto::rpc_error_text("null", {ErrorCode::invalid_request, "a request is one message part", "",
                                                        "send JSON in one part"}));
    }
}

void DataSocket::handle(const Peer& peer, std::string_view text) {
    std::string id = "null";
    try {
        const auto parsed = proto::parse_rpc_request(text, soft_limit_);
        if (const auto* refusal = std::get_if<proto::RpcRefusal>(&parsed))
            return answer(peer, proto::rpc_error_text(refusal->id, refusal->error));
        const auto& request = std::get<proto::RpcRequest>(parsed);
        id = request.id;
        carry_out(peer, request);
    } catch (const std::exception& problem) {
        answer(peer,
               proto::rpc_error_text(id, {ErrorCode::internal_error, problem.what(), "", "report this as a bug"}));
    }
}

void DataSocket::carry_out(const Peer& peer, const proto::RpcRequest& request) {
    // An acknowledgement may come as a notification: nothing is sent back then.
    const auto reply = [&](const std::string& message) {
        if (request.is_notification) return;
        told_();
        answer(peer, message);
    };
    const auto handled = [&]<class Message>(auto&& action) {
        const proto::Result<Message> message = proto::from_json<Message>(request.params, "params");
        if (message)
            action(*message);
        else
            reply(proto::rpc_error_text(request.id, message.error()));
    };

    if (request.method == "stream.ack") {
        handled.template operator()<proto::StreamAck>(
            [&](const proto::StreamAck& ack) { reply(reply_text(request.id, streams_.ack(ack))); });
    } else if (request.method == "stream.close") {
        handled.template operator()<proto::StreamClose>([&](const proto::StreamClose& close) {
            settle_();
            reply(reply_text(request.id, streams_.close(close.stream)));
        });
    } else if (request.method == "stream.open") {
        handled.template operator()<proto::StreamOpen>([&](const proto::StreamOpen& open) {
            if (open.mode != proto::StreamMode::lossless) {
                reply(proto::rpc_error_text(request.id,
                                            {ErrorCode::wrong_socket, "live streams are opened on the control socket",
                                             "params.mode", "use the control port, or mode lossless here"}));
                return;
            }
            const auto opened = streams_.open(open, peer);
            reply(reply_text(request.id, opened));
            if (opened) streams_.flush(opened->stream);
        });
    } else if (request.method == "frame.get") {
        if (request.is_notification) return;  // nobody to send the frame to
        handled.template operator()<proto::FrameGet>([&](const proto::FrameGet& get) {
            const auto now = board_.read();
            if (!now->scene) {
                reply(proto::rpc_error_text(
                    request.id, {ErrorCode::wrong_state, "no scene is loaded", "", "load a scene first (scene.load)"}));
                return;
            }
            if (waiting_.size() >= kMostWaiting) {
                reply(proto::rpc_error_text(request.id, {ErrorCode::busy, "too many frames are being waited for", "",
                                                         "wait for a reply, or open a stream"}));
                return;
            }
            Demand demand;
            demand.fields = get.fields;
            demand.precision = get.precision;
            demand.when_full = WhenFull::skip;
            waiting_.emplace(hub_.add(demand), WaitingFrame{get, peer, request.id});
        });
    } else {
        reply(proto::rpc_error_text(
            request.id,
            {ErrorCode::wrong_socket, "the data socket does not know \"" + request.method + "\"", "method",
             "here: frame.get, stream.open, stream.ack, stream.close; everything else on the control port"}));
    }
}

bool DataSocket::deliver(const CaptureFor& capture) {
    const auto place = waiting_.find(capture.demand);
    if (place == waiting_.end()) return false;
    // Encoded before it is taken from the list: should that fail, the request is still there to be refused.
    zmq::message_t frame = encode_capture(*capture.capture, place->second.request.fields, "frame.get", session_, 1);
    const WaitingFrame wanted = std::move(place->second);
    waiting_.erase(place);
    hub_.remove(capture.demand);
    const proto::FrameGetReply reply{capture.capture->step, capture.capture->time,
                                     static_cast<std::int64_t>(frame.size())};
    try {
        if (!send_head(wanted.peer)) return true;
        socket_.send(zmq::message_t(proto::rpc_result_text(wanted.id, proto::to_json(reply))),
                     zmq::send_flags::sndmore | zmq::send_flags::dontwait);
        socket_.send(frame, zmq::send_flags::dontwait);
    } catch (const zmq::error_t&) {
        // The peer has gone: nobody waits for the answer.
    }
    return true;
}

void DataSocket::refuse(DemandId demand, const Error& error) {
    const auto place = waiting_.find(demand);
    if (place == waiting_.end()) return;
    const WaitingFrame wanted = std::move(place->second);
    waiting_.erase(place);
    hub_.remove(demand);
    answer(wanted.peer, proto::rpc_error_text(wanted.id, error));
}

void DataSocket::refuse_waiting(const Error& error) {
    for (const auto& [demand, wanted] : std::exchange(waiting_, {})) {
        hub_.remove(demand);
        answer(wanted.peer, proto::rpc_error_text(wanted.id, error));
    }
}

bool DataSocket::send_head(const Peer& peer) {
    if (!socket_.send(zmq::buffer(peer.identity), zmq::send_flags::sndmore | zmq::send_flags::dontwait)) return false;
    if (peer.has_delimiter) socket_.send(zmq::message_t(), zmq::send_flags::sndmore | zmq::send_flags::dontwait);
    return true;
}

void DataSocket::answer(const Peer& peer, const std::string& text) {
    try {
        if (send_head(peer)) socket_.send(zmq::buffer(text), zmq::send_flags::dontwait);
    } catch (const zmq::error_t&) {
        // EHOSTUNREACH: the peer has gone.
    }
}

}  // namespace headrace::publish
