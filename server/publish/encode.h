// Capture -> wire bytes. Includes the ZeroMQ header: for the .cpp files of this folder only.
#pragma once

#include <cstdint>
#include <string>
#include <zmq.hpp>

#include "server/publish/frame_hub.h"

namespace headrace::publish {

// Messages read from one socket before the others get their turn: a flood starves nobody.
inline constexpr int kMostPerTurn = 100;

// One frame message with the chosen fields of a capture.
zmq::message_t encode_capture(const Capture& capture, proto::FieldSet fields, const std::string& topic,
                              std::uint64_t session, std::uint64_t seq);

// An event or status message: 16 bytes of topic, NUL-padded, then JSON text.
zmq::message_t text_message(std::string_view topic, std::string_view json);

// Does a subscription (a prefix of bytes) match a topic as it is sent, NUL-padded to 16 bytes?
bool matches(const std::string& subscription, std::string_view topic);

}  // namespace headrace::publish
