#include "server/publish/frame_hub.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

namespace headrace::publish {

namespace {

// Rounds down; an interval of next to nothing must not leave the integer's range.
std::int64_t whole(double count) {
    return static_cast<std::int64_t>(std::fmin(std::floor(count), 9e15));
}

}  // namespace

FrameHub::Entry* FrameHub::find(DemandId id) {
    const auto place =
        std::find_if(entries_.begin(), entries_.end(), [id](const Entry& entry) { return entry.demand.id == id; });
    return place == entries_.end() ? nullptr : &*place;
}

const FrameHub::Entry* FrameHub::find(DemandId id) const {
    return const_cast<FrameHub*>(this)->find(id);
}

void FrameHub::wake_simulation() const {
    if (waker_) waker_();
}

void FrameHub::set_waker(std::function<void()> wake_simulation) {
    waker_ = std::move(wake_simulation);
}

// ---- publisher's side -----------------------------------------------------------------------------------------------

DemandId FrameHub::add(Demand demand, bool active) {
    DemandId id = 0;
    {
        const std::lock_guard lock(mutex_);
        id = demand.id = ++last_id_;
        entries_.push_back({});
        entries_.back().demand = std::move(demand);
        entries_.back().active = active;
    }
    wake_simulation();
    return id;
}

void FrameHub::remove(DemandId id) {
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(entries_, [id](const Entry& entry) { return entry.demand.id == id; });
        std::erase_if(captures_, [id](const CaptureFor& capture) { return capture.demand == id; });
    }
    wake_simulation();
}

void FrameHub::release(DemandId id, std::int64_t captures) {
    {
        const std::lock_guard lock(mutex_);
        Entry* entry = find(id);
        if (entry == nullptr) return;
        entry->outstanding = std::max<std::int64_t>(0, entry->outstanding - captures);
        if (entry->is_full()) return;
        entry->holding_since.reset();
    }
    wake_simulation();
}

void FrameHub::set_credits(DemandId id, std::int64_t credits) {
    {
        const std::lock_guard lock(mutex_);
        Entry* entry = find(id);
        if (entry == nullptr) return;
        entry->demand.credits = credits;
        if (entry->is_full()) return;
        entry->holding_since.reset();
    }
    wake_simulation();
}

void FrameHub::restart_hold(DemandId id) {
    const std::lock_guard lock(mutex_);
    Entry* entry = find(id);
    if (entry != nullptr && entry->holding_since) entry->holding_since = std::chrono::steady_clock::now();
}

void FrameHub::fail(DemandId id) {
    const std::lock_guard lock(mutex_);
    std::erase_if(entries_, [id](const Entry& entry) { return entry.demand.id == id; });
    failed_.push_back(id);
    doorbell_.ring();
}

void FrameHub::set_active(DemandId id, bool active) {
    const std::lock_guard lock(mutex_);
    if (Entry* entry = find(id)) entry->active = active;
}

void FrameHub::request_frame(DemandId id) {
    {
        const std::lock_guard lock(mutex_);
        if (Entry* entry = find(id)) entry->wants_now = true;
    }
    wake_simulation();
}

std::vector<CaptureFor> FrameHub::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(captures_, {});
}

std::vector<DemandId> FrameHub::take_failed() {
    const std::lock_guard lock(mutex_);
    return std::exchange(failed_, {});
}

std::optional<std::chrono::steady_clock::time_point> FrameHub::holding_since(DemandId id) const {
    const std::lock_guard lock(mutex_);
    const Entry* entry = find(id);
    return entry != nullptr ? entry->holding_since : std::nullopt;
}

std::uint64_t FrameHub::generation() const {
    const std::lock_guard lock(mutex_);
    return generation_;
}

// ---- simulation's side ----------------------------------------------------------------------------------------------

std::size_t FrameHub::demands() const {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(
        std::count_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.active; }));
}

bool FrameHub::may_step() {
    const std::lock_guard lock(mutex_);
    bool may = true;
    bool news = false;
    for (Entry& entry : entries_) {
        if (entry.demand.when_full != WhenFull::hold || !entry.active || !entry.is_full()) continue;
        may = false;
        if (entry.holding_since) continue;
        entry.holding_since = std::chrono::steady_clock::now();
        news = true;
    }
    // The publisher watches the stall time of whoever holds the simulation up.
    if (news) doorbell_.ring();
    return may;
}

void FrameHub::not_stepping() {
    const std::lock_guard lock(mutex_);
    for (Entry& entry : entries_) entry.holding_since.reset();
}

bool FrameHub::is_due(const Entry& entry, const Moment& now) const {
    if (!entry.active) return false;
    if (entry.wants_now) return true;
    if (!entry.origin || entry.demand.trigger == Trigger::once || now.step == entry.last_step) return false;
    const auto count = static_cast<double>(entry.triggers + 1);
    switch (entry.demand.trigger) {
        case Trigger::every_steps:
            return now.step >=
                   entry.origin->step + static_cast<std::uint64_t>((entry.triggers + 1) * entry.demand.every_steps);
        case Trigger::interval:
            // Times are sums of many steps: a millionth of an interval early is on time.
            return now.time >= entry.origin->time + (count - 1e-6) * entry.demand.interval;
        case Trigger::rate:
            return std::chrono::duration<double>(now.wall - entry.origin->wall).count() >=
                   count * entry.demand.interval;
        case Trigger::once:
            break;
    }
    return false;
}

// Counts the triggers that have passed, so that a late frame does not shift the ones after it.
void FrameHub::count_trigger(Entry& entry, const Moment& now) {
    if (!entry.origin) {
        entry.origin = now;
        entry.triggers = 0;
        return;
    }
    switch (entry.demand.trigger) {
        case Trigger::every_steps:
            entry.triggers = static_cast<std::int64_t>(now.step - entry.origin->step) / entry.demand.every_steps;
            break;
        case Trigger::interval:
            entry.triggers = whole((now.time - entry.origin->time) / entry.demand.interval + 1e-6);
            break;
        case Trigger::rate:
            entry.triggers =
                whole(std::chrono::duration<double>(now.wall - entry.origin->wall).count() / entry.demand.interval);
            break;
        case Trigger::once:
            break;
    }
}

void FrameHub::capture_due(const Moment& now, const Copy& copy) {
    // Which demands are due, and the union of their fields for each precision.
    std::vector<DemandId> due;
    std::array<proto::FieldSet, 2> fields;
    {
        const std::lock_guard lock(mutex_);
        for (Entry& entry : entries_) {
            if (!is_due(entry, now)) continue;
            if (entry.is_full()) {
                if (entry.demand.when_full == WhenFull::fail) failed_.push_back(entry.demand.id);
                if (entry.demand.when_full == WhenFull::skip) count_trigger(entry, now);
                continue;
            }
            auto& wanted = fields[static_cast<std::size_t>(entry.demand.precision)];
            wanted = wanted | entry.demand.fields;
            due.push_back(entry.demand.id);
        }
        for (const DemandId id : failed_)
            std::erase_if(entries_, [id](const Entry& entry) { return entry.demand.id == id; });
        if (!failed_.empty()) doorbell_.ring();
    }
    if (due.empty()) return;

    // The copies are made without the lock: the publisher goes on meanwhile.
    std::array<std::shared_ptr<const Capture>, 2> copies;
    try {
        for (const proto::Precision precision : {proto::Precision::f4, proto::Precision::f8}) {
            const auto k = static_cast<std::size_t>(precision);
            if (!fields[k].empty()) copies[k] = copy(fields[k], precision);
        }
    } catch (const std::bad_alloc&) {
        // Asked again it would fail again: the consumers are told instead.
        for (const DemandId id : due) fail(id);
        return;
    }

    const std::lock_guard lock(mutex_);
    for (const DemandId id : due) {
        Entry* entry = find(id);
        if (entry == nullptr) continue;  // removed meanwhile
        captures_.push_back({id, copies[static_cast<std::size_t>(entry->demand.precision)]});
        ++entry->outstanding;
        entry->wants_now = false;
        entry->last_step = now.step;
        count_trigger(*entry, now);
    }
    doorbell_.ring();
}

void FrameHub::restart() {
    const std::lock_guard lock(mutex_);
    ++generation_;
    for (Entry& entry : entries_) {
        entry.origin.reset();
        entry.wants_now = true;
    }
}

}  // namespace headrace::publish
