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
