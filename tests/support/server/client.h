// Small peers of the server's sockets. Every wait is bounded and says what it waited for.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <zmq.hpp>

#include "proto/frame.h"

namespace headrace::test {

using Json = nlohmann::ordered_json;
using Seconds = std::chrono::duration<double>;

// Long enough for a loaded machine and sanitizers; only a failing test ever waits so long.
inline constexpr Seconds kPatience{60.0};

// A JSON-RPC reply.
struct Answer {
    Json message;

    bool ok() const { return message.contains("result"); }
    const Json& result() const;      // throws with the whole message when it is an error
    std::string error_name() const;  // "" when it is a result
    std::string hint() const;
    std::string path() const;
    std::int64_t id() const { return message.at("id").get<std::int64_t>(); }
};

// A socket of ours towards one endpoint of the server.
class Peer {
  public:
    Peer(zmq::socket_type type, const std::string& endpoint);

    void send(std::string_view text);
    void send_parts(const std::vector<std::string>& parts);
    std::vector<std::string> receive_parts(std::string_view what, Seconds patience = kPatience);
    std::optional<std::vector<std::string>> try_receive_parts(Seconds patience);
    zmq::socket_t& socket() { return socket_; }

  private:
    zmq::context_t context_{1};
    zmq::socket_t socket_;
};

// Speaks JSON-RPC on the control or the data socket.
class Client {
  public:
    explicit Client(const std::string& endpoint, zmq::socket_type type = zmq::socket_type::dealer)
        : peer_(type, endpoint) {}

    // One request and its reply; other replies that come meanwhile are kept for `await`.
    Answer ask(std::string_view method, const Json& params = Json::object());
    Json call(std::string_view method, const Json& params = Json::object());  // throws when it is an error

    std::int64_t post(std::string_view method, const Json& params = Json::object());  // returns the id
    void notify(std::string_view method, const Json& params = Json::object());
    Answer await(std::int64_t id, Seconds patience = kPatience);
    bool has_arrived(std::int64_t id);                            // without waiting
    Answer receive();                                             // the next reply, whatever its id
    bool receive_in_order(const std::vector<std::int64_t>& ids);  // are these the next replies?

    Answer ask_raw(std::string_view text);  // sends the bytes as they are, returns the next reply
    Peer& peer() { return peer_; }

    // Frames that came on this socket besides replies (data socket), oldest first.
    std::string await_frame();

  private:
    void take(std::vector<std::string> parts);

    Peer peer_;
    std::int64_t last_id_{0};
    std::vector<Answer> replies_;
    std::vector<std::string> frames_;
};

// Subscribed to one topic, NUL-padded, or to all ("").
class Subscriber {
  public:
    Subscriber(const std::string& endpoint, std::string_view topic);
    std::string receive(std::string_view what = "a message");  // whole message
    std::optional<std::string> try_receive(Seconds patience);

  private:
    Peer peer_;
};

// Asks again and again (each time a round trip to the server) until it is so; false after kPatience.
template <class Question>
bool eventually(Question is_so) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!is_so())
        if (std::chrono::steady_clock::now() > end) return false;
    return true;
}

// Decodes and checks a frame; the view points into `message`.
proto::FrameView frame_of(const std::string& message);

}  // namespace headrace::test
