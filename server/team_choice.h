// How many threads the steps of a run take: as many as there are, or fewer where that is faster.
//
// A step of a small scene is a hundred short loops, and each waits for the last of its threads. Where another program
// holds one of the processors, that wait is the scheduler's time slice, and fewer threads are faster, often by much.
// Nobody can tell beforehand, so it is tried: now and then some steps with half or twice as many threads. Their number
// never changes a result.
#pragma once

namespace headrace::server {

class TeamChoice {
  public:
    explicit TeamChoice(int most) : most_(most), threads_(most) {}

    int threads() const { return threads_; }  // that the next step takes

    // It has taken so long [s].
    void note(double seconds);

  private:
    // Steps with one number of threads.
    struct Window {
        double seconds{};
        int steps{};
        double mean() const { return seconds / steps; }
        // Long enough to tell: some time slices of a busy machine, and what is not done in every step.
        bool is_full() const;
    };

    void judge(const Window& window);
    int candidate();

    int most_, threads_;
    Window window_;
    int settled_{0};            // threads to go back to; 0: nothing is being tried
    double settled_mean_{0.0};  // [s] a step took with them, when last looked at; 0: not known
    double decided_mean_{0.0};  // [s] the same when they were decided upon
    double since_trial_{0.0};   // [s] of steps
    double pause_{0.0};         // [s] of steps until the next trial; 0: the first one
    int turn_{0};
};

}  // namespace headrace::server
