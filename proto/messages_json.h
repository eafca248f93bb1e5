// Struct <-> JSON text, for every message and the scene document. Strict: unknown members, wrong types, duplicate keys,
// nesting past 32, non-finite numbers and values out of range are refused with the JSON path, the unit and a hint.
// Replies and events are read tolerantly in one respect: members that a newer peer may have added are passed over.
// Only the .cpp files of messages_json and the command tables include the JSON library's full header.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::proto {

using Json = nlohmann::ordered_json;

inline constexpr int kMaxJsonDepth = 32;

// Parses one JSON text under the limits above. Errors: parse_error (with line and column), json_too_deep,
// duplicate_key.
Result<Json> parse_json(std::string_view text);

// Decodes a message's params (or a result) from JSON. `path` is the name of the root in error paths, e.g. "params".
// Integers may be written as 1e3 or 2.0 when they are exact (up to 2^53). Vectors take 2 or 3 numbers, 3 in a scene of
// 3 dimensions; with 2 the third is 0. Where a reply's number may be non-finite it travels as the string "NaN",
// "Infinity" or "-Infinity".
// Defined for every request and reply struct of messages.h, for SceneDesc, ObjectDesc and ProbeDesc.
template <class Message>
Result<Message> from_json(const Json& json, std::string_view path);

template <class Message>
Json to_json(const Message& message);

// JSON schema (2020-12) of a message: types, units, ranges, defaults, meanings. Same source as the decoder.
template <class Message>
Json json_schema();

// Schema of a method's params and result, by name; null when there is no such method.
Json method_params_schema(std::string_view method);
Json method_result_schema(std::string_view method);
Json error_schema();  // of what error_json gives

// Whether these are params of the method; the error is the decoder's, with `params` as the root of its path, or
// method_not_found.
Status check_params(std::string_view method, const Json& params);

// Text in, text out, for those who do not want the JSON library.
Result<SceneDesc> parse_scene(std::string_view text);
std::string scene_text(const SceneDesc& scene);  // indented
std::string event_text(const Event& event);      // one line
Result<Event> parse_event(std::string_view text);
std::string probe_samples_text(const ProbeSamples& samples);  // one line
Result<ProbeSamples> parse_probe_samples(std::string_view text);
std::string objects_text(const std::vector<ObjectDesc>& objects);  // one line
Result<std::vector<ObjectDesc>> parse_objects(std::string_view text);

Json error_json(const Error& error);  // JSON-RPC error object: code, message, data {name, path, hint, retryable}
Error error_from_json(const Json& json);

}  // namespace headrace::proto
