// Frames with values that anyone can recompute: particle i, component c, frame number s (all exact in 32 bits)
//   id i | position i + c/4 + s | velocity c + 1/2 - i | density 1000 + i | pressure 10 i - s
#pragma once

#include <cstring>
#include <string_view>
#include <vector>

#include "proto/frame.h"

namespace headrace::test {

inline double sample_value(proto::Field field, std::size_t i, int c, std::uint64_t s) {
    const auto row = static_cast<double>(i);
    const auto frame = static_cast<double>(s);
    switch (field) {
        case proto::Field::id:
            return row;
        case proto::Field::position:
            return row + 0.25 * c + frame;
        case proto::Field::velocity:
            return c + 0.5 - row;
        case proto::Field::density:
            return 1000 + row;
        case proto::Field::pressure:
            return 10 * row - frame;
        default:
            return 0;
    }
}

struct SampleShape {
    std::size_t particles{10};
    int dimensions{3};
    std::string_view dtype{"<f4"};  // of all but the ids
    proto::FieldSet fields{proto::kDefaultFields};
};

// The message of frame number `seq`, 10 ms of simulated time apart.
inline std::vector<std::byte> make_sample_frame(std::uint64_t seq, const SampleShape& shape = {}) {
    std::vector<std::vector<std::byte>> arrays;
    std::vector<proto::FrameColumn> columns;
    arrays.reserve(proto::kFieldCount);
    for (const proto::FieldInfo& info : proto::kFields) {
        if (!shape.fields.contains(info.field)) continue;
        const std::string_view dtype = info.is_integer ? "<u4" : shape.dtype;
        const int components = info.is_vector ? shape.dimensions : 1;
        auto& array = arrays.emplace_back();
        const auto put = [&array](auto value) {
            const auto* bytes = reinterpret_cast<const std::byte*>(&value);
            array.insert(array.end(), bytes, bytes + sizeof(value));
        };
        for (std::size_t i = 0; i < shape.particles; ++i)
            for (int c = 0; c < components; ++c) {
                const double value = sample_value(info.field, i, c, seq);
                if (dtype == "<u4") put(static_cast<std::uint32_t>(value));
                if (dtype == "<f4") put(static_cast<float>(value));
                if (dtype == "<f8") put(value);
            }
        columns.push_back({info.field, dtype, components, array});
    }
    proto::FrameInfo info;
    info.topic = "sample";
    info.dimensions = shape.dimensions;
    info.session = 0x0123456789abcdef;
    info.seq = seq;
    info.step = 100 * seq;
    info.time = 0.01 * static_cast<double>(seq);
    info.wall_clock = 1.7e9 + static_cast<double>(seq);
    info.particle_count = shape.particles;
    std::vector<std::byte> message(proto::frame_size(columns), std::byte{0xAA});
    proto::encode_frame(info, columns, message);
    return message;
}

}  // namespace headrace::test
