// Ctrl-C. The first SIGINT or SIGTERM asks the work under way to end well; the second one kills as usual.
#pragma once

namespace headrace::client {

inline constexpr int kInterruptedExit = 130;  // 128 + SIGINT, as shells expect

void watch_interrupts();  // installs the handlers
bool is_interrupted();

}  // namespace headrace::client
