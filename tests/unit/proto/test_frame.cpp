#include <zlib.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <random>

#include "proto/frame.h"
#include "tests/support/frame_samples.h"

using namespace headrace::proto;
using headrace::test::make_sample_frame;
using headrace::test::sample_value;
using headrace::test::SampleShape;
using Message = std::vector<std::byte>;

namespace {

template <class T>
T read_at(const Message& message, std::size_t offset) {
    T value;
    std::memcpy(&value, message.data() + offset, sizeof(value));
    return value;
}

template <class T>
void write_at(Message& message, std::size_t offset, T value) {
    std::memcpy(message.data() + offset, &value, sizeof(value));
}

// Makes the CRC right again after a change, by the definition in frame.h.
void sign(Message& message) {
    const auto* bytes = reinterpret_cast<const Bytef*>(message.data());
    uLong crc = crc32(0, bytes, 124);
    crc = crc32(crc, bytes + 128, static_cast<uInt>(message.size() - 128));
    write_at(message, 124, static_cast<std::uint32_t>(crc));
}

void check_values(const FrameView& view, const SampleShape& shape, std::uint64_t seq) {
    for (const FieldInfo& info : kFields) {
        const FrameColumn* column = view.find(info.field);
        REQUIRE((column != nullptr) == shape.fields.contains(info.field));
        if (column == nullptr) continue;
        CHECK(column->components == (info.is_vector ? shape.dimensions : 1));
        CHECK(column->dtype == (info.is_integer ? "<u4" : shape.dtype));
        for (std::size_t i = 0; i < shape.particles; ++i)
            for (int c = 0; c < column->components; ++c)
                REQUIRE(FrameView::value(*column, i, c) == sample_value(info.field, i, c, seq));
    }
}

}  // namespace

TEST_CASE("Frame.RoundTripKeepsEveryValue") {
    SampleShape shape;
    shape.dimensions = GENERATE(2, 3);
    shape.dtype = GENERATE("<f4", "<f8");
    shape.particles = GENERATE(0u, 1u, 17u, 64u);
    shape.fields = GENERATE(kDefaultFields, FieldSet{Field::position}, FieldSet{Field::id, Field::acceleration});
    const Message message = make_sample_frame(7, shape);
    auto view = decode_frame(message);
    REQUIRE(view);
    CHECK(view->info.topic == "sample");
    CHECK(view->info.dimensions == shape.dimensions);
    CHECK(view->info.session == 0x0123456789abcdefu);
    CHECK(view->info.seq == 7);
    CHECK(view->info.step == 700);
    CHECK(view->info.time == 0.07);
    CHECK(view->info.wall_clock == 1.7e9 + 7);
    CHECK(view->info.particle_count == shape.particles);
    check_values(*view, shape, 7);
}

TEST_CASE("Frame.BytesStandWhereTheTableSays") {
    const Message message = make_sample_frame(3);
    CHECK(std::memcmp(message.data(), "sample\0\0\0\0\0\0\0\0\0\0HRFRAME1", 24) == 0);
    CHECK(read_at<std::uint16_t>(message, 24) == 1);    // version
    CHECK(read_at<std::uint16_t>(message, 26) == 3);    // dimensions
    CHECK(read_at<std::uint32_t>(message, 28) == 5);    // fields
    CHECK(read_at<std::uint64_t>(message, 40) == 3);    // seq
    CHECK(read_at<std::uint64_t>(message, 48) == 300);  // step
    CHECK(read_at<double>(message, 56) == 0.03);
    CHECK(read_at<std::uint64_t>(message, 72) == 10);  // particles
    CHECK(read_at<std::uint64_t>(message, 80) == message.size());
    // Second entry of the table: the position.
    CHECK(std::memcmp(message.data() + 192, "position\0\0\0\0\0\0\0\0<f4\0\0\0\0", 24) == 0);
    CHECK(read_at<std::uint16_t>(message, 216) == 3);
    CHECK(read_at<std::uint64_t>(message, 232) == 10 * 3 * 4);
    CHECK(read_at<double>(message, 240) == 1.0);  // scale
    CHECK(read_at<double>(message, 248) == 0.0);  // bias
}

TEST_CASE("Frame.ArraysStartAtMultiplesOf64WithZeroPadding") {
    const Message message = make_sample_frame(1);  // written over bytes 0xAA
    std::size_t end = 128 + 5 * 64;
    for (std::size_t k = 0; k < 5; ++k) {
        const auto offset = read_at<std::uint64_t>(message, 128 + 64 * k + 32);
        CHECK(offset % 64 == 0);
        REQUIRE(offset - end < 64);
        for (; end < offset; ++end) REQUIRE(message[end] == std::byte{0});
        end = offset + read_at<std::uint64_t>(message, 128 + 64 * k + 40);
    }
    CHECK(end == message.size());
}

TEST_CASE("Frame.DecodesAtAnyAddress") {
    const SampleShape shape{9, 3, "<f8", kDefaultFields};
    const Message message = make_sample_frame(2, shape);
    for (std::size_t shift = 0; shift < 8; ++shift) {
        Message moved(message.size() + shift);
        std::memcpy(moved.data() + shift, message.data(), message.size());
        auto view = decode_frame(std::span(moved).subspan(shift));
        REQUIRE(view);
        check_values(*view, shape, 2);
    }
}

TEST_CASE("Frame.TruncatedAtAnyByteIsAnError") {
    const Message message = make_sample_frame(1);
    for (std::size_t size = 0; size < message.size(); ++size) {
        const Message cut(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(size));
        auto view = decode_frame(cut);
        REQUIRE_FALSE(view);
        REQUIRE(view.error().code == ErrorCode::parse_error);
        REQUIRE(view.error().message.find("byte ") != std::string::npos);
    }
    Message longer = message;
    longer.push_back(std::byte{0});
    CHECK_FALSE(decode_frame(longer));
}

TEST_CASE("Frame.AnyFlippedByteIsAnError") {
    const Message message = make_sample_frame(1);
    const unsigned seed = 20100915;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int k = 0; k < 2000; ++k) {
        Message damaged = message;
        const std::size_t at = random() % message.size();
        damaged[at] ^= static_cast<std::byte>(1 + random() % 255);
        CAPTURE(at);
        REQUIRE_FALSE(decode_frame(damaged));
    }
}

TEST_CASE("Frame.LiesWithARightCrcAreErrors") {
    const Message good = make_sample_frame(1);
    const std::size_t entry = 128 + 64;  // position
    const auto refused_at = [&](std::size_t byte, auto change) {
        Message message = good;
        change(message);
        sign(message);
        auto view = decode_frame(message);
        REQUIRE_FALSE(view);
        CAPTURE(view.error().message);
        CHECK(view.error().message.find("byte " + std::to_string(byte) + ":") != std::string::npos);
    };
    constexpr std::uint64_t kHuge = ~std::uint64_t{0};
    using u16 = std::uint16_t;
    using u64 = std::uint64_t;
    refused_at(24, [](Message& m) { write_at(m, 24, u16{2}); });
    refused_at(26, [](Message& m) { write_at(m, 26, u16{4}); });
    refused_at(28, [](Message& m) { write_at(m, 28, std::uint32_t{0xFFFFFFFF}); });
    refused_at(56, [](Message& m) { write_at(m, 56, std::nan("")); });
    refused_at(80, [](Message& m) { write_at(m, 80, u64{1}); });
    refused_at(entry + 16, [&](Message& m) { std::memcpy(m.data() + entry + 16, "<u4", 3); });
    refused_at(entry + 24, [&](Message& m) { write_at(m, entry + 24, u16{0}); });
    refused_at(entry + 24, [&](Message& m) { write_at(m, entry + 24, u16{2}); });
    refused_at(entry + 26, [&](Message& m) { write_at(m, entry + 26, u16{1}); });
    refused_at(entry + 32, [&](Message& m) { write_at(m, entry + 32, kHuge - 63); });
    refused_at(entry + 32, [&](Message& m) { write_at(m, entry + 32, u64{64}); });
    refused_at(entry + 32, [&](Message& m) { write_at(m, entry + 32, read_at<u64>(m, entry + 32) + 4); });
    refused_at(entry + 40, [&](Message& m) { write_at(m, entry + 40, kHuge); });
    refused_at(entry + 40, [&](Message& m) { write_at(m, entry + 40, u64{116}); });
    refused_at(entry + 48, [&](Message& m) { write_at(m, entry + 48, 2.0); });
    // Counts whose product with the row size wraps around to the true size; the first field notices.
    refused_at(128 + 40, [](Message& m) { write_at(m, 72, kHuge); });
    refused_at(128 + 40, [](Message& m) { write_at(m, 72, (u64{1} << 62) + 10); });
    // An array whose offset plus size wraps around to lie within the frame.
    refused_at(128 + 40, [](Message& m) {
        write_at(m, 72, (kHuge - 63) / 4);
        write_at(m, 128 + 40, kHuge - 63);
    });
    refused_at(entry, [&](Message& m) { std::memcpy(m.data() + entry, m.data() + 128, 64); });
}

TEST_CASE("Frame.UnknownFieldsAreSkipped") {
    Message message = make_sample_frame(1);
    std::memcpy(message.data() + 128 + 64, "vorticity\0", 10);
    std::memcpy(message.data() + 128 + 64 + 16, "<f2", 3);
    sign(message);
    auto view = decode_frame(message);
    REQUIRE(view);
    CHECK(view->columns.size() == 4);
    CHECK(view->find(Field::position) == nullptr);
    const FrameColumn* density = view->find(Field::density);
    REQUIRE(density != nullptr);
    CHECK(FrameView::value(*density, 9, 0) == 1009);
}
