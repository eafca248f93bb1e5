// Hand-over of particle copies from the simulation to the publisher. The simulation asks before each step whether it
// may go on, and after each step whether somebody wants a frame; nothing is copied when nobody does.
//
// A *demand* is one consumer: a live stream, a lossless stream, a recording, or a single frame.get. Each has credits:
// captures that were handed over and not yet released. A lossless demand without credit holds the simulation up (or
// fails); a live one skips the frame.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "proto/fields.h"
#include "proto/messages.h"
#include "server/doorbell.h"

namespace headrace::publish {

using DemandId = std::uint64_t;

enum class Trigger { once, every_steps, interval, rate };
enum class WhenFull { hold, fail, skip };

struct Demand {
    DemandId id{};
    proto::FieldSet fields;
    proto::Precision precision{proto::Precision::f4};
    Trigger trigger{Trigger::once};
    std::int64_t every_steps{1};  // Trigger::every_steps
    double interval{};            // [s] simulated, Trigger::interval; [s] wall, Trigger::rate
    WhenFull when_full{WhenFull::hold};
    std::int64_t credits{1};
    bool wants_first{true};  // a frame of the present state at once
};

// A copy of the chosen fields at one step, rows ascending by particle id, in the dtype that travels.
struct Column {
    proto::Field field{};
    std::string_view dtype;
    int components{1};
    std::vector<std::byte> bytes;
};
struct Capture {
    std::uint64_t step{};
    double time{};        // [s]
    double wall_clock{};  // [s] since 1970-01-01 UTC
    int dimensions{3};
    std::size_t particles{};
    std::vector<Column> columns;  // ascending by field; union of what the demands of this precision want
};
struct CaptureFor {
    DemandId demand{};
    std::shared_ptr<const Capture> capture;
};

// The present of the run, as much as triggers need.
struct Moment {
    std::uint64_t step{};
    double time{};  // [s]
    std::chrono::steady_clock::time_point wall;
};

class FrameHub {
  public:
    using Copy = std::function<std::shared_ptr<const Capture>(proto::FieldSet, proto::Precision)>;

    // ---- publisher's side ----
    DemandId add(Demand demand);  // id is given; takes effect at the next step boundary
    void remove(DemandId id);
    void release(DemandId id, std::int64_t captures = 1);
    void set_active(DemandId id, bool active);  // live streams: is anybody subscribed?
    void request_frame(DemandId id);            // one more frame of the present state, as soon as possible
    std::vector<CaptureFor> take();
    bool is_full(DemandId id) const;
    std::vector<DemandId> take_failed();  // demands with WhenFull::fail that found no credit; they are removed
    server::Doorbell& doorbell() { return doorbell_; }  // rings when there is something to take
    void set_waker(std::function<void()> wake_simulation);

    // ---- simulation's side ----
    bool may_step() const;  // false: a demand with WhenFull::hold has no credit
    // Copies what is due now. `copy` is called once per precision in use at most, and not at all when nothing is due.
    void capture_due(const Moment& now, const Copy& copy);
    bool has_requests() const;               // somebody waits for a frame of the present state
    void restart_clocks(const Moment& now);  // after a load: intervals count from here

  private:
    struct Entry {
        Demand demand;
        std::int64_t outstanding{0};
        bool active{true};
        bool wants_now{true};
        std::optional<Moment> origin;  // of the first capture
        std::int64_t next{0};          // how many triggers have passed since
        std::chrono::steady_clock::time_point last_wall{};
    };
    bool is_due(Entry& entry, const Moment& now) const;

    mutable std::mutex mutex_;
    std::vector<Entry> entries_;
    std::vector<CaptureFor> captures_;
    std::vector<DemandId> failed_;
    DemandId last_id_{0};
    server::Doorbell doorbell_;
    std::function<void()> wake_simulation_;
};

}  // namespace headrace::publish
