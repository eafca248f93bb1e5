#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>

#include "proto/mcap.h"
#include "proto/messages_json.h"
#include "proto/recording.h"
#include "proto/recording_file.h"
#include "proto/recording_layout.h"
#include "proto/recording_summary.h"
#include "proto/version.h"

namespace headrace::proto {

using mcap::Bytes;
using mcap::ByteView;
using mcap::Op;
using mcap::OpenRecord;
using namespace recording;

namespace {

constexpr int kZstdLevel = 1;  // particle data gains little from more, and a frame must not wait

struct ContextDeleter {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

ByteView bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

// MCAP times are unsigned: what is negative or not a number becomes 0.
std::uint64_t nanoseconds(double seconds) {
    constexpr double kMost = 9.2e18;
    const double value = std::min(std::round(seconds * 1e9), kMost);
    return value > 0 ? static_cast<std::uint64_t>(value) : 0;
}

void put_metadata(Bytes& out, std::string_view name, const mcap::StringMap& map) {
    const OpenRecord record(out, Op::metadata);
    mcap::put_string(out, name);
    mcap::put_map(out, map);
}

struct OutgoingMessage {
    Channel channel;
    std::uint32_t sequence;
    std::uint64_t log_time;
    std::uint64_t publish_time;
    ByteView data;
};

}  // namespace

struct RecordingWriter::Impl {
    Impl(File opened, const RecordingOptions& wanted) : file(std::move(opened)), options(wanted) {}

    Status begin(const RecordingMetadata& metadata);
    Status write(const OutgoingMessage& message);
    Status end();

    // Chunk records before the message's data, in `declarations`; nothing is copied of the data itself.
    void put_declarations(const OutgoingMessage& message);
    Result<ByteView> compress(ByteView data);
    const char* compression_name() const { return options.compression == Compression::zstd ? "zstd" : ""; }
    // After a failed write nothing more is attempted: what is in the file stays readable.
    Status append(std::span<const ByteView> pieces);

    File file;
    RecordingOptions options;
    bool is_finished{false};
    std::optional<Error> failure;

    std::vector<ChunkEntry> chunks;
    std::vector<MetadataEntry> metadata_entries;
    std::uint64_t frames{0};
    std::uint64_t gaps{0};
    std::uint64_t last_seq{0};
    std::uint32_t commands{0};
    std::uint32_t instants{0};                                // of probes
    std::map<std::string, std::vector<ProbeColumn>> columns;  // of each probe, as last written

    std::unique_ptr<ZSTD_CCtx, ContextDeleter> context;
    Bytes head, declarations, compressed, tail;  // of the chunk being written; kept for their memory
};

Status RecordingWriter::Impl::append(std::span<const ByteView> pieces) {
    Status status = file.append(pieces);
    if (!status) failure = status.error();
    return status;
}

Status RecordingWriter::Impl::begin(const RecordingMetadata& metadata) {
    Bytes out;
    mcap::put_bytes(out, {mcap::kMagic, mcap::kMagicBytes});
    {
        const OpenRecord record(out, Op::header);
        mcap::put_string(out, kProfile);
        mcap::put_string(out, std::string("headrace ") + kProgramVersion);
    }
    const std::size_t start = out.size();
    put_metadata(out, kStartName,
                 {{"scene_json", metadata.scene_json},
                  {"objects_json", metadata.objects_json},
                  {"session", metadata.session},
                  {"program", metadata.program},
                  {"strategy", metadata.strategy}});
    metadata_entries.push_back({kStartName, start, out.size() - start});
    return append(std::array<ByteView, 1>{out});
}

void RecordingWriter::Impl::put_declarations(const OutgoingMessage& message) {
    declarations.clear();
    put_schema(declarations, message.channel);
    put_channel(declarations, message.channel);
    mcap::put_head(declarations, Op::message, mcap::kMessageFields + message.data.size());
    mcap::put_u16(declarations, message.channel.id);
    mcap::put_u32(declarations, message.sequence);
    mcap::put_u64(declarations, message.log_time);
    mcap::put_u64(declarations, message.publish_time);
}

Result<ByteView> RecordingWriter::Impl::compress(ByteView data) {
    const std::size_t size = declarations.size() + data.size();
    if (!context) context.reset(ZSTD_createCCtx());
    ZSTD_CCtx_reset(context.get(), ZSTD_reset_session_only);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kZstdLevel);
    ZSTD_CCtx_setPledgedSrcSize(context.get(), size);
    compressed.resize(std::max(compressed.size(), ZSTD_compressBound(size)));

    // With room for the worst case each call takes all of its input.
    ZSTD_outBuffer out{compressed.data(), compressed.size(), 0};
    ZSTD_inBuffer front{declarations.data(), declarations.size(), 0};
    ZSTD_inBuffer back{data.data(), data.size(), 0};
    std::size_t left = ZSTD_compressStream2(context.get(), &out, &front, ZSTD_e_continue);
    if (!ZSTD_isError(left)) left = ZSTD_compressStream2(context.get(), &out, &back, ZSTD_e_end);
    if (ZSTD_isError(left) || left != 0 || front.pos != front.size)
        return Error{ErrorCode::internal_error, "zstd cannot compress a chunk", file.path().string(), ""};
    return ByteView(compressed).first(out.pos);
}

Status RecordingWriter::Impl::write(const OutgoingMessage& message) {
    if (failure) return *failure;
    if (is_finished) return file_error(file.path(), "the recording is finished", "");

    put_declarations(message);
    mcap::ChunkHead chunk;
    chunk.start_time = chunk.end_time = message.log_time;
    chunk.uncompressed_size = declarations.size() + message.data.size();
    chunk.uncompressed_crc = mcap::crc32(message.data, mcap::crc32(declarations));
    ByteView records[2] = {declarations, message.data};
    chunk.compression = compression_name();
    if (options.compression == Compression::zstd) {
        auto packed = compress(message.data);
        if (!packed) return packed.error();
        records[0] = *packed;
        records[1] = {};
    }
    chunk.records_size = records[0].size() + records[1].size();
    head.clear();
    mcap::put_chunk_head(head, chunk);

    // The message index: where in the chunk the message record starts.
    tail.clear();
    {
        const OpenRecord record(tail, Op::message_index);
        mcap::put_u16(tail, message.channel.id);
        mcap::put_u32(tail, 16);
        mcap::put_u64(tail, message.log_time);
        mcap::put_u64(tail, declarations.size() - mcap::kMessageFields - mcap::kRecordHead);
    }
    const ChunkEntry entry{message.channel.id, message.log_time,       file.size(), head.size() + chunk.records_size,
                           chunk.records_size, chunk.uncompressed_size};
    if (Status status = append(std::array<ByteView, 4>{head, records[0], records[1], tail}); !status) return status;
    chunks.push_back(entry);
    return Done{};
}

Status RecordingWriter::Impl::end() {
    if (failure) return *failure;
    if (is_finished) return Done{};
    is_finished = true;
    Bytes counts;
    put_metadata(counts, kEndName, {{"frames", std::to_string(frames)}, {"gaps", std::to_string(gaps)}});
    metadata_entries.push_back({kEndName, file.size(), counts.size()});
    if (Status status = append(std::array<ByteView, 1>{counts}); !status) return status;
    return append(std::array<ByteView, 1>{make_summary({chunks, metadata_entries, compression_name(), file.size()})});
}

RecordingWriter::RecordingWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

RecordingWriter::~RecordingWriter() {
    [[maybe_unused]] const Status status = finish();
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& file,
                                                                 const RecordingMetadata& metadata,
                                                                 const RecordingOptions& options) {
    auto opened = File::create(file, options.overwrite);
    if (!opened) return opened.error();
    auto impl = std::make_unique<Impl>(std::move(opened).value(), options);
    if (Status status = impl->begin(metadata); !status) {
        std::error_code ignored;
        if (!options.overwrite) std::filesystem::remove(file, ignored);
        return status.error();
    }
    return std::unique_ptr<RecordingWriter>(new RecordingWriter(std::move(impl)));
}

Status RecordingWriter::write_frame(std::span<const std::byte> frame) {
    FrameHeader header;
    if (frame.size() < sizeof(header))
        return Error{ErrorCode::parse_error, "no frame: shorter than its header", "", ""};
    std::memcpy(&header, frame.data(), sizeof(header));
    if (std::memcmp(header.magic, kFrameMagic, sizeof(header.magic)) != 0 || header.total_bytes != frame.size())
        return Error{ErrorCode::parse_error, "no frame: its mark or size is off", "", ""};

    const Status status = impl_->write({kFrames, static_cast<std::uint32_t>(header.seq), nanoseconds(header.time),
                                        nanoseconds(header.wall_clock), frame});
    if (!status) return status;
    if (impl_->frames > 0 && header.seq != impl_->last_seq + 1) ++impl_->gaps;
    impl_->last_seq = header.seq;
    ++impl_->frames;
    return status;
}

Status RecordingWriter::write_event(const Event& event) {
    const std::string text = event_text(event);
    return impl_->write({kEvents, static_cast<std::uint32_t>(event.seq), nanoseconds(event.time),
                         nanoseconds(event.wall_clock), bytes_of(text)});
}

Status RecordingWriter::write_command(std::string_view json, double time) {
    const std::uint64_t log_time = nanoseconds(time);
    return impl_->write({kCommands, ++impl_->commands, log_time, log_time, bytes_of(json)});
}

Status RecordingWriter::write_probes(const ProbeSamples& samples) {
    ProbeSamples message = samples;
    for (ProbeSample& sample : message.samples) {
        std::vector<ProbeColumn>& written = impl_->columns[sample.probe];
        if (sample.columns == written)
            sample.columns.clear();
        else
            written = sample.columns;
    }
    const std::string text = probe_samples_text(message);
    const std::uint64_t log_time = nanoseconds(samples.time);
    return impl_->write({kProbes, ++impl_->instants, log_time, log_time, bytes_of(text)});
}

Status RecordingWriter::finish() {
    return impl_->end();
}

std::uint64_t RecordingWriter::frames() const {
    return impl_->frames;
}

std::uint64_t RecordingWriter::gaps() const {
    return impl_->gaps;
}

std::uint64_t RecordingWriter::bytes() const {
    return impl_->file.size();
}

}  // namespace headrace::proto
