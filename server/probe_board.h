// What the probes have given: written by the simulation, read by anyone without stopping it. The memory behind
// probes.list and probes.get, and the way of samples into recordings.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/doorbell.h"

namespace headrace::server {

class ProbeBoard {
  public:
    static constexpr std::size_t kMostSamples = 100'000;       // kept of one probe; older ones are dropped and counted
    static constexpr std::size_t kMostValues = 4'000'000;      // likewise: a profile keeps fewer samples
    static constexpr std::size_t kMostValuesSent = 2'000'000;  // in one reply

    // What was sampled at one instant, on its way into recordings.
    struct Instant {
        std::uint64_t number{};      // from 1
        std::uint64_t generation{};  // of the run, as the frames' captures count it
        proto::ProbeSamples samples;
    };

    // The bell rings when there is an instant to take; it outlives the board.
    void add_listener(Doorbell& doorbell);

    // ---- simulation's side ----
    void restart(std::uint64_t generation);  // another run: nothing is measured, nothing was
    void add(const proto::ProbeDesc& probe, const std::vector<proto::ProbeColumn>& columns);  // columns without time
    void remove(const std::string& name);
    // `failures`: of those that could not be evaluated, by name.
    void append(const proto::ProbeSamples& samples, const std::map<std::string, std::string>& failures);

    // ---- any thread ----
    proto::ProbesListReply list() const;
    // Errors: probe_not_found.
    proto::Result<proto::ProbesGetReply> get(const proto::ProbesGet& query) const;

    // ---- recordings ----
    Instant begin_queue();  // from here on instants are queued; returns the last one before (number 0: none)
    void end_queue();
    std::vector<Instant> take();

  private:
    // Rows behind each other, time first; NaN where there is no value.
    struct Series {
        proto::ProbeDesc probe;
        std::vector<proto::ProbeColumn> columns;  // time first
        std::deque<double> values;
        std::int64_t dropped{0};
        std::optional<std::string> failure;

        std::size_t width() const { return columns.size(); }
        std::size_t size() const { return values.size() / width(); }
        double time(std::size_t row) const { return values[row * width()]; }
        proto::ProbeRow row(std::size_t index) const;
        std::size_t first_after(double time) const;  // index of the first row that is later
        void append(double time, const proto::ProbeRow& row);
    };
    const Series* find(const std::string& name) const;

    mutable std::mutex mutex_;
    std::vector<Series> series_;  // in the order in which they were added
    std::optional<double> last_time_;
    std::uint64_t generation_{0};
    Instant last_;  // with columns
    bool is_queueing_{false};
    std::vector<Instant> queue_;
    std::vector<Doorbell*> listeners_;
};

}  // namespace headrace::server
