// Recordings that were cut off, damaged, or made to deceive.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "proto/mcap.h"
#include "proto/recording.h"
#include "tests/support/frame_samples.h"
#include "tests/support/recording_samples.h"

using namespace headrace::proto;
using namespace headrace::test;

namespace {

// By the format's tables: opcode and length 9, channel 2, array length 4, one entry of 16 bytes.
constexpr std::uint64_t kMessageIndexBytes = 31;

std::string read_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

long peak_memory() {  // [KiB] of this process
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

void write_file(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

// How many of the frames lie wholly before `cut`, from the sizes that the writer reported.
std::size_t complete_frames(const std::vector<std::uint64_t>& sizes, std::uint64_t cut) {
    std::size_t count = 0;
    for (std::uint64_t size : sizes)
        if (size - kMessageIndexBytes <= cut) ++count;
    return count;
}

void check_cut_file(const std::filesystem::path& file, std::size_t expected) {
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    REQUIRE_FALSE((*reader)->summary().complete);
    REQUIRE((*reader)->frame_count() == expected);
    for (std::size_t k = 0; k < expected; ++k) check_frame(**reader, k, k + 1);
}

// Reads all there is: frames that come back must be true ones. Returns their number.
std::size_t read_all(const std::filesystem::path& file) {
    auto reader = RecordingReader::open(file);
    if (!reader) return 0;
    std::size_t good = 0;
    for (std::size_t k = 0; k < (*reader)->frame_count(); ++k) {
        auto frame = (*reader)->read_frame(k);
        if (!frame) continue;
        check_frame(**reader, k, frame->info.seq);
        ++good;
    }
    return good;
}

}  // namespace

TEST_CASE("RecordingDamage.ACutLosesNoCompleteFrame") {
    const TemporaryFolder folder;
    const auto compression = GENERATE(Compression::none, Compression::zstd);
    const auto file = folder.path / "a.mcap";
    const auto sizes = write_sample(file, 12, compression);
    const std::uint64_t size = std::filesystem::file_size(file);
    const std::string whole = read_file(file);
    const unsigned seed = 4711;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int k = 0; k < 200; ++k) {
        const std::uint64_t cut = 8 + random() % (size - 8);
        CAPTURE(cut);
        write_file(file, whole.substr(0, cut));
        check_cut_file(file, complete_frames(sizes, cut));
    }
}

TEST_CASE("RecordingDamage.ACutAtEveryByteIsReadable") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    const auto sizes = write_sample(file, 2);
    for (std::uint64_t cut = std::filesystem::file_size(file) - 1; cut >= 8; --cut) {
        std::filesystem::resize_file(file, cut);
        CAPTURE(cut);
        check_cut_file(file, complete_frames(sizes, cut));
    }
    std::filesystem::resize_file(file, 7);
    CHECK(RecordingReader::open(file).error().code == ErrorCode::parse_error);
}

TEST_CASE("RecordingDamage.ADamagedChunkLosesOnlyItself") {
    const TemporaryFolder folder;
    const auto compression = GENERATE(Compression::none, Compression::zstd);
    const bool is_cut = GENERATE(false, true);
    const auto file = folder.path / "a.mcap";
    const auto sizes = write_sample(file, 5, compression);
    std::string bytes = read_file(file);
    bytes[sizes[2] - kMessageIndexBytes - 40] ^= 1;  // within the third frame
    if (is_cut) bytes.resize(sizes[4]);
    write_file(file, bytes);

    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    if (is_cut) {
        REQUIRE((*reader)->frame_count() == 4);
        CHECK((*reader)->summary().damaged_bytes == sizes[2] - sizes[1] - kMessageIndexBytes);
        CHECK((*reader)->summary().gaps == 1);
        std::size_t index = 0;
        for (std::uint64_t seq : {1u, 2u, 4u, 5u}) check_frame(**reader, index++, seq);
    } else {
        REQUIRE((*reader)->frame_count() == 5);
        auto damaged = (*reader)->read_frame(2);
        REQUIRE_FALSE(damaged);
        CHECK(damaged.error().code == ErrorCode::parse_error);
        CHECK(damaged.error().path == file.string());
        CHECK(damaged.error().message.find("byte " + std::to_string(sizes[1])) != std::string::npos);
        for (std::uint64_t seq : {1u, 2u, 4u, 5u}) check_frame(**reader, seq - 1, seq);
    }
}

TEST_CASE("RecordingDamage.ReadingGoesOnBehindADamagedLength") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    const auto sizes = write_sample(file, 5);
    const std::string whole = read_file(file).substr(0, sizes[4]);
    // Byte 2 and byte 7 of the second chunk's length: too long within the file, and far beyond it. Then zeros over the
    // chunk's head and the index before it.
    for (const std::uint64_t at : {sizes[0] + 2, sizes[0] + 7, sizes[0]}) {
        std::string bytes = whole;
        bytes[at] ^= 0x04;
        if (at == sizes[0]) std::memset(bytes.data() + at - 20, 0, 100);
        write_file(file, bytes);
        auto reader = RecordingReader::open(file);
        REQUIRE(reader);
        REQUIRE((*reader)->frame_count() == 4);
        CHECK((*reader)->summary().damaged_bytes >= sizes[1] - sizes[0] - kMessageIndexBytes);
        CHECK((*reader)->summary().gaps == 1);
        std::size_t index = 0;
        for (std::uint64_t seq : {1u, 3u, 4u, 5u}) check_frame(**reader, index++, seq);
    }
}

TEST_CASE("RecordingDamage.AnyFlippedByteLosesAtMostOneFrame") {
    const TemporaryFolder folder;
    const auto compression = GENERATE(Compression::none, Compression::zstd);
    const bool is_cut = GENERATE(false, true);
    const auto file = folder.path / "a.mcap";
    const auto sizes = write_sample(file, 4, compression);
    std::string bytes = read_file(file);
    if (is_cut) bytes.resize(sizes.back());
    const unsigned seed = 99;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int k = 0; k < 500; ++k) {
        const std::size_t at = 8 + random() % (bytes.size() - 8);
        const std::string damaged_bytes = [&] {
            std::string copy = bytes;
            copy[at] = static_cast<char>(copy[at] ^ (1 + random() % 255));
            return copy;
        }();
        CAPTURE(at);
        write_file(file, damaged_bytes);
        const std::size_t profile_end = 8 + 9 + 4 + 8;  // a file of another profile is refused as a whole
        if (at >= profile_end) REQUIRE(read_all(file) >= 3);
    }
}

TEST_CASE("RecordingDamage.NoiseNeverCrashesTheReader") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    write_sample(file, 4, GENERATE(Compression::none, Compression::zstd));
    const std::string whole = read_file(file);
    const unsigned seed = 7;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int k = 0; k < 300; ++k) {
        std::string bytes = whole;
        for (int n = 0; n < 20; ++n) bytes[8 + random() % (bytes.size() - 8)] = static_cast<char>(random());
        if (k % 3 == 0) bytes.erase(8 + random() % 1000, random() % 500);
        write_file(file, bytes);
        CHECK(read_all(file) <= 4);
    }
}

TEST_CASE("RecordingDamage.ADamagedSummaryIsNotBelieved") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    write_sample(file, 2);
    const std::string whole = read_file(file);
    std::uint64_t start = 0;
    std::memcpy(&start, whole.data() + whole.size() - 8 - 20, sizeof(start));
    for (std::size_t at = start; at < whole.size(); ++at) {
        std::string bytes = whole;
        bytes[at] ^= 1;
        CAPTURE(at);
        write_file(file, bytes);
        auto reader = RecordingReader::open(file);
        REQUIRE(reader);
        REQUIRE_FALSE((*reader)->summary().complete);
        REQUIRE((*reader)->frame_count() == 2);
        REQUIRE((*reader)->frame_time(1) == Approx(0.02).epsilon(1e-12));
    }
}

// A summary with a right CRC whose numbers are not: the reader scans the file instead, or says so frame by frame.
TEST_CASE("RecordingDamage.ASummaryThatLiesIsNoDanger") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    write_sample(file, 4);
    const std::string whole = read_file(file);
    std::uint64_t start = 0;
    std::memcpy(&start, whole.data() + whole.size() - 8 - 20, sizeof(start));
    const unsigned seed = 11;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int k = 0; k < 500; ++k) {
        std::string bytes = whole;
        const std::size_t at = start + random() % (bytes.size() - 12 - start);
        bytes[at] = static_cast<char>(k % 2 == 0 ? 0xFF : bytes[at] ^ (1 << (random() % 8)));
        const std::uint32_t crc =
            mcap::crc32(std::as_bytes(std::span(bytes)).subspan(start, bytes.size() - 12 - start));
        std::memcpy(bytes.data() + bytes.size() - 12, &crc, sizeof(crc));
        write_file(file, bytes);
        CAPTURE(at);
        CHECK(read_all(file) <= 4);
    }
}

TEST_CASE("RecordingDamage.AClaimedSizeIsNotAllocated") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    const auto sizes = write_sample(file, 2, Compression::zstd);
    std::string bytes = read_file(file).substr(0, sizes[1]);
    // The uncompressed size of the second chunk: 3 GiB, of which nothing comes.
    const std::uint64_t claim = std::uint64_t{3} << 30;
    std::memcpy(bytes.data() + sizes[0] + 9 + 16, &claim, sizeof(claim));
    write_file(file, bytes);
    const long before = peak_memory();
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    CHECK((*reader)->frame_count() == 1);
    CHECK(peak_memory() - before < (1 << 20));  // 1 GiB: far above what reading needs, far below the claim
}

TEST_CASE("RecordingDamage.OtherFilesAreRefused") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    const auto refused = [&](const std::string& bytes, ErrorCode code) {
        write_file(file, bytes);
        auto reader = RecordingReader::open(file);
        REQUIRE_FALSE(reader);
        CHECK(reader.error().code == code);
        CHECK(reader.error().path == file.string());
    };
    refused("", ErrorCode::parse_error);
    refused("hello world, no recording", ErrorCode::parse_error);
    // The header of another program's file: profile "ros1", no library.
    const std::string magic(mcap::kMagic, 8);
    refused(magic + std::string("\x01\x0C\0\0\0\0\0\0\0\x04\0\0\0ros1\0\0\0\0", 21), ErrorCode::parse_error);
    CHECK(RecordingReader::open(folder.path / "none.mcap").error().code == ErrorCode::file_error);
    CHECK(RecordingReader::open(folder.path).error().code == ErrorCode::file_error);
}
