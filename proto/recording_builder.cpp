#include "proto/recording_builder.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "proto/messages_json.h"
#include "proto/recording_layout.h"

namespace headrace::proto::recording {

using mcap::ByteView;
using mcap::Cursor;
using mcap::Op;

namespace {

bool is_frame(const mcap::Message& message) {
    return message.channel == kFrames.id && message.data.size() >= sizeof(FrameHeader) &&
           std::memcmp(message.data.data() + offsetof(FrameHeader, magic), kFrameMagic, 8) == 0;
}

// Calls visit(message) for each message among a chunk's records.
template <class Visit>
void for_each_message(ByteView records, Visit visit) {
    Cursor cursor(records);
    while (!cursor.done()) {
        const auto record = mcap::next_record(cursor);
        if (!record) return;
        if (record->op != Op::message) continue;
        if (const auto message = mcap::read_message(record->content)) visit(*message);
    }
}

}  // namespace

Status IndexBuilder::take_chunk(std::uint64_t offset, std::uint64_t length) {
    auto records = loader_.load(offset, length);
    if (!records && records.error().code == ErrorCode::file_error) return records.error();
    if (!records) {
        skip(length);
        return Done{};
    }
    std::uint32_t ordinal = 0;
    for_each_message(*records, [&](const mcap::Message& message) {
        if (is_frame(message))
            take_frame({offset, length, ordinal++, message.log_time}, message);
        else if (message.channel == kEvents.id)
            take_event(message);
        else if (message.channel == kProbes.id)
            add_probes({offset, length});
    });
    return Done{};
}

bool IndexBuilder::take_metadata(ByteView content) {
    Cursor cursor(content);
    const std::string name = cursor.string();
    mcap::StringMap map = cursor.map();
    if (!cursor.ok() || !cursor.done()) return false;
    if (name == kStartName)
        index_.summary.metadata = {map["scene_json"], map["objects_json"], map["session"], map["program"],
                                   map["strategy"]};
    if (name == kEndName) end_ = std::move(map);
    return true;
}

std::optional<std::uint64_t> IndexBuilder::end_number(const std::string& key) const {
    const auto found = end_.find(key);
    if (found == end_.end()) return std::nullopt;
    const std::string& text = found->second;
    std::uint64_t value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Index IndexBuilder::finish(bool is_complete) {
    RecordingSummary& summary = index_.summary;
    summary.complete = is_complete;
    summary.frames = index_.frames.size();
    if (!index_.frames.empty()) {
        summary.first_time = seconds(index_.frames.front().log_time);
        summary.last_time = seconds(index_.frames.back().log_time);
    }
    std::stable_sort(index_.events.begin(), index_.events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    return std::move(index_);
}

void IndexBuilder::take_frame(const FrameEntry& entry, const mcap::Message& message) {
    FrameHeader header;
    std::memcpy(&header, message.data.data(), sizeof(header));
    if (!index_.frames.empty() && header.seq != last_seq_ + 1) ++index_.summary.gaps;
    last_seq_ = header.seq;
    index_.frames.push_back(entry);
}

void IndexBuilder::take_event(const mcap::Message& message) {
    auto event = parse_event({reinterpret_cast<const char*>(message.data.data()), message.data.size()});
    if (event)
        index_.events.push_back(std::move(event).value());
    else
        skip(message.data.size());
}

ByteView find_probes(ByteView records) {
    ByteView found;
    for_each_message(records, [&](const mcap::Message& message) {
        if (message.channel == kProbes.id) found = message.data;
    });
    return found;
}

ByteView find_frame(ByteView records, std::uint32_t ordinal) {
    ByteView found;
    std::uint32_t count = 0;
    for_each_message(records, [&](const mcap::Message& message) {
        if (is_frame(message) && count++ == ordinal) found = message.data;
    });
    return found;
}

}  // namespace headrace::proto::recording
