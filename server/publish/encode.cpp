#include "server/publish/encode.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "proto/frame.h"

namespace headrace::publish {

namespace {

std::string padded(std::string_view topic) {
    std::string bytes(topic.substr(0, proto::kTopicBytes));
    bytes.resize(proto::kTopicBytes, '\0');
    return bytes;
}

}  // namespace

zmq::message_t encode_capture(const Capture& capture, proto::FieldSet fields, const std::string& topic,
                              std::uint64_t session, std::uint64_t seq) {
    std::vector<proto::FrameColumn> columns;
    for (const Column& column : capture.columns)
        if (fields.contains(column.field))
            columns.push_back({column.field, column.dtype, column.components, {column.bytes.get(), column.size}});
    proto::FrameInfo info;
    info.topic = topic;
    info.dimensions = capture.dimensions;
    info.session = session;
    info.seq = seq;
    info.step = capture.step;
    info.time = capture.time;
    info.wall_clock = capture.wall_clock;
    info.particle_count = capture.particles;
    zmq::message_t message(proto::frame_size(columns));
    proto::encode_frame(info, columns, {static_cast<std::byte*>(message.data()), message.size()});
    return message;
}

zmq::message_t text_message(std::string_view topic, std::string_view json) {
    zmq::message_t message(proto::kTopicBytes + json.size());
    const std::string head = padded(topic);
    std::memcpy(message.data(), head.data(), head.size());
    std::memcpy(static_cast<char*>(message.data()) + head.size(), json.data(), json.size());
    return message;
}

bool matches(const std::string& subscription, std::string_view topic) {
    return padded(topic).starts_with(subscription);
}

}  // namespace headrace::publish
