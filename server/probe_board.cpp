#include "server/probe_board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "proto/suggest.h"

namespace headrace::server {

// ---- one series ----

proto::ProbeRow ProbeBoard::Series::row(std::size_t index) const {
    proto::ProbeRow row(width());
    for (std::size_t k = 0; k < width(); ++k)
        if (const double value = values[index * width() + k]; !std::isnan(value)) row[k] = value;
    return row;
}

std::size_t ProbeBoard::Series::first_after(double time_wanted) const {
    std::size_t low = 0, high = size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (time(middle) > time_wanted)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

void ProbeBoard::Series::append(double at, const proto::ProbeRow& row) {
    const std::size_t most = std::max<std::size_t>(1, std::min(kMostSamples, kMostValues / width()));
    if (size() == most) {
        values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width()));
        ++dropped;
    }
    values.push_back(at);
    for (const auto& value : row) values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
}

const ProbeBoard::Series* ProbeBoard::find(const std::string& name) const {
    const auto place =
        std::find_if(series_.begin(), series_.end(), [&](const Series& s) { return s.probe.name == name; });
    return place == series_.end() ? nullptr : &*place;
}

// ---- simulation's side ----

void ProbeBoard::add_listener(Doorbell& doorbell) {
    const std::lock_guard lock(mutex_);
    listeners_.push_back(&doorbell);
}

void ProbeBoard::restart(std::uint64_t generation) {
    const std::lock_guard lock(mutex_);
    series_.clear();
    last_time_.reset();
    last_ = {last_.number, generation, {}};
    generation_ = generation;
}

void ProbeBoard::add(const proto::ProbeDesc& probe, const std::vector<proto::ProbeColumn>& columns) {
    Series series;
    series.probe = probe;
    series.columns.push_back({"time", "s", {}});
    series.columns.insert(series.columns.end(), columns.begin(), columns.end());
    const std::lock_guard lock(mutex_);
    series_.push_back(std::move(series));
}

void ProbeBoard::remove(const std::string& name) {
    const std::lock_guard lock(mutex_);
    std::erase_if(series_, [&](const Series& series) { return series.probe.name == name; });
}

void ProbeBoard::append(const proto::ProbeSamples& samples, const std::map<std::string, std::string>& failures) {
    const std::lock_guard lock(mutex_);
    last_time_ = samples.time;
    last_ = {last_.number + 1, generation_, samples};
    for (proto::ProbeSample& sample : last_.samples.samples) {
        const auto place =
            std::find_if(series_.begin(), series_.end(), [&](const Series& s) { return s.probe.name == sample.probe; });
        if (place == series_.end()) continue;
        place->append(samples.time, sample.values);
        place->failure.reset();
        if (const auto failure = failures.find(sample.probe); failure != failures.end())
            place->failure = failure->second;
        sample.columns.assign(place->columns.begin() + 1, place->columns.end());
    }
    if (!is_queueing_) return;
    queue_.push_back(last_);
    for (Doorbell* listener : listeners_) listener->ring();
}

// ---- any thread ----

proto::ProbesListReply ProbeBoard::list() const {
    const std::lock_guard lock(mutex_);
    proto::ProbesListReply reply;
    for (const Series& series : series_) {
        proto::ProbeState state{series.probe, series.columns, static_cast<std::int64_t>(series.size()), series.dropped,
                                {},           series.failure};
        if (series.size() > 0) state.latest = series.row(series.size() - 1);
        reply.probes.push_back(std::move(state));
    }
    return reply;
}

proto::Result<proto::ProbesGetReply> ProbeBoard::get(const proto::ProbesGet& query) const {
    const std::lock_guard lock(mutex_);
    std::vector<const Series*> wanted;
    std::vector<std::string> names;
    for (const Series& series : series_) {
        names.push_back(series.probe.name);
        if (!query.name || *query.name == series.probe.name) wanted.push_back(&series);
    }
    if (query.name && wanted.empty())
        return proto::Error{proto::ErrorCode::probe_not_found, "no probe \"" + *query.name + "\"", "params.name",
                            names.empty() ? "there are no probes" : proto::suggest(*query.name, names)};

    const double since = query.since.value_or(-std::numeric_limits<double>::infinity());
    std::size_t width = 0;
    for (const Series* series : wanted) width += series->width();
    const std::size_t limit = std::max<std::size_t>(
        1, std::min(static_cast<std::size_t>(query.limit), kMostValuesSent / std::max<std::size_t>(1, width)));

    // Where one series is cut off, all are: a reader asks again from one time.
    proto::ProbesGetReply reply;
    reply.complete_to = last_time_;
    for (const Series* series : wanted)
        if (const std::size_t first = series->first_after(since); series->size() - first > limit)
            reply.complete_to = std::min(*reply.complete_to, series->time(first + limit - 1));
    if (query.since && reply.complete_to) reply.complete_to = std::max(*reply.complete_to, *query.since);
    for (const Series* series : wanted) {
        proto::ProbeSeries part{series->probe.name, series->columns, {}, series->dropped};
        for (std::size_t k = series->first_after(since); k < series->size() && series->time(k) <= *reply.complete_to;
             ++k)
            part.rows.push_back(series->row(k));
        reply.probes.push_back(std::move(part));
    }
    return reply;
}

// ---- recordings ----

ProbeBoard::Instant ProbeBoard::begin_queue() {
    const std::lock_guard lock(mutex_);
    is_queueing_ = true;
    Instant last = last_;
    if (last.samples.samples.empty()) last.number = 0;
    return last;
}

void ProbeBoard::end_queue() {
    const std::lock_guard lock(mutex_);
    is_queueing_ = false;
    queue_.clear();
}

std::vector<ProbeBoard::Instant> ProbeBoard::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(queue_, {});
}

}  // namespace headrace::server
