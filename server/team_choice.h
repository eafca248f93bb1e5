// How many threads the steps of a run take: as many as there are, or fewer where that is faster.
//
// A short step is a hundred short loops, and each waits for the last of its threads. Where another program holds one of
// the processors, that wait is the scheduler's time slice, and fewer threads are faster, often by much. Nobody can tell
// beforehand, so it is tried: now and then some steps with half as many threads, one, or twice as many. Their number
// never changes a result. Loops of long steps balance what other programs take: they have all threads.
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
    };

    bool is_trial() const { return settled_ != 0; }
    void judge_trial();
    void judge_settled();
    void take_all();
    int candidate();

    int most_, threads_;
    Window window_;
    int settled_{0};            // threads to go back to; 0: nothing is being tried
    double mean_{0.0};          // [s] a step took with them, when last looked at
    double decided_mean_{0.0};  // [s] the same when they were decided upon; 0: not yet
    int trial_steps_{0};
    double since_trial_{0.0};  // [s] of steps
    double pause_{0.0};        // [s] of steps until the next trial
    int turn_{0};
};

}  // namespace headrace::server
