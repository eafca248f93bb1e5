#include "server/probes/probe_set.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "proto/suggest.h"

namespace headrace::probes {

namespace {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Result;
using proto::Status;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string in_unit(double value, const std::string& unit) {
    return number(value) + (unit == "1" ? "" : " " + unit);
}

// What is not finite (a run that is about to fault) is no value.
void drop_non_finite(proto::ProbeRow& values) {
    for (auto& value : values)
        if (value && !std::isfinite(*value)) value.reset();
}

constexpr double kSlack = 1e-9;  // [1] of the interval: times are sums of rounded time steps

}  // namespace

Status ProbeSet::add(const proto::ProbeDesc& desc, const RunView& run, const std::string& path) {
    if (find(desc.name) != nullptr)
        return Error{ErrorCode::probe_exists, "there is a probe \"" + desc.name + "\" already", path + ".name",
                     "choose another name, or probes.remove it first"};
    if (entries_.size() >= kMostProbes)
        return Error{ErrorCode::limit_exceeded, "there are " + std::to_string(kMostProbes) + " probes already", path,
                     "probes.remove some first"};
    if (Status checked = check_probe(desc, run, path); !checked) return checked;
    Entry entry;
    entry.desc = desc;
    entry.probe = make_probe(desc, run.particles.dimensions);
    entry.columns = entry.probe->columns();
    if (Status tried = try_out(entry, run, path); !tried) return tried;
    entries_.push_back(std::move(entry));
    return Done{};
}

// Refused now rather than silent later: what the model cannot tell, and objects that do not exist.
Status ProbeSet::try_out(const Entry& entry, const RunView& run, const std::string& path) const {
    if (const auto* force = std::get_if<proto::ForceProbe>(&entry.desc.kind)) {
        std::vector<std::string> names;
        for (const solver::CollisionObject& object : run.surroundings.objects) names.push_back(object.name);
        if (std::find(names.begin(), names.end(), force->object) == names.end())
            return Error{ErrorCode::object_not_found, "no object \"" + force->object + "\"",
                         path + ".kind.force.object",
                         names.empty() ? "the scene has no objects" : proto::suggest(force->object, names)};
    }
    if (entry.probe->region(0.0)) return Done{};
    proto::ProbeRow values(entry.columns.size());
    if (const Failure failure = entry.probe->sample(run, {}, values))
        return Error{ErrorCode::invalid_params, *failure, path + ".kind",
                     "choose another model or leave the probe out"};
    return Done{};
}

Status ProbeSet::remove(const std::string& name, const std::string& path) {
    const auto entry =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.desc.name == name; });
    if (entry == entries_.end())
        return Error{ErrorCode::probe_not_found, "no probe \"" + name + "\"", path,
                     is_empty() ? "there are no probes" : proto::suggest(name, names())};
    entries_.erase(entry);
    return Done{};
}

std::vector<std::string> ProbeSet::names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_) names.push_back(entry.desc.name);
    return names;
}

const proto::ProbeDesc* ProbeSet::find(const std::string& name) const {
    for (const Entry& entry : entries_)
        if (entry.desc.name == name) return &entry.desc;
    return nullptr;
}

std::vector<proto::ProbeColumn> ProbeSet::columns(const std::string& name) const {
    for (const Entry& entry : entries_)
        if (entry.desc.name == name) return entry.columns;
    return {};
}

bool ProbeSet::wants_energies() const {
    return std::any_of(entries_.begin(), entries_.end(),
                       [](const Entry& entry) { return std::holds_alternative<proto::EnergyProbe>(entry.desc.kind); });
}

// ---- samples ----

bool ProbeSet::is_due(const Entry& entry, const RunView& run) const {
    if (!entry.origin_time) return true;
    if (entry.desc.every_steps)
        return run.step >= entry.origin_step + entry.due * static_cast<std::uint64_t>(*entry.desc.every_steps);
    return run.time - *entry.origin_time >= (static_cast<double>(entry.due) - kSlack) * interval(entry);
}

// The first instant of the schedule that is still to come: a step longer than the interval skips some.
void ProbeSet::schedule_next(Entry& entry, const RunView& run) const {
    if (!entry.origin_time) {
        entry.origin_time = run.time;
        entry.origin_step = run.step;
    }
    const double passed =
        entry.desc.every_steps
            ? static_cast<double>((run.step - entry.origin_step) / static_cast<std::uint64_t>(*entry.desc.every_steps))
            : std::floor((run.time - *entry.origin_time) / interval(entry) + kSlack);
    entry.due = static_cast<std::uint64_t>(std::min(passed, 9e15)) + 1;
}

std::vector<Sample> ProbeSet::sample_due(const RunView& run) {
    std::vector<Sample> samples;
    std::vector<Entry*> due;
    for (Entry& entry : entries_)
        if (is_due(entry, run)) due.push_back(&entry);
    if (due.empty()) return samples;

    // One pass over the particles for all of them.
    std::vector<Region> regions;
    for (const Entry* entry : due)
        if (const auto region = entry->probe->region(run.model.support_radius())) regions.push_back(*region);
    const auto nearby = find_nearby(run.particles, run.surroundings.domain, regions);

    std::size_t next = 0;
    for (Entry* entry : due) {
        const bool has_region = entry->probe->region(0.0).has_value();
        const std::span<const NearParticle> near =
            has_region ? std::span<const NearParticle>(nearby[next++]) : std::span<const NearParticle>{};
        Sample sample{entry->desc.name, proto::ProbeRow(entry->columns.size()), {}, false};
        sample.failure = entry->probe->sample(run, near, sample.values);
        if (sample.failure) sample.values.assign(entry->columns.size(), std::nullopt);
        drop_non_finite(sample.values);
        sample.has_just_failed = sample.failure && !entry->has_failed;
        entry->has_failed = sample.failure.has_value();
        entry->latest = sample.values;
        schedule_next(*entry, run);
        samples.push_back(std::move(sample));
    }
    return samples;
}

// ---- conditions ----

// A whole name first: names may have dots themselves.
Result<ProbeSet::Member> ProbeSet::find_member(const std::string& reference, const std::string& path) const {
    const auto entry_of = [&](const std::string& name) {
        return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.desc.name == name; });
    };
    const auto names_of = [](const Entry& entry) {
        std::vector<std::string> names;
        for (const proto::ProbeColumn& column : entry.columns) names.push_back(entry.desc.name + "." + column.name);
        return names;
    };
    if (const auto whole = entry_of(reference); whole != entries_.end()) {
        if (whole->columns.size() == 1) return Member{&*whole, 0};
        return Error{ErrorCode::invalid_params, "probe \"" + reference + "\" has several values", path,
                     "name one: " + names_of(*whole).front() + ", ..."};
    }
    const std::size_t dot = reference.rfind('.');
    const auto entry = dot == std::string::npos ? entries_.end() : entry_of(reference.substr(0, dot));
    if (entry == entries_.end()) {
        std::vector<std::string> known;
        for (const Entry& e : entries_) known.push_back(e.columns.size() == 1 ? e.desc.name : names_of(e).front());
        return Error{ErrorCode::probe_not_found, "no probe \"" + reference + "\"", path,
                     known.empty() ? "there are no probes" : proto::suggest(reference, known)};
    }
    for (std::size_t k = 0; k < entry->columns.size(); ++k)
        if (entry->columns[k].name == reference.substr(dot + 1)) return Member{&*entry, k};
    return Error{ErrorCode::probe_not_found,
                 "probe \"" + entry->desc.name + "\" has no value \"" + reference.substr(dot + 1) + "\"", path,
                 proto::suggest(reference, names_of(*entry))};
}

Status ProbeSet::check(const proto::ProbeConditionDesc& condition, const std::string& path) const {
    const auto member = find_member(condition.probe, path + ".probe");
    if (!member) return member.error();
    return Done{};
}

std::optional<std::string> ProbeSet::probe_of(const proto::ProbeConditionDesc& condition) const {
    const auto member = find_member(condition.probe, "");
    if (!member) return std::nullopt;
    return member->entry->desc.name;
}

std::optional<std::string> ProbeSet::holds(const proto::ProbeConditionDesc& condition) const {
    const auto member = find_member(condition.probe, "");
    if (!member || member->entry->latest.empty()) return std::nullopt;
    const auto value = member->entry->latest[member->column];
    if (!value) return std::nullopt;
    const std::string& unit = member->entry->columns[member->column].unit;
    const std::string is = "probe " + condition.probe + " is " + in_unit(*value, unit);
    if (condition.above && *value > *condition.above) return is + ", above " + in_unit(*condition.above, unit);
    if (condition.below && *value < *condition.below) return is + ", below " + in_unit(*condition.below, unit);
    return std::nullopt;
}

}  // namespace headrace::probes
