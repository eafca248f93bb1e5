#include "tests/bench/peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace headrace::bench {

namespace {

// [bytes] of a line of the process's status, which is in KiB.
double status_of(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double value{};
        if (word == name + ":" && status >> value) return 1024.0 * value;
    }
    return 0.0;
}

}  // namespace

// The kernel begins a new peak where "5" is written.
PeakMemory::PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    before_ = status_of("VmRSS");
}

double PeakMemory::growth() const {
    return status_of("VmHWM") - before_;
}

}  // namespace headrace::bench
