// The probes of a run: which are due, what they gave last, and whether a condition on one holds. Without probes nothing
// is touched. Samples go to whoever calls: this keeps only the last one of each.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/probes/probe.h"

namespace headrace::probes {

inline constexpr std::size_t kMostProbes = 1'000;

// What one probe gave at one instant.
struct Sample {
    std::string probe;
    proto::ProbeRow values;
    std::optional<std::string> failure;  // why there are no values
    bool has_just_failed{false};         // the sample before had values
};

// Owner: the simulation thread, or whoever steps a run.
class ProbeSet {
  public:
    // output_interval: of probes that have none of their own [s].
    explicit ProbeSet(double output_interval) : output_interval_(output_interval) {}

    // Its first sample is of this state, by the next sample_due(). Errors: probe_exists, limit_exceeded;
    // object_not_found and invalid_params with a path below `path`, when it makes no sense or the model cannot give
    // what it measures. For a probe of energies the model must follow them already.
    proto::Status add(const proto::ProbeDesc& desc, const RunView& run, const std::string& path);
    proto::Status remove(const std::string& name, const std::string& path);

    // Evaluates what is due, in the order in which the probes were added.
    std::vector<Sample> sample_due(const RunView& run);

    // Should the model follow energies?
    bool wants_energies() const;
    bool is_empty() const { return entries_.empty(); }
    std::vector<std::string> names() const;  // in the order in which they were added
    const proto::ProbeDesc* find(const std::string& name) const;
    std::vector<proto::ProbeColumn> columns(const std::string& name) const;  // precondition: there is such a probe

    // Does the condition name a value that exists? Errors: probe_not_found with a path below `path`, and a suggestion.
    proto::Status check(const proto::ProbeConditionDesc& condition, const std::string& path) const;
    // In words, when it holds for the last sample: "probe gauge is 0.31 m, above 0.3 m".
    std::optional<std::string> holds(const proto::ProbeConditionDesc& condition) const;
    // The probe that a condition is about. Nothing: there is none.
    std::optional<std::string> probe_of(const proto::ProbeConditionDesc& condition) const;

  private:
    struct Entry {
        proto::ProbeDesc desc;
        std::unique_ptr<Probe> probe;
        std::vector<proto::ProbeColumn> columns;
        proto::ProbeRow latest;
        bool has_failed{false};
        // The schedule: sample `due` is taken origin + due * interval (or so many steps) after the probe was added.
        std::optional<double> origin_time;  // [s] nothing: not sampled yet
        std::uint64_t origin_step{};
        std::uint64_t due{0};
    };
    struct Member {
        const Entry* entry;
        std::size_t column;
    };

    bool is_due(const Entry& entry, const RunView& run) const;
    void schedule_next(Entry& entry, const RunView& run) const;
    double interval(const Entry& entry) const { return entry.desc.interval.value_or(output_interval_); }
    proto::Result<Member> find_member(const std::string& reference, const std::string& path) const;
    proto::Status try_out(const Entry& entry, const RunView& run, const std::string& path) const;

    double output_interval_;
    std::vector<Entry> entries_;
};

}  // namespace headrace::probes
