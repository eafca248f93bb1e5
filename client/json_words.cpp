#include "client/json_words.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/arguments.h"

namespace headrace::client {

namespace {

// A parser's error, told of the word or file that was parsed.
proto::Error told_of(const std::string& what, proto::Error error) {
    error.path = error.path.empty() ? what : what + ": " + error.path;
    return error;
}

}  // namespace

proto::Result<std::string> read_text_file(const std::string& file, const std::string& hint) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        return proto::Error{proto::ErrorCode::file_error, "is a folder", file, hint};
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    // An empty file leaves no character to put out, which is no failure.
    if (!in || (in.peek() != std::ifstream::traits_type::eof() && !(text << in.rdbuf())))
        return proto::Error{proto::ErrorCode::file_error, std::strerror(errno), file, hint};
    return text.str();
}

proto::Result<proto::Json> read_json_file(const std::string& file, const std::string& hint) {
    auto text = read_text_file(file, hint);
    if (!text) return text.error();
    auto document = proto::parse_json(*text);
    if (!document) return told_of(file, document.error());
    return document;
}

proto::Result<proto::Json> json_word(const std::string& word, const std::string& option) {
    const std::size_t first = word.find_first_not_of(" \t\n");
    if (first == std::string::npos || (word[first] != '{' && word[first] != '['))
        return read_json_file(word, option + " takes JSON, or the name of a file that holds it");
    auto document = proto::parse_json(word);
    if (!document) return told_of(option, document.error());
    return document;
}

proto::Result<proto::ProbeDesc> parse_probe(const std::string& word) {
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == std::string::npos)
        return usage_error("no NAME=JSON in \"" + word + "\"", "--probe",
                           R"(for example --probe 'gauge={"level": {"from": [0.1, 0], "to": [0.1, 0.5]}}')");
    const std::string name = word.substr(0, equals), path = "--probe " + name;
    auto json = proto::parse_json(word.substr(equals + 1));
    if (!json) return told_of(path, json.error());
    proto::Json document = json->contains("kind") ? *json : proto::Json{{"kind", *json}};
    document["name"] = name;
    return proto::from_json<proto::ProbeDesc>(document, path);
}

}  // namespace headrace::client
