#include "client/doctor_programs.h"

#include <cstdio>
#include <memory>
#include <optional>

#include "client/arguments.h"

namespace headrace::client {

namespace {

struct ClosePipe {
    void operator()(std::FILE* pipe) const { ::pclose(pipe); }
};

// What a command of the shell prints first; nothing when it prints nothing, as one does that is not there.
std::optional<std::string> first_line(const char* command) {
    const std::unique_ptr<std::FILE, ClosePipe> pipe(::popen(command, "re"));
    char text[512];
    if (!pipe || std::fgets(text, sizeof text, pipe.get()) == nullptr) return std::nullopt;
    std::string line(text);
    if (!line.empty() && line.back() == '\n') line.pop_back();
    while (std::fgets(text, sizeof text, pipe.get()) != nullptr) {  // so that it is not ended by a broken pipe
    }
    return line;
}

// "path|version|of zmq or nothing|of numpy or nothing"
constexpr const char* kAskPython = R"(python3 -c '
import importlib, sys
def version(name):
    try:
        return importlib.import_module(name).__version__
    except Exception:
        return ""
print(sys.executable, sys.version.split()[0], version("zmq"), version("numpy"), sep="|")
' 2>/dev/null)";

}  // namespace

Finding film_maker() {
    const auto line = first_line("ffmpeg -version 2>/dev/null");
    if (!line) return warning("ffmpeg", "not on the PATH", "films (--format mp4) need it: apt install ffmpeg");
    // "ffmpeg version 5.1.6-0+deb12u1 Copyright ..."
    const std::vector<std::string> words = split(*line, ' ');
    return good("ffmpeg", words.size() > 2 ? words[2] : *line);
}

Finding python_modules() {
    const auto line = first_line(kAskPython);
    if (!line)
        return warning("Python", "no python3 on the PATH",
                       "the Python client needs it: apt install python3-zmq python3-numpy");
    const std::vector<std::string> parts = split(*line, '|');
    if (parts.size() != 4) return warning("Python", *line, "python3 does not answer as it should: reinstall it");
    const std::string &path = parts[0], &zmq = parts[2], &numpy = parts[3];
    const auto told = [](const char* name, const std::string& version) {
        return version.empty() ? std::string("no ") + name : name + (" " + version);
    };
    const std::string found = path + " " + parts[1] + ", " + told("pyzmq", zmq) + ", " + told("NumPy", numpy);
    if (!zmq.empty() && !numpy.empty()) return good("Python", found);
    const bool is_debian = path == "/usr/bin/python3";
    std::string install = is_debian ? "apt install" : path + " -m pip install";
    if (zmq.empty()) install += is_debian ? " python3-zmq" : " pyzmq";
    if (numpy.empty()) install += is_debian ? " python3-numpy" : " numpy";
    return warning("Python", found, "the Python client needs both: " + install);
}

}  // namespace headrace::client
