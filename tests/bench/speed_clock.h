// The clock of the speed measurements.
#pragma once

#include <omp.h>

#include <ctime>

namespace headrace::bench {

// [s] With one thread its processor time: the wall time of a machine that does nothing else. Else the wall clock.
inline double speed_now() {
    timespec time{};
    clock_gettime(omp_get_max_threads() == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class StageClock {
  public:
    // [s] since the last lap or the beginning.
    double lap() {
        const double now = speed_now(), before = last_;
        last_ = now;
        return now - before;
    }

  private:
    double last_{speed_now()};
};

}  // namespace headrace::bench
