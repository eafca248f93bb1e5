#include "client/interrupt.h"

#include <atomic>
#include <csignal>

namespace headrace::client {

namespace {

// A signal handler has nowhere else to leave its word.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void note_interrupt(int) {
    interrupted.store(true, std::memory_order_relaxed);
}

}  // namespace

void watch_interrupts() {
    struct sigaction action {};
    action.sa_handler = note_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() {
    return interrupted.load(std::memory_order_relaxed);
}

}  // namespace headrace::client
