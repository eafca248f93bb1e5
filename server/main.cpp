// headraced: options, signals, wiring.
#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>

#include "proto/man_page.h"
#include "proto/version.h"
#include "server/service/endpoints.h"
#include "server/service/log.h"
#include "server/service/server.h"
#include "server/solver/process_settings.h"

namespace {

using headrace::server::Log;
using headrace::server::LogLevel;
using headrace::server::Server;
using headrace::server::ServerOptions;

constexpr int kExitUsage = 2;
constexpr int kExitCannotStart = 3;

constexpr const char* kFooter =
    "Listens on loopback or ipc only; from afar: ssh -L 5755:127.0.0.1:5755 (and the next three ports).\n"
    "Exit status: 0 ended as asked, 2 wrong options, 3 cannot listen or cannot use the data folder, 1 anything else.";

struct Options {
    ServerOptions server;
    std::string data{"."};
    std::string log_level{"warn"};
    bool json{false};
    bool quit_on_stdin_eof{false};
};

void declare_options(CLI::App& app, Options& options) {
    app.add_option("--bind", options.server.bind,
                   "tcp://HOST:PORT (this port and the next three; * takes free ones) or ipc://PATH")
        ->capture_default_str();
    app.add_option("--data", options.data,
                   "folder below which recordings are written, and particle files of scenes read")
        ->capture_default_str();
    app.add_option("--threads", options.server.threads, "threads of the solver; 0: as many as the machine has")
        ->check(CLI::Range(0, 4096))
        ->capture_default_str();
    app.add_option("--log-level", options.log_level, "error, warn, info or debug, on standard error")
        ->check(CLI::IsMember({"error", "warn", "info", "debug"}))
        ->capture_default_str();
    app.add_flag("--json", options.json, "print the ready line as JSON");
    app.add_flag("--quit-on-stdin-eof", options.quit_on_stdin_eof, "end when standard input ends");
    app.add_flag_callback(
        "--man",
        [&app] {
            std::fputs(headrace::proto::man_page(app, "headraced", "headraced").c_str(), stdout);
            throw CLI::Success();
        },
        "print the manual page: headraced --man | man -l -");
    app.set_version_flag("--version", std::string("headraced ") + headrace::proto::kProgramVersion);
    app.footer(kFooter);
}

void print_ready_line(const Server& server, bool as_json) {
    if (as_json) {
        const nlohmann::ordered_json line{{"control", server.control_endpoint()}, {"events", server.events_endpoint()},
                                          {"frames", server.frames_endpoint()},   {"data", server.data_endpoint()},
                                          {"session", server.session()},          {"pid", ::getpid()}};
        std::printf("%s\n", line.dump().c_str());
    } else if (const auto events = headrace::server::port_of(server.events_endpoint())) {
        std::printf("control %s events %d frames %d data %d (loopback only)\n", server.control_endpoint().c_str(),
                    *events, headrace::server::port_of(server.frames_endpoint()).value_or(0),
                    headrace::server::port_of(server.data_endpoint()).value_or(0));
    } else {
        std::printf("control %s events %s frames %s data %s (loopback only)\n", server.control_endpoint().c_str(),
                    server.events_endpoint().c_str(), server.frames_endpoint().c_str(), server.data_endpoint().c_str());
    }
    std::fflush(stdout);
}

// SIGINT and SIGTERM as something to poll. Blocked before any thread starts, so that every thread inherits it.
struct Signals {
    Signals() {
        sigemptyset(&set);
        sigaddset(&set, SIGINT);
        sigaddset(&set, SIGTERM);
        pthread_sigmask(SIG_BLOCK, &set, nullptr);
        fd = ::signalfd(-1, &set, SFD_CLOEXEC);
    }
    ~Signals() { ::close(fd); }
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    // From here on a further signal ends the process at once.
    void release() {
        signalfd_siginfo info{};
        [[maybe_unused]] const auto taken = ::read(fd, &info, sizeof info);
        pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    }

    sigset_t set{};
    int fd{-1};
};

// True when standard input has ended; reads and ignores what comes before that.
bool stdin_has_ended() {
    char ignored[4096];
    return ::read(STDIN_FILENO, ignored, sizeof ignored) <= 0;
}

// Sleeps until a signal, the end of standard input, or the end of the server by a command.
void wait_for_the_end(const Server& server, Signals& signals, bool watch_stdin) {
    pollfd items[3] = {{server.ended_fd(), POLLIN, 0}, {signals.fd, POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
    const nfds_t count = watch_stdin ? 3 : 2;
    while (true) {
        if (::poll(items, count, -1) < 0) continue;
        if (items[0].revents != 0) return;
        if (items[1].revents != 0) return signals.release();
        if (watch_stdin && items[2].revents != 0 && stdin_has_ended()) return;
    }
}

int run(const Options& options) {
    Signals signals;
    std::unique_ptr<Server> server;
    try {
        server = std::make_unique<Server>(options.server);
    } catch (const std::exception& failure) {
        options.server.log(LogLevel::error, failure.what());
        return kExitCannotStart;
    }
    server->start();
    print_ready_line(*server, options.json);
    wait_for_the_end(*server, signals, options.quit_on_stdin_eof);
    server->stop();
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    headrace::solver::restart_with_settings(argv);
    std::signal(SIGPIPE, SIG_IGN);  // whoever read our output has gone; the run goes on
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is a failed write, which recordings report
    Options options;
    CLI::App app("A fluid simulation that is commanded over ZeroMQ while it runs.", "headraced");
    declare_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& stopped) {
        if (stopped.get_exit_code() == 0) return app.exit(stopped);  // --help, --version
        options.server.log(LogLevel::error, std::string(stopped.what()) + " (headraced --help tells the options)");
        return kExitUsage;
    }
    options.server.data_folder = options.data;
    options.server.log = Log(*headrace::server::find_log_level(options.log_level));
    try {
        return run(options);
    } catch (const std::exception& failure) {
        options.server.log(LogLevel::error, failure.what());
        return 1;
    }
}
