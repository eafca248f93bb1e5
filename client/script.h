// Scripts: JSON Lines of commands and waits. One line is one step; there are no loops and no conditions: those are
// Python's.
//     # comment
//     {"method": "scene.load", "params": {"scene": "dam_break", "parameters": {"viscosity": "${nu}"}}}
//     {"wait": "at-rest"}
// Includes the JSON library: for .cpp files only.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "proto/messages.h"
#include "proto/messages_json.h"
#include "proto/result.h"

namespace headrace::client {

struct ScriptCommand {
    std::string method;
    proto::Json params = proto::Json::object();
};
// The run goes on to this end.
struct ScriptRun {
    proto::RunUntil until;
};
// Something happens, or has happened since the event that the wait before has found.
struct ScriptEvent {
    std::string type;
    std::optional<double> timeout;  // [s] wall time
};

struct ScriptStep {
    std::size_t line{};  // from 1
    std::variant<ScriptCommand, ScriptRun, ScriptEvent> what;
};

// Values of `${name}`. A string that is nothing but "${name}" becomes the value with its type, inside a longer string
// the value's text is put in; "$${" stands for "${".
class ScriptVariables {
  public:
    // "nu=0.01": JSON where it is JSON, else a string. Error: usage.
    static proto::Result<ScriptVariables> parse(const std::vector<std::string>& assignments);

    proto::Status substitute(proto::Json& value);
    // Names that no line has used: misspelt, most likely.
    std::vector<std::string> unused() const;

  private:
    proto::Result<const proto::Json*> find(const std::string& name);
    proto::Status substitute_text(proto::Json& value);

    struct Variable {
        proto::Json value;
        bool is_used{false};
    };
    std::map<std::string, Variable> variables_;
};

// All steps, or the first error: with "NAME:LINE" in its path. Scenes that end in ".json" are files, sought from
// `folder`; the documents take their place.
proto::Result<std::vector<ScriptStep>> parse_script(std::string_view text, const std::string& name,
                                                    const std::filesystem::path& folder, ScriptVariables& variables);

// An error told of a script's line.
proto::Error error_at(const std::string& name, std::size_t line, proto::Error error);

}  // namespace headrace::client
