// Memory that a piece of work takes at its peak.
#pragma once

namespace headrace::bench {

// Counts from its beginning, with what the process holds then as 0.
class PeakMemory {
  public:
    PeakMemory();
    // [bytes] largest so far.
    double growth() const;

  private:
    double before_{};
};

}  // namespace headrace::bench
