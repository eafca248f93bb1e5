#include "client/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <string_view>

#include "client/arguments.h"

namespace headrace::client {

namespace {

// The alternate screen without a cursor, and back.
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[2J";
constexpr std::string_view kLeave = "\x1b[?25h\x1b[?1049l";

// What a signal handler needs to give the terminal back; it has nowhere else to look.
termios before;
std::atomic<bool> is_taken{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void put(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
        if (written <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void take() {
    termios raw = before;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // signals of keys stay
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSADRAIN, &raw);
    put(kEnter);
    is_taken.store(true);
}

// Async-signal-safe.
void give_back() {
    if (!is_taken.exchange(false)) return;
    put(kLeave);
    tcsetattr(STDIN_FILENO, TCSANOW, &before);
}

void end_by(int signal) {
    give_back();
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    sigaction(signal, &plain, nullptr);
    raise(signal);
}

void stop_by(int) {
    give_back();
    raise(SIGSTOP);
    take();  // and on: SIGCONT has come
}

void note_resize(int) {}  // ends the wait for a key

// Signals that would end the program without a word. SIGINT and SIGTERM are watched by client/interrupt.
constexpr std::array kEndings{SIGHUP, SIGQUIT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigaction(signal, &action, nullptr);
}

}  // namespace

proto::Status Terminal::check(const std::string& hint) {
    if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) return usage_error("this needs a terminal", "", hint);
    return proto::Done{};
}

proto::Result<std::unique_ptr<Terminal>> Terminal::open(const std::string& hint) {
    if (auto checked = check(hint); !checked) return checked.error();
    if (tcgetattr(STDIN_FILENO, &before) != 0) return usage_error("the terminal does not tell its settings", "", hint);
    for (const int signal : kEndings) handle(signal, end_by);
    handle(SIGTSTP, stop_by);
    handle(SIGWINCH, note_resize);
    take();
    return std::unique_ptr<Terminal>(new Terminal);
}

Terminal::~Terminal() {
    give_back();
    for (const int signal : kEndings) handle(signal, SIG_DFL);
    handle(SIGTSTP, SIG_DFL);
    handle(SIGWINCH, SIG_DFL);
}

Terminal::Size Terminal::size() const {
    winsize window{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_row == 0 || window.ws_col == 0) return {};
    return {window.ws_row, window.ws_col};
}

void Terminal::draw(const std::vector<std::string>& lines) {
    const Size room = size();
    std::string screen = "\x1b[H";
    for (std::size_t k = 0; k < lines.size() && k < static_cast<std::size_t>(room.rows); ++k) {
        if (k > 0) screen += "\r\n";
        screen += cut_to_width(lines[k], room.columns) + "\x1b[0m\x1b[K";
    }
    put(screen + "\x1b[J");
}

std::optional<char> Terminal::key(std::chrono::milliseconds timeout) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (poll(&input, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
    std::array<char, 16> bytes{};
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count < 0) return std::nullopt;
    if (count == 0) return 'q';
    if (bytes[0] == '\x1b' && count > 1) return std::nullopt;
    return bytes[0];
}

std::string cut_to_width(const std::string& text, int columns) {
    std::string result;
    bool is_sequence = false;
    for (const char c : text) {
        const bool is_continued = (static_cast<unsigned char>(c) & 0xc0) == 0x80;
        if (c == '\x1b') is_sequence = true;
        if (!is_sequence && !is_continued && columns-- <= 0) break;
        result += c;
        if (is_sequence && c != '\x1b' && c != '[' && (c < '0' || c > '?')) is_sequence = false;
    }
    return result;
}

}  // namespace headrace::client
