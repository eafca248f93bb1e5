// A run of steps towards a target: what sim.step, sim.run and sim.resume start.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "server/outbox.h"

namespace headrace::server {

using Clock = std::chrono::steady_clock;

// Where in the run we are.
struct Place {
    std::uint64_t step{};
    double time{};  // [s]
};

struct Job {
    std::uint64_t number{};
    std::vector<Token> waiting;  // requests that are answered when the job ends

    // The target; none of them: until paused or cancelled.
    std::optional<std::uint64_t> until_step;
    std::optional<double> until_time;  // [s]
    bool until_at_rest{false};
    std::optional<proto::ProbeConditionDesc> until_probe;
    std::optional<double> timeout_time;  // [s] simulated time at which the job gives up

    std::optional<double> pace;     // simulated seconds per wall second
    Clock::time_point pace_wall{};  // the pace counts from here,
    double pace_time{};             // [s] and from this simulated time

    std::uint64_t first_step{};
    double wall_s{0.0};  // [s] before the last resume
    Clock::time_point resumed_at{};
    bool is_running{false};  // the clocks run

    static Job make(std::uint64_t number, const proto::RunUntil& until, const Place& now, double at_rest_timeout);

    void resume(const Place& now);  // starts or restarts the clocks
    void restart_pace(const Place& now);
    void pause();  // stops them

    // When the next step may begin, if a pace holds it back.
    std::optional<Clock::time_point> next_step_at(const Place& now, double dt) const;

    struct End {
        proto::JobState state{};
        std::string reason;
    };
    // Has the target been reached? `dt` [s]: a target time within a millionth of a step counts as reached.
    // `probe_holds`: in words, when until_probe does.
    std::optional<End> end(const Place& now, double dt, bool is_at_rest,
                           const std::optional<std::string>& probe_holds = {}) const;

    proto::JobReply reply(proto::JobState state, const std::string& reason, const Place& now) const;
};

// For a person: "finished", "timed out".
const char* ended_message(proto::JobState state);

}  // namespace headrace::server
