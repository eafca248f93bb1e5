// How many cores others kept busy: tells a disturbed timing from a quiet one.
#pragma once

#include <chrono>

namespace headrace::bench {

// Counts from its construction. Ticks of the system's clock (10 ms) limit it: over 0.1 s it errs by some 0.1 cores a
// core. 0 where the system does not tell.
class ForeignLoad {
  public:
    ForeignLoad();
    double cores() const;

  private:
    std::chrono::steady_clock::time_point start_;
    double busy_{}, own_{};  // [s] of processor time since the system and the process began
};

}  // namespace headrace::bench
