// Writes a recording for readers that are not ours.
// Usage: write_sample_recording FILE.mcap [none|zstd] [FRAME.bin]
// 20 frames of 10 particles (tests/support/frame_samples.h), 3 events, 1 command; FRAME.bin gets frame 7 alone.
#include <cstdio>
#include <fstream>
#include <string>

#include "proto/recording.h"
#include "tests/support/frame_samples.h"

using namespace headrace;

namespace {

proto::Status write_all(proto::RecordingWriter& writer) {
    for (std::uint64_t seq = 1; seq <= 20; ++seq) {
        if (auto status = writer.write_frame(test::make_sample_frame(seq)); !status) return status;
        if (seq % 7 != 0 && seq != 1) continue;
        proto::Event event;
        event.seq = seq;
        event.type = "object.removed";
        event.step = 100 * seq;
        event.time = 0.01 * static_cast<double>(seq);
        event.wall_clock = 1.7e9;
        event.message = "panel removed";
        if (auto status = writer.write_event(event); !status) return status;
    }
    if (auto status = writer.write_command(R"({"method":"objects.remove","params":{"name":"panel"}})", 0.07); !status)
        return status;
    return writer.finish();
}

int fail(const proto::Error& error) {
    std::fprintf(stderr, "%s\n", error.message.c_str());
    return 1;
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::fprintf(stderr, "usage: write_sample_recording FILE.mcap [none|zstd] [FRAME.bin]\n");
        return 2;
    }
    proto::RecordingOptions options;
    options.overwrite = true;
    if (count > 2 && std::string(arguments[2]) == "zstd") options.compression = proto::Compression::zstd;
    const proto::RecordingMetadata metadata{R"({"headrace_scene":1,"name":"sample"})", "[]", "0123456789abcdef",
                                            "headraced sample", ""};
    auto writer = proto::RecordingWriter::create(arguments[1], metadata, options);
    if (!writer) return fail(writer.error());
    if (auto status = write_all(**writer); !status) return fail(status.error());
    if (count > 3) {
        const auto frame = test::make_sample_frame(7);
        std::ofstream file(arguments[3], std::ios::binary);
        file.write(reinterpret_cast<const char*>(frame.data()), static_cast<std::streamsize>(frame.size()));
        if (!file.flush()) return 1;
    }
    return 0;
}
