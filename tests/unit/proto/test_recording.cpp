// Recordings written and read back whole. Cut, damaged and lying files: test_recording_damage.cpp.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>

#include "proto/recording.h"
#include "tests/support/frame_samples.h"
#include "tests/support/recording_samples.h"

using namespace headrace::proto;
using namespace headrace::test;

TEST_CASE("Recording.RoundTripKeepsEverything") {
    const TemporaryFolder folder;
    RecordingOptions options;
    options.compression = GENERATE(Compression::none, Compression::zstd);
    const auto file = folder.path / "a.mcap";
    auto writer = RecordingWriter::create(file, kSampleMetadata, options);
    REQUIRE(writer);
    for (std::uint64_t seq = 1; seq <= 5; ++seq) REQUIRE((*writer)->write_frame(make_sample_frame(seq)));
    REQUIRE((*writer)->write_event(sample_event(2, 0.03)));
    REQUIRE((*writer)->write_event(sample_event(1, 0.01)));
    REQUIRE((*writer)->write_command(R"({"method":"sim.pause"})", 0.02));
    REQUIRE((*writer)->finish());
    REQUIRE((*writer)->finish());
    CHECK((*writer)->frames() == 5);
    CHECK((*writer)->gaps() == 0);
    CHECK((*writer)->bytes() == std::filesystem::file_size(file));
    CHECK((*writer)->write_frame(make_sample_frame(6)).error().code == ErrorCode::file_error);

    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    const RecordingSummary& summary = (*reader)->summary();
    CHECK(summary.complete);
    CHECK(summary.damaged_bytes == 0);
    CHECK(summary.frames == 5);
    CHECK(summary.gaps == 0);
    CHECK(summary.first_time == Approx(0.01).epsilon(1e-12));
    CHECK(summary.last_time == Approx(0.05).epsilon(1e-12));
    CHECK(summary.metadata.scene_json == kSampleMetadata.scene_json);
    CHECK(summary.metadata.objects_json == kSampleMetadata.objects_json);
    CHECK(summary.metadata.session == kSampleMetadata.session);
    CHECK(summary.metadata.program == kSampleMetadata.program);
    CHECK(summary.metadata.strategy == kSampleMetadata.strategy);
    REQUIRE((*reader)->events().size() == 2);
    CHECK((*reader)->events()[0].seq == 1);
    CHECK((*reader)->events()[1].message == sample_event(2, 0.03).message);
    REQUIRE((*reader)->frame_count() == 5);
    for (std::uint64_t k : {4u, 0u, 2u, 1u, 3u}) check_frame(**reader, k, k + 1);
    CHECK((*reader)->frame_time(2) == Approx(0.03).epsilon(1e-12));
    CHECK((*reader)->read_frame(5).error().code == ErrorCode::file_error);
}

TEST_CASE("Recording.WithoutFramesIsARecording") {
    const TemporaryFolder folder;
    const auto file = folder.path / "empty.mcap";
    REQUIRE(RecordingWriter::create(file, kSampleMetadata, {}));  // finished by its destructor
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    CHECK((*reader)->summary().complete);
    CHECK((*reader)->frame_count() == 0);
    CHECK((*reader)->events().empty());
}

TEST_CASE("Recording.GapsAreCounted") {
    const TemporaryFolder folder;
    const bool is_finished = GENERATE(true, false);
    const auto file = folder.path / "a.mcap";
    auto writer = RecordingWriter::create(file, kSampleMetadata, {});
    REQUIRE(writer);
    for (std::uint64_t seq : {5u, 6u, 9u, 10u, 12u}) REQUIRE((*writer)->write_frame(make_sample_frame(seq)));
    CHECK((*writer)->gaps() == 2);
    if (is_finished) REQUIRE((*writer)->finish());
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    CHECK((*reader)->summary().complete == is_finished);
    CHECK((*reader)->summary().gaps == 2);
}

TEST_CASE("Recording.CanBeReadWhileItGrows") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    auto writer = RecordingWriter::create(file, kSampleMetadata, {});
    REQUIRE(writer);
    for (std::uint64_t seq = 1; seq <= 4; ++seq) {
        REQUIRE((*writer)->write_frame(make_sample_frame(seq)));
        REQUIRE((*writer)->write_event(sample_event(seq, 0.01)));
        auto reader = RecordingReader::open(file);
        REQUIRE(reader);
        CHECK_FALSE((*reader)->summary().complete);
        CHECK((*reader)->summary().damaged_bytes == 0);
        CHECK((*reader)->summary().metadata.scene_json == kSampleMetadata.scene_json);
        CHECK((*reader)->events().size() == seq);
        REQUIRE((*reader)->frame_count() == seq);
        check_frame(**reader, seq - 1, seq);
    }
}

TEST_CASE("Recording.SurvivesKill9") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    int ready[2];
    REQUIRE(::pipe(ready) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        auto writer = RecordingWriter::create(file, kSampleMetadata, {});
        bool is_good = writer.ok();
        for (std::uint64_t seq = 1; is_good && seq <= 3; ++seq)
            is_good = (*writer)->write_frame(make_sample_frame(seq)).ok() &&
                      (*writer)->write_event(sample_event(seq, 0.01)).ok();
        const char answer = is_good ? 'y' : 'n';
        if (::write(ready[1], &answer, 1) != 1) ::_exit(1);
        while (true) ::pause();
    }
    char answer = 'n';
    CHECK(::read(ready[0], &answer, 1) == 1);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    REQUIRE(answer == 'y');

    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    CHECK((*reader)->summary().frames == 3);
    CHECK((*reader)->events().size() == 3);
    CHECK_FALSE((*reader)->summary().complete);
    CHECK((*reader)->summary().damaged_bytes == 0);
}

TEST_CASE("Recording.ExistingFilesAreKeptUnlessAskedOtherwise") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    write_sample(file, 3);
    auto refused = RecordingWriter::create(file, kSampleMetadata, {});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().code == ErrorCode::file_error);
    CHECK(refused.error().path == file.string());
    CHECK(refused.error().hint.find("overwrit") != std::string::npos);
    CHECK((*RecordingReader::open(file))->frame_count() == 3);

    RecordingOptions options;
    options.overwrite = true;
    REQUIRE(RecordingWriter::create(file, kSampleMetadata, options));
    CHECK((*RecordingReader::open(file))->frame_count() == 0);
}

TEST_CASE("Recording.TwoWritersNeverShareAFile") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    auto first = RecordingWriter::create(file, kSampleMetadata, {});
    REQUIRE(first);
    REQUIRE((*first)->write_frame(make_sample_frame(1)));
    RecordingOptions options;
    options.overwrite = true;
    auto second = RecordingWriter::create(file, kSampleMetadata, options);
    REQUIRE_FALSE(second);
    CHECK(second.error().code == ErrorCode::file_error);
    REQUIRE((*first)->finish());
    CHECK((*RecordingReader::open(file))->frame_count() == 1);
}

TEST_CASE("Recording.FoldersAreNotCreated") {
    const TemporaryFolder folder;
    auto writer = RecordingWriter::create(folder.path / "none" / "a.mcap", kSampleMetadata, {});
    REQUIRE_FALSE(writer);
    CHECK(writer.error().code == ErrorCode::file_error);
    CHECK_FALSE(std::filesystem::exists(folder.path / "none"));
    CHECK_FALSE(RecordingWriter::create(folder.path, kSampleMetadata, {}));
    CHECK_FALSE(RecordingWriter::create("/dev/null", kSampleMetadata, {Compression::none, true}));
}

// A full disk is played by the limit of file size: write(2) takes a part, then fails.
TEST_CASE("Recording.FullDiskIsAnErrorAndTheFileStaysReadable") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    auto writer = RecordingWriter::create(file, kSampleMetadata, {});
    REQUIRE(writer);
    REQUIRE((*writer)->write_frame(make_sample_frame(1)));
    const std::uint64_t before = (*writer)->bytes();

    const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
    rlimit old_limit{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old_limit) == 0);
    const rlimit limit{before + 100, old_limit.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    const Status full = (*writer)->write_frame(make_sample_frame(2));
    ::setrlimit(RLIMIT_FSIZE, &old_limit);
    ::signal(SIGXFSZ, old_handler);

    REQUIRE_FALSE(full);
    CHECK(full.error().code == ErrorCode::file_error);
    CHECK(full.error().path == file.string());
    CHECK_FALSE(full.error().hint.empty());
    // Closed for good: what follows a lost frame must not look like a whole recording.
    CHECK_FALSE((*writer)->write_frame(make_sample_frame(3)));
    CHECK_FALSE((*writer)->write_event(sample_event(1, 0)));
    CHECK_FALSE((*writer)->finish());
    CHECK((*writer)->frames() == 1);
    CHECK(std::filesystem::file_size(file) == before);
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    REQUIRE((*reader)->frame_count() == 1);
    check_frame(**reader, 0, 1);
}

TEST_CASE("Recording.RefusesWhatIsNoFrame") {
    const TemporaryFolder folder;
    auto writer = RecordingWriter::create(folder.path / "a.mcap", kSampleMetadata, {});
    REQUIRE(writer);
    auto frame = make_sample_frame(1);
    frame.pop_back();
    CHECK((*writer)->write_frame(frame).error().code == ErrorCode::parse_error);
    CHECK((*writer)->write_frame({}).error().code == ErrorCode::parse_error);
    CHECK((*writer)->write_frame(make_sample_frame(1)));
    CHECK((*writer)->frames() == 1);
}

// Times that MCAP cannot say (it counts nanoseconds from 0) must not be undefined behaviour.
TEST_CASE("Recording.StrangeTimesAreClamped") {
    const TemporaryFolder folder;
    const auto file = folder.path / "a.mcap";
    auto writer = RecordingWriter::create(file, kSampleMetadata, {});
    REQUIRE(writer);
    for (const double time : {-1.0, 1e300, std::nan("")}) {
        auto frame = make_sample_frame(1);
        std::memcpy(frame.data() + 56, &time, sizeof(time));
        REQUIRE((*writer)->write_frame(frame));
    }
    REQUIRE((*writer)->finish());
    auto reader = RecordingReader::open(file);
    REQUIRE(reader);
    CHECK((*reader)->frame_time(0) == 0);
    CHECK((*reader)->frame_time(1) == Approx(9.2e9));
    CHECK((*reader)->frame_time(2) == 0);
}
