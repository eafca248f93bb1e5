// Small recordings for tests.
#pragma once

#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "proto/recording.h"
#include "tests/support/frame_samples.h"

namespace headrace::test {

// A folder of its own, removed at the end.
struct TemporaryFolder {
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "headrace_test_XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path path;
};

inline const proto::RecordingMetadata kSampleMetadata{R"({"headrace_scene":1,"name":"sample"})",
                                                      R"([{"name":"panel"}])", "0123456789abcdef", "headraced 0.0.0",
                                                      "clusters of 4 x 4"};

inline proto::Event sample_event(std::uint64_t seq, double time) {
    proto::Event event;
    event.seq = seq;
    event.type = "object.removed";
    event.step = 1;
    event.time = time;
    event.wall_clock = 1.7e9;
    event.message = "event " + std::to_string(seq);
    return event;
}

// A finished recording of frames 1 .. count; returns the file's size after each of them.
inline std::vector<std::uint64_t> write_sample(const std::filesystem::path& file, std::uint64_t count,
                                               proto::Compression compression = proto::Compression::none) {
    proto::RecordingOptions options;
    options.compression = compression;
    auto writer = proto::RecordingWriter::create(file, kSampleMetadata, options);
    REQUIRE(writer);
    std::vector<std::uint64_t> sizes;
    for (std::uint64_t seq = 1; seq <= count; ++seq) {
        REQUIRE((*writer)->write_frame(make_sample_frame(seq)));
        sizes.push_back((*writer)->bytes());
    }
    REQUIRE((*writer)->finish());
    return sizes;
}

// The frame at `index` is sample frame `seq`, to the last byte of its arrays.
inline void check_frame(proto::RecordingReader& reader, std::size_t index, std::uint64_t seq) {
    auto frame = reader.read_frame(index);
    REQUIRE(frame);
    REQUIRE(frame->info.seq == seq);
    const auto message = make_sample_frame(seq);
    auto expected = proto::decode_frame(message);
    REQUIRE(expected);
    REQUIRE(frame->columns.size() == expected->columns.size());
    for (std::size_t k = 0; k < frame->columns.size(); ++k) {
        const auto got = frame->columns[k].bytes;
        const auto want = expected->columns[k].bytes;
        REQUIRE(std::equal(got.begin(), got.end(), want.begin(), want.end()));
    }
}

}  // namespace headrace::test
