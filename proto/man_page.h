// A manual page from a CLI11 app: what --help says, in the form of man(7). Both programs have theirs from here.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace headrace::proto {

// `name`: of the page, such as "headrace-run"; `command`: as it is typed, such as "headrace run". Section 1.
std::string man_page(const CLI::App& app, const std::string& name, const std::string& command);

}  // namespace headrace::proto
