// What may stand next in a command line, read off the CLI11 app: no command and no option is written down twice.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace headrace::client {

struct Candidate {
    std::string word;
    std::string about;  // may be empty
};

struct Completions {
    std::vector<Candidate> candidates;  // those that begin with the last word
    bool wants_files{false};            // names of files too
};

// Names that only a server knows; empty where there is none. `what`: "object", "parameter", "probe", "scene". `server`:
// as the words give it by --server, else empty.
using ServerNames = std::function<std::vector<Candidate>(const std::string& what, const std::string& server)>;

// `words`: behind the program's name, the last one (perhaps empty) is to be completed.
Completions complete(const CLI::App& app, const std::vector<std::string>& words, const ServerNames& server_names);

// Script for the shell: "bash", "zsh" or "fish"; else empty. It asks `headrace __complete WORDS...` each time.
std::string completion_script(const std::string& shell);

// Does what `headrace __complete WORDS...` is for: a line "word<TAB>about" per candidate, ":files" at the end where
// names of files are wanted. Says nothing of errors: they would stand in the middle of what somebody types.
void print_completions(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace headrace::client
