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
#include <string_view>
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
};

// A copy of the chosen fields at one step, rows ascending by particle id, in the dtype that travels.
struct Column {
    proto::Field field{};
    std::string_view dtype;
    int components{1};
    std::size_t size{};                  // [bytes]
    std::unique_ptr<std::byte[]> bytes;  // not zeroed first: every byte is written
};
struct Capture {
    std::uint64_t generation{};  // changes when another scene is loaded or the scene is reset
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
    DemandId add(Demand demand, bool active = true);  // id is given; takes effect at the next step boundary
    void remove(DemandId id);
    void release(DemandId id, std::int64_t captures = 1);
    void set_active(DemandId id, bool active);  // live streams: is anybody subscribed?
    void request_frame(DemandId id);            // one more frame of the present state, as soon as possible
    std::vector<CaptureFor> take();
    void set_credits(DemandId id, std::int64_t credits);
    void restart_hold(DemandId id);  // holding_since counts from now
    // This demand's consumer cannot take its captures: it is removed, and take_failed tells.
    void fail(DemandId id);
    std::vector<DemandId> take_failed();  // demands with WhenFull::fail that found no credit; they are removed
    // Since when has this demand held the simulation up? Nothing: it does not.
    std::optional<std::chrono::steady_clock::time_point> holding_since(DemandId id) const;
    server::Doorbell& doorbell() { return doorbell_; }  // rings when there is something to take
    void set_waker(std::function<void()> wake_simulation);

    // ---- simulation's side ----
    bool may_step();      // false: a demand with WhenFull::hold has no credit
    void not_stepping();  // paused or ended: nobody is held up
    // Copies what is due now. `copy` is called once per precision in use at most, and not at all when nothing is due.
    void capture_due(const Moment& now, const Copy& copy);
    // Who may want frames: all demands but live streams that nobody is subscribed to.
    std::size_t demands() const;
    // After a load or reset: another generation begins, intervals count from here, everybody gets the new state.
    void restart();
    std::uint64_t generation() const;

  private:
    struct Entry {
        Demand demand;
        std::int64_t outstanding{0};
        bool active{true};
        bool wants_now{true};          // a frame of the present state, whatever the trigger
        std::optional<Moment> origin;  // where the trigger's count began
        std::int64_t triggers{0};      // counted since
        std::uint64_t last_step{0};    // of the last capture
        std::optional<std::chrono::steady_clock::time_point> holding_since;

        bool is_full() const { return outstanding >= demand.credits; }
    };
    Entry* find(DemandId id);
    const Entry* find(DemandId id) const;
    bool is_due(const Entry& entry, const Moment& now) const;
    static void count_trigger(Entry& entry, const Moment& now);
    void wake_simulation() const;

    mutable std::mutex mutex_;
    std::vector<Entry> entries_;
    std::vector<CaptureFor> captures_;
    std::vector<DemandId> failed_;
    DemandId last_id_{0};
    std::uint64_t generation_{0};
    server::Doorbell doorbell_;
    std::function<void()> waker_;
};

}  // namespace headrace::publish
