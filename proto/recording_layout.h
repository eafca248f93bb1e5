// What makes an MCAP file a recording of ours: profile, channels, metadata names. Shared by writer and reader.
#pragma once

#include <cstdint>
#include <string_view>

namespace headrace::proto::recording {

inline constexpr std::string_view kProfile = "headrace";      // of the file's header
inline constexpr std::string_view kStartName = "headrace";    // metadata right after the header
inline constexpr std::string_view kEndName = "headrace.end";  // metadata after the last chunk: frames, gaps

// A channel's number, topic and encoding never change, so that every chunk can repeat their declaration.
struct Channel {
    std::uint16_t id;  // also of its schema
    std::string_view topic;
    std::string_view message_encoding;
    std::string_view schema_name;
    std::string_view schema_encoding;
    std::string_view schema;
};

inline constexpr Channel kFrames{1, "frames", "headrace_frame", "headrace.Frame", "", ""};
inline constexpr Channel kEvents{2, "events", "json", "headrace.Event", "jsonschema", R"({"type":"object"})"};
inline constexpr Channel kCommands{3, "commands", "json", "headrace.Command", "jsonschema", R"({"type":"object"})"};
inline constexpr Channel kProbes{4, "probes", "json", "headrace.ProbeSamples", "jsonschema", R"({"type":"object"})"};

}  // namespace headrace::proto::recording
