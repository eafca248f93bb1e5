// Words of the command line that are JSON. Includes the JSON library: for .cpp files only.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "proto/messages_json.h"
#include "proto/result.h"

namespace headrace::client {

// A file as text. Error: file_error with the hint.
proto::Result<std::string> read_text_file(const std::string& file, const std::string& hint);

// The document as it stands: the server checks it and names paths inside it. Errors: file_error with the hint;
// parse_error, json_too_deep, duplicate_key with the file's name in the path.
proto::Result<proto::Json> read_json_file(const std::string& file, const std::string& hint);

// JSON as it stands ('{"angle": "t"}', '[1, 0]'), or the name of a file that holds it. Errors: as above, with the
// option in the path where the word itself is no JSON.
proto::Result<proto::Json> json_word(const std::string& word, const std::string& option);

// A probe from "NAME=JSON": {"level": {...}}, or a whole probe with `kind` and, say, `interval`.
proto::Result<proto::ProbeDesc> parse_probe(const std::string& word);

}  // namespace headrace::client
