#include "tests/support/server/client.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>

namespace headrace::test {

namespace {

Json request_json(std::string_view method, const Json& params) {
    return {{"jsonrpc", "2.0"}, {"method", method}, {"params", params}};
}

bool is_frame(const std::string& part) {
    return part.size() >= sizeof(proto::FrameHeader) && part.compare(proto::kTopicBytes, 8, proto::kFrameMagic, 8) == 0;
}

}  // namespace

const Json& Answer::result() const {
    if (!ok()) throw std::runtime_error("the server refused: " + message.dump());
    return message.at("result");
}

std::string Answer::error_name() const {
    return ok() ? "" : message.at("error").at("data").at("name").get<std::string>();
}

std::string Answer::hint() const {
    return ok() ? "" : message.at("error").at("data").value("hint", "");
}

std::string Answer::path() const {
    return ok() ? "" : message.at("error").at("data").value("path", "");
}

Peer::Peer(zmq::socket_type type, const std::string& endpoint) : socket_(context_, type) {
    socket_.set(zmq::sockopt::linger, 0);
    socket_.set(zmq::sockopt::sndhwm, 0);
    socket_.set(zmq::sockopt::rcvhwm, 0);
    socket_.connect(endpoint);
}

void Peer::send(std::string_view text) {
    send_parts({std::string(text)});
}

void Peer::send_parts(const std::vector<std::string>& parts) {
    for (std::size_t k = 0; k < parts.size(); ++k)
        socket_.send(zmq::buffer(parts[k]), k + 1 < parts.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
}

std::optional<std::vector<std::string>> Peer::try_receive_parts(Seconds patience) {
    zmq::pollitem_t item{socket_.handle(), 0, ZMQ_POLLIN, 0};
    if (zmq::poll(&item, 1, std::chrono::ceil<std::chrono::milliseconds>(patience)) == 0) return std::nullopt;
    std::vector<std::string> parts;
    zmq::message_t part;
    do {
        if (!socket_.recv(part)) throw std::runtime_error("a message broke off");
        parts.push_back(part.to_string());
    } while (part.more());
    return parts;
}

std::vector<std::string> Peer::receive_parts(std::string_view what, Seconds patience) {
    auto parts = try_receive_parts(patience);
    if (!parts)
        throw std::runtime_error("no " + std::string(what) + " within " + std::to_string(patience.count()) + " s");
    return *std::move(parts);
}

std::int64_t Client::post(std::string_view method, const Json& params) {
    Json request = request_json(method, params);
    request["id"] = ++last_id_;
    peer_.send(request.dump());
    return last_id_;
}

void Client::notify(std::string_view method, const Json& params) {
    peer_.send(request_json(method, params).dump());
}

void Client::take(std::vector<std::string> parts) {
    for (std::string& part : parts) {
        if (is_frame(part))
            frames_.push_back(std::move(part));
        else
            replies_.push_back({Json::parse(part)});
    }
}

Answer Client::await(std::int64_t id, Seconds patience) {
    const auto is_it = [id](const Answer& answer) { return answer.message.at("id") == id; };
    while (true) {
        const auto place = std::find_if(replies_.begin(), replies_.end(), is_it);
        if (place != replies_.end()) {
            Answer answer = std::move(*place);
            replies_.erase(place);
            return answer;
        }
        take(peer_.receive_parts("reply to request " + std::to_string(id), patience));
    }
}

bool Client::has_arrived(std::int64_t id) {
    while (auto parts = peer_.try_receive_parts(Seconds(0))) take(std::move(*parts));
    return std::any_of(replies_.begin(), replies_.end(),
                       [id](const Answer& answer) { return answer.message.at("id") == id; });
}

Answer Client::receive() {
    while (replies_.empty()) take(peer_.receive_parts("reply"));
    Answer answer = std::move(replies_.front());
    replies_.erase(replies_.begin());
    return answer;
}

bool Client::receive_in_order(const std::vector<std::int64_t>& ids) {
    return std::all_of(ids.begin(), ids.end(), [this](std::int64_t id) { return receive().message.at("id") == id; });
}

std::string Client::await_frame() {
    while (frames_.empty()) take(peer_.receive_parts("frame"));
    std::string frame = std::move(frames_.front());
    frames_.erase(frames_.begin());
    return frame;
}

Answer Client::ask(std::string_view method, const Json& params) {
    return await(post(method, params));
}

Json Client::call(std::string_view method, const Json& params) {
    return ask(method, params).result();
}

Answer Client::ask_raw(std::string_view text) {
    peer_.send(text);
    return receive();
}

Subscriber::Subscriber(const std::string& endpoint, std::string_view topic) : peer_(zmq::socket_type::sub, endpoint) {
    std::string padded(topic);
    if (!padded.empty()) padded.resize(proto::kTopicBytes, '\0');
    peer_.socket().set(zmq::sockopt::subscribe, padded);
}

std::string Subscriber::receive(std::string_view what) {
    return peer_.receive_parts(what).front();
}

std::optional<std::string> Subscriber::try_receive(Seconds patience) {
    auto parts = peer_.try_receive_parts(patience);
    if (!parts) return std::nullopt;
    return std::move(parts->front());
}

proto::FrameView frame_of(const std::string& message) {
    auto frame = proto::decode_frame(std::as_bytes(std::span(message)));
    if (!frame) throw std::runtime_error("bad frame: " + frame.error().message);
    return *std::move(frame);
}

}  // namespace headrace::test
