// The three visitors behind from_json, to_json and json_schema, as functions. Internal to messages_json.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "proto/errors.h"
#include "proto/json_members.h"
#include "proto/messages_json.h"

namespace headrace::proto {

// A message of a type known to the caller only, and how to visit it.
struct AnyMessage {
    void* message;
    void (*visit)(Visitor& visitor, void* message);
};

// strict: unknown members are refused. tolerant: they are passed over, since a newer peer of the same protocol number
// may add members to its replies and events.
enum class Strictness { strict, tolerant };

// Fills the message; what it holds after an error is unspecified.
std::optional<Error> read_message(const Json& json, std::string_view path, Strictness strictness, AnyMessage into);
// Does not change the message.
Json write_message(AnyMessage from);
// `defaults` is a default-constructed message; it is used up.
Json message_schema(std::string_view title, AnyMessage defaults);

// One line of text; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const Json& json, int indent = -1);
// The start of a text in quotes, for messages to people.
std::string in_quotes(std::string_view text);
// Numbers as people write them: shortest text that reads back the same.
std::string number_text(double x);

}  // namespace headrace::proto
