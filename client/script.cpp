#include "client/script.h"

#include <sstream>
#include <utility>

#include "client/arguments.h"
#include "client/json_words.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace fs = std::filesystem;
using proto::Json;

namespace {

constexpr const char* kForm = R"(write {"method": "...", "params": {...}} or {"wait": "..."})";

proto::Error bad_line(std::string message, std::string path, std::string hint = kForm) {
    return usage_error(std::move(message), std::move(path), std::move(hint));
}

// Members that an object may not have; `known` are all that it may.
proto::Status check_members(const Json& object, const std::vector<std::string>& known, const std::string& path) {
    for (const auto& [name, value] : object.items())
        if (std::find(known.begin(), known.end(), name) == known.end())
            return bad_line("unknown member \"" + name + "\"", path + name, proto::suggest(name, known));
    return proto::Done{};
}

proto::Result<std::optional<double>> positive(const Json& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end()) return std::optional<double>{};
    if (!found->is_number() || found->get<double>() <= 0.0)
        return bad_line("must be a number above 0", std::string("wait.") + member, "seconds");
    return std::optional<double>(found->get<double>());
}

proto::Result<ScriptRun> parse_run(const std::string& word) {
    auto until = parse_until(word);
    if (!until) {
        proto::Error error = until.error();
        error.path = "wait";
        return error;
    }
    return ScriptRun{*until};
}

// "at-rest", {"until": "at-rest", "timeout": 20} or {"event": "object.removed", "timeout": 60}
proto::Result<decltype(ScriptStep::what)> parse_wait(const Json& wait) {
    using What = decltype(ScriptStep::what);
    if (wait.is_string()) {
        auto run = parse_run(wait.get<std::string>());
        return run ? proto::Result<What>(*run) : run.error();
    }
    if (!wait.is_object() || wait.contains("until") == wait.contains("event"))
        return bad_line(
            "neither an end of a run nor an event", "wait",
            R"("at-rest", "2", "step=400" or "tip>0.3", {"until": ..., "timeout": s} or {"event": ..., "timeout": s})");
    const bool is_event = wait.contains("event");
    const std::string subject = is_event ? "event" : "until";
    if (auto checked = check_members(wait, {subject, "timeout"}, "wait."); !checked) return checked.error();
    if (!wait[subject].is_string()) return bad_line("must be a string", "wait." + subject);
    auto timeout = positive(wait, "timeout");
    if (!timeout) return timeout.error();
    if (is_event) return What(ScriptEvent{wait["event"].get<std::string>(), *timeout});
    auto run = parse_run(wait["until"].get<std::string>());
    if (!run) return run.error();
    run->until.timeout = *timeout;
    return What(*std::move(run));
}

// The document in the place of a file's name.
proto::Status read_scene(ScriptCommand& command, const fs::path& folder) {
    if (command.method != "scene.load") return proto::Done{};
    const auto scene = command.params.find("scene");
    if (scene == command.params.end() || !scene->is_string()) return proto::Done{};
    const auto name = scene->get<std::string>();
    if (!name.ends_with(".json")) return proto::Done{};
    auto document = read_json_file((folder / name).string(), "scene files are sought from the script's folder");
    if (!document) return document.error();
    *scene = *std::move(document);
    return proto::Done{};
}

proto::Result<decltype(ScriptStep::what)> parse_line(const std::string& text, const fs::path& folder,
                                                     ScriptVariables& variables) {
    using What = decltype(ScriptStep::what);
    auto line = proto::parse_json(text);
    if (!line) return line.error();
    if (!line->is_object()) return bad_line("not an object", "");
    if (auto substituted = variables.substitute(*line); !substituted) return substituted.error();
    if (line->contains("wait")) {
        if (auto checked = check_members(*line, {"wait"}, ""); !checked) return checked.error();
        return parse_wait((*line)["wait"]);
    }
    // What a JSON-RPC request has besides is taken as it comes, and of no use here.
    if (auto checked = check_members(*line, {"method", "params", "jsonrpc", "id"}, ""); !checked)
        return checked.error();
    const auto method = line->find("method");
    if (method == line->end() || !method->is_string()) return bad_line("no method", "method");
    ScriptCommand command{method->get<std::string>()};
    if (const auto params = line->find("params"); params != line->end()) command.params = *params;
    if (!command.params.is_object()) return bad_line("must be an object", "params");
    if (auto read = read_scene(command, folder); !read) return read.error();
    return What(std::move(command));
}

}  // namespace

// ---- variables ------------------------------------------------------------------------------------------------------

proto::Result<ScriptVariables> ScriptVariables::parse(const std::vector<std::string>& assignments) {
    ScriptVariables result;
    for (const std::string& word : assignments) {
        const std::size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            return usage_error("\"" + word + "\" sets nothing", "--set", "write name=value, for example nu=0.01");
        const std::string name = word.substr(0, equals), text = word.substr(equals + 1);
        auto value = proto::parse_json(text);
        if (!result.variables_.emplace(name, Variable{value ? *std::move(value) : Json(text)}).second)
            return usage_error("\"" + name + "\" is set twice", "--set");
    }
    return result;
}

std::vector<std::string> ScriptVariables::unused() const {
    std::vector<std::string> names;
    for (const auto& [name, variable] : variables_)
        if (!variable.is_used) names.push_back(name);
    return names;
}

proto::Result<const Json*> ScriptVariables::find(const std::string& name) {
    if (const auto found = variables_.find(name); found != variables_.end()) {
        found->second.is_used = true;
        return &found->second.value;
    }
    std::vector<std::string> known;
    for (const auto& [each, variable] : variables_) known.push_back(each);
    const std::string hint = known.empty() ? "" : proto::suggest(name, known);
    return usage_error("${" + name + "} has no value", "",
                       hint.starts_with("did you mean") ? hint : "give it one: --set " + name + "=VALUE");
}

proto::Status ScriptVariables::substitute(Json& value) {
    if (value.is_string()) return substitute_text(value);
    if (value.is_structured())
        for (Json& part : value)
            if (auto substituted = substitute(part); !substituted) return substituted;
    return proto::Done{};
}

proto::Status ScriptVariables::substitute_text(Json& value) {
    const auto text = value.get<std::string>();
    std::string result;
    for (std::size_t at = 0;;) {
        const std::size_t start = text.find("${", at);
        if (start == std::string::npos) {
            result += text.substr(at);
            break;
        }
        if (start > at && text[start - 1] == '$') {
            result += text.substr(at, start - 1 - at) + "${";
            at = start + 2;
            continue;
        }
        const std::size_t end = text.find('}', start);
        if (end == std::string::npos)
            return usage_error("a variable without its end in \"" + text + "\"", "", "${name}");
        auto found = find(text.substr(start + 2, end - start - 2));
        if (!found) return found.error();
        const Json& inserted = **found;
        if (start == 0 && end + 1 == text.size()) {
            value = inserted;
            return proto::Done{};
        }
        result += text.substr(at, start - at) + (inserted.is_string() ? inserted.get<std::string>() : inserted.dump());
        at = end + 1;
    }
    value = result;
    return proto::Done{};
}

// ---- lines ----------------------------------------------------------------------------------------------------------

proto::Error error_at(const std::string& name, std::size_t line, proto::Error error) {
    const std::string place = name + ":" + std::to_string(line);
    error.path = error.path.empty() ? place : place + ": " + error.path;
    return error;
}

proto::Result<std::vector<ScriptStep>> parse_script(std::string_view text, const std::string& name,
                                                    const fs::path& folder, ScriptVariables& variables) {
    std::vector<ScriptStep> steps;
    std::istringstream lines{std::string(text)};
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#') continue;
        auto what = parse_line(line, folder, variables);
        if (!what) return error_at(name, number, what.error());
        steps.push_back({number, *std::move(what)});
    }
    if (steps.empty()) return usage_error("the script has no commands", name, kForm);
    if (const auto unused = variables.unused(); !unused.empty())
        return usage_error("no line uses ${" + unused.front() + "}", "--set", "take it away, or correct its name");
    return steps;
}

}  // namespace headrace::client
