#include <map>

#include "proto/messages_json.h"
#include "proto/recording.h"
#include "proto/recording_chunk.h"
#include "proto/recording_file.h"
#include "proto/recording_index.h"

namespace headrace::proto {

using namespace recording;

struct RecordingReader::Impl {
    explicit Impl(File opened) : file(std::move(opened)), loader(file) {}

    File file;
    ChunkLoader loader;
    Index index;
};

RecordingReader::RecordingReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

RecordingReader::~RecordingReader() = default;

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::filesystem::path& file) {
    auto opened = File::open(file);
    if (!opened) return opened.error();
    auto impl = std::make_unique<Impl>(std::move(opened).value());
    auto index = read_index(impl->file, impl->loader);
    if (!index) return index.error();
    impl->index = std::move(index).value();
    return std::unique_ptr<RecordingReader>(new RecordingReader(std::move(impl)));
}

const RecordingSummary& RecordingReader::summary() const {
    return impl_->index.summary;
}

const std::vector<Event>& RecordingReader::events() const {
    return impl_->index.events;
}

Status RecordingReader::read_probes(const std::function<void(const ProbeSamples&)>& visit) {
    std::map<std::string, std::vector<ProbeColumn>> columns;  // of each probe, as last told
    for (const ChunkPlace& place : impl_->index.probes) {
        auto records = impl_->loader.load(place.offset, place.length);
        if (!records) return records.error();
        const mcap::ByteView message = find_probes(*records);
        auto samples = parse_probe_samples({reinterpret_cast<const char*>(message.data()), message.size()});
        if (!samples) return damage(impl_->file, place.offset, samples.error().message);
        for (ProbeSample& sample : samples->samples) {
            std::vector<ProbeColumn>& known = columns[sample.probe];
            if (sample.columns.empty()) sample.columns = known;
            known = sample.columns;
            // The chunk that told them may be lost.
            if (sample.columns.size() != sample.values.size()) sample.columns.clear();
            for (std::size_t k = sample.columns.size(); k < sample.values.size(); ++k)
                sample.columns.push_back({"value_" + std::to_string(k), "?", {}});
        }
        visit(*samples);
    }
    return Done{};
}

std::size_t RecordingReader::frame_count() const {
    return impl_->index.frames.size();
}

double RecordingReader::frame_time(std::size_t index) const {
    return seconds(impl_->index.frames[index].log_time);
}

Result<FrameView> RecordingReader::read_frame(std::size_t index) {
    if (index >= frame_count()) return file_error(impl_->file.path(), "it has no frame " + std::to_string(index), "");
    const FrameEntry& entry = impl_->index.frames[index];
    auto records = impl_->loader.load(entry.chunk_offset, entry.chunk_length);
    if (!records) return records.error();
    const mcap::ByteView message = find_frame(*records, entry.ordinal);
    if (message.empty()) return damage(impl_->file, entry.chunk_offset, "the chunk holds no frame");
    auto frame = decode_frame(message);
    if (!frame) return damage(impl_->file, entry.chunk_offset, frame.error().message);
    return frame;
}

}  // namespace headrace::proto
