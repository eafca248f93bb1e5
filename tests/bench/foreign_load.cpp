#include "tests/bench/foreign_load.h"

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string>

namespace headrace::bench {

namespace {

// Processor time of all processes, from the first line of /proc/stat: user nice system idle iowait irq softirq steal.
double find_busy_seconds() {
    std::ifstream stat("/proc/stat");
    std::string name;
    double ticks[8]{}, busy = 0.0;
    stat >> name;
    for (double& tick : ticks) stat >> tick;
    for (const int k : {0, 1, 2, 5, 6, 7}) busy += ticks[k];
    return busy / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double find_own_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

ForeignLoad::ForeignLoad()
    : start_(std::chrono::steady_clock::now()), busy_(find_busy_seconds()), own_(find_own_seconds()) {}

double ForeignLoad::cores() const {
    const double own = find_own_seconds() - own_, busy = find_busy_seconds() - busy_;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
    return std::max(0.0, (busy - own) / wall.count());
}

}  // namespace headrace::bench
