// One plain struct per request, reply and event. JSON names equal member names. SI units; the unit stands beside each
// member. `proto/README.md` tells the protocol in prose; `messages_json` maps these structs to JSON and back.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "proto/errors.h"
#include "proto/fields.h"
#include "proto/scene_desc.h"

namespace headrace::proto {

// ---- state ----------------------------------------------------------------------------------------------------------

enum class SimState { empty, loading, idle, running, faulted };

// ---- hello, describe ------------------------------------------------------------------------------------------------

struct Hello {};
struct HelloReply {
    std::string program{"headraced"};
    std::string version;
    int protocol{};
    std::string session;  // 16 hex digits, new at each server start; a restart shows as a new session
    // Ports beside the control port when on tcp; full endpoints when on ipc. The client keeps its own host name.
    std::optional<int> events_port, frames_port, data_port;
    std::optional<std::string> events_endpoint, frames_endpoint, data_endpoint;
    int threads{};                      // OpenMP team of the solver
    std::int64_t soft_message_limit{};  // [bytes] larger requests are answered with message_too_large
    std::int64_t hard_message_limit{};  // [bytes] larger messages disconnect the peer
};

struct Describe {};  // reply: an OpenRPC document, built from the command table

// ---- scenes ---------------------------------------------------------------------------------------------------------

struct SceneLoad {
    std::variant<std::string, SceneDesc> scene;  // a preset's name, or the document itself
    Parameters parameters;                       // overrides on top of the scene's own, optional
};
struct SceneLoadReply {
    std::string scene;
    std::uint64_t step{};
    double time{};  // [s]
    std::int64_t particles{};
    double time_step{};  // [s]
    SimState state{SimState::idle};
    std::vector<std::string> objects;  // names, in the scene's order
};

struct SceneGet {};  // reply: SceneDesc as loaded (with the overrides of scene.load)

struct SceneList {};
struct SceneSummary {
    std::string name;
    std::string description;
    int dimensions{};
    std::int64_t particles{};  // how many its lattice gives
};
struct SceneListReply {
    std::vector<SceneSummary> scenes;
};

// ---- running --------------------------------------------------------------------------------------------------------

struct SimStep {
    std::int64_t steps{1};
};

// When a run ends. At most one of the targets; none: until paused or cancelled.
struct RunUntil {
    std::optional<double> time;               // [s] absolute simulated time
    std::optional<double> duration;           // [s] simulated time from now
    std::optional<std::int64_t> step;         // absolute step number
    std::optional<std::int64_t> steps;        // steps from now
    std::optional<bool> at_rest;              // true: the scene's at_rest criterion
    std::optional<ProbeConditionDesc> probe;  // the probe's last sample fulfils it
    std::optional<double> timeout;            // [s] simulated time from now after which the run ends as timed_out;
                                              // for at_rest the scene's own time-out holds when this is absent
};
struct SimRun {
    RunUntil until;
    bool wait{false};            // true: the reply is sent when the run has ended
    std::optional<double> pace;  // simulated seconds per wall second at most; absent: as fast as possible
};

enum class JobState { running, paused, finished, cancelled, timed_out, faulted };

// Reply to sim.step, sim.run and job.wait.
struct JobReply {
    std::uint64_t job{};
    JobState state{JobState::running};
    std::string reason;  // why it ended: "step 40 reached", "at rest", ...; empty while running
    std::uint64_t step{};
    double time{};         // [s]
    std::int64_t steps{};  // done by this job
    double wall_s{};       // [s] spent in this job
};

struct JobWait {
    std::uint64_t job{};
    std::optional<double> timeout;  // [s] wall time; then error timed_out
};

struct SimPause {};   // reply: Applied; the job stays and can be resumed
struct SimResume {};  // continues the paused job, or starts an open-ended run; reply: JobReply
struct SimCancel {};  // ends the running or paused job, or the load under way; reply: Applied
struct SimReset {};   // loads the scene anew: step 0, its own objects and parameters; reply: SceneLoadReply

// Reply to a mutation: where in the run it was applied.
struct Applied {
    std::uint64_t step{};         // before this step is computed
    double time{};                // [s]
    std::optional<bool> pending;  // true, sim.pause, sim.cancel: a long step is still under way; it is the last one
};

struct SimStatus {
    bool hash{false};  // true: a fresh state hash is computed before the reply (at the next step boundary when running)
};
struct StateHash {
    std::string value;  // 16 hex digits; definition: server/solver/diagnostics.h and proto/README.md
    std::uint64_t step{};
};
struct PlanStage {
    std::string stage;
    bool active{};
    std::string reason;  // why it is skipped, or what it does
    double seconds{};    // [s] wall time spent in it so far
};
struct FaultReport {
    std::string criterion;  // "non_finite", "left_domain", "density", "speed", "time_step"
    std::uint32_t particle{};
    Vec3 position{};  // [m] last known
    Vec3 velocity{};  // [m/s]
    std::uint64_t step{};
    double time{};  // [s]
    std::string remedy;
};
struct Diagnostics {
    double max_speed{};         // [m/s]
    double kinetic_energy{};    // [J] (2D: per metre)
    double potential_energy{};  // [J] relative to the origin along gravity
    double mean_density{};      // [kg/m^3]
    double max_density{};       // [kg/m^3]
};
enum class StreamMode { live, lossless };

// A stream as the server sees it.
struct StreamState {
    std::string stream;
    StreamMode mode{StreamMode::live};
    bool subscribed{};       // live: somebody listens; lossless: not closing
    std::uint64_t frames{};  // captured so far
    // lossless:
    std::optional<std::int64_t> behind;  // frames captured and not acknowledged
    std::optional<std::int64_t> window;  // at `behind` == `window` the run waits, or the stream fails
};
struct SimStatusReply {
    SimState state{SimState::empty};
    std::optional<std::string> scene;
    std::optional<std::string> model;
    std::optional<int> dimensions;  // 2 or 3
    // How its pairs are summed: scheme, precision, instruction set. Another one may change the last bits of a run.
    std::optional<std::string> strategy;
    std::optional<std::int64_t> threads;  // that its steps take just now
    std::uint64_t step{};
    double time{};                // [s]
    double time_step{};           // [s] of the last step, or of the next one before the first
    std::string time_step_limit;  // what limits it: "fixed" or a criterion's name
    std::int64_t particles{};
    double steps_per_second{};    // wall, over the last second or so of running
    double real_time_factor{};    // simulated seconds per wall second, likewise
    std::optional<JobReply> job;  // the running or paused one, else the last one
    std::optional<Diagnostics> diagnostics;
    std::optional<StateHash> state_hash;
    std::optional<FaultReport> fault;
    std::vector<PlanStage> plan;
    std::int64_t streams{};            // open ones
    std::vector<StreamState> readers;  // each of them
    std::int64_t recordings{};         // running ones
    bool stalled{};                    // a lossless reader holds the run up just now
    double load_progress{};            // 0..1 while loading
    double uptime_s{};
};

// One particle explained; a query that is answered between two steps.
struct SimInspect {
    std::uint32_t id{};
};
struct InspectedNeighbour {
    std::optional<std::uint32_t> id;    // of a fluid particle,
    std::optional<std::string> object;  // or the object that a wall's particle stands for
    double distance{};                  // [m]
    double weight{};                    // [1] V_j W_ij
};
struct InspectedTerm {
    std::string term;     // as in the plan
    Vec3 acceleration{};  // [m/s^2]
};
struct SimInspectReply {
    std::uint64_t step{};
    double time{};  // [s]
    std::uint32_t id{};
    Vec3 position{};                             // [m]
    Vec3 velocity{};                             // [m/s]
    Vec3 acceleration{};                         // [m/s^2]
    double density{};                            // [kg/m^3]
    double pressure{};                           // [Pa]
    double concentration{};                      // [1] sum of V_j W_ij, itself and walls included
    double min_eigenvalue{};                     // [1] smallest of the moment matrix
    std::vector<InspectedNeighbour> neighbours;  // nearest first
    std::vector<InspectedTerm> terms;            // they add up to the acceleration
};

// ---- parameters -----------------------------------------------------------------------------------------------------

struct ParamsGet {
    std::vector<std::string> names;  // empty: all
};
struct ParameterEntry {
    std::string name;
    ParameterValue value;
    ParameterValue default_value;  // for this scene's dimensions and spacing
    std::string unit;
    std::string meaning;
};
struct ParamsGetReply {
    std::vector<ParameterEntry> parameters;
};
struct ParamsSet {
    Parameters parameters;                // all or none are applied
    std::optional<std::int64_t> at_step;  // applied before this step instead of the next one
};
struct ParamsSetReply {
    std::uint64_t step{};
    double time{};  // [s]
    Parameters previous;
};

// ---- objects --------------------------------------------------------------------------------------------------------

struct ObjectsList {};
struct ObjectsListReply {
    std::vector<ObjectDesc> objects;
};
struct ObjectsAdd {
    ObjectDesc object;
};
struct ObjectsMove {
    std::string name;
    std::optional<Vec3> to;  // [m] new centre of the shape; exactly one of `to` and `by`
    std::optional<Vec3> by;  // [m] displacement
};
struct ObjectsRemove {
    std::string name;
};

// ---- probes ---------------------------------------------------------------------------------------------------------

struct ProbeColumn {
    std::string name;
    std::string unit;                // "1" for a ratio
    std::optional<double> position;  // [m] of a profile's point along its line

    bool operator==(const ProbeColumn&) const = default;
};
// Values in the columns' order; nothing where there is no fluid to measure.
using ProbeRow = std::vector<std::optional<double>>;

struct ProbesList {};
struct ProbeState {
    ProbeDesc probe;
    std::vector<ProbeColumn> columns;    // time first
    std::int64_t samples{};              // kept
    std::int64_t dropped{};              // older ones that the server no longer holds
    ProbeRow latest;                     // the last sample; empty: none yet
    std::optional<std::string> failure;  // why it cannot be evaluated
};
struct ProbesListReply {
    std::vector<ProbeState> probes;  // in the scene's order
};
struct ProbesGet {
    std::optional<std::string> name;  // absent: all
    std::optional<double> since;      // [s] samples after this time
    std::int64_t limit{10'000};       // samples of each probe at most, the oldest ones
};
struct ProbeSeries {
    std::string name;
    std::vector<ProbeColumn> columns;  // time first
    std::vector<ProbeRow> rows;        // ascending in time
    std::int64_t dropped{};            // samples that the server no longer holds
};
struct ProbesGetReply {
    std::vector<ProbeSeries> probes;
    std::optional<double> complete_to;  // [s] no row up to here is missing: ask again with this as `since`
};
struct ProbesAdd {
    ProbeDesc probe;
};
struct ProbesRemove {
    std::string name;
};

// Message of the channel `probes` of recordings: what was sampled at one instant.
struct ProbeSample {
    std::string probe;
    std::vector<ProbeColumn> columns;  // without time; empty: as in the sample of this probe before
    ProbeRow values;                   // without time
};
struct ProbeSamples {
    double time{};  // [s]
    std::vector<ProbeSample> samples;
};

// ---- frames and streams ---------------------------------------------------------------------------------------------

enum class Precision { f4, f8 };
enum class OnStall { pause, fail };

struct FrameGet {  // data socket; reply message: JSON part, then one frame part
    FieldSet fields{kDefaultFields};
    Precision precision{Precision::f4};
};
struct FrameGetReply {
    std::uint64_t step{};
    double time{};  // [s]
    std::int64_t bytes{};
};

struct StreamOpen {
    StreamMode mode{StreamMode::live};
    FieldSet fields{kDefaultFields};
    Precision precision{Precision::f4};
    // live: at most this many frames per wall second. [1/s]
    std::optional<double> rate;
    // lossless, one of the two: a frame per so much simulated time [s], or every so many steps. Default: every step.
    std::optional<double> interval;
    std::optional<std::int64_t> every_steps;
    // lossless only:
    std::int64_t window{16};  // frames sent and not acknowledged, at most
    OnStall on_stall{OnStall::pause};
    double stall_timeout{60.0};          // [s] wall; with `pause`, the stream fails when the window stays full so long
    std::optional<std::string> resume;   // an open lossless stream to take over after a reconnect
    std::optional<std::uint64_t> acked;  // with resume: last sequence number the client has; sending goes on after it
};
struct StreamOpenReply {
    std::string stream;  // its id, and its topic on the frames socket
    StreamMode mode{StreamMode::live};
    std::int64_t window{};  // granted: less than asked for when the frames are large
    std::uint64_t next_seq{1};
    std::uint64_t step{};
    double time{};  // [s]
};
struct StreamAck {
    std::string stream;
    std::uint64_t seq{};  // cumulative: this one and all before it have arrived
};
struct StreamAckReply {
    std::uint64_t acked{};
};
struct StreamClose {
    std::string stream;
};
struct StreamCloseReply {
    std::uint64_t frames{};    // captured over the stream's life
    std::uint64_t last_seq{};  // lossless: frames up to this one still arrive
};

// ---- recordings -----------------------------------------------------------------------------------------------------

enum class Compression { none, zstd };

struct RecordStart {
    std::string file;   // relative to the server's data folder; ends in .mcap
    FieldSet fields{};  // empty: the scene's output fields
    Precision precision{Precision::f4};
    std::optional<double> interval;  // [s] simulated; absent (and no every_steps): the scene's output interval
    std::optional<std::int64_t> every_steps;
    Compression compression{Compression::none};
    bool overwrite{false};
};
struct RecordStartReply {
    std::string recording;  // its id
    std::string file;
    std::uint64_t step{};
    double time{};  // [s]
};
struct RecordStop {
    std::optional<std::string> recording;  // absent: the only one
};
struct RecordStopReply {
    std::string recording;
    std::string file;
    std::uint64_t frames{};
    std::uint64_t gaps{};
    std::int64_t bytes{};
    std::uint64_t step{};
    double time{};  // [s]
};

// ---- events ---------------------------------------------------------------------------------------------------------

using EventValue = std::variant<bool, std::int64_t, double, std::string>;

// Types: proto/event_types.h.
struct Event {
    std::uint64_t seq{};  // from 1, gap-free within a session
    std::string type;
    std::uint64_t step{};
    double time{};        // [s] simulated
    double wall_clock{};  // [s] since 1970-01-01 UTC
    std::string message;  // for a person
    std::map<std::string, EventValue> data;
    std::optional<std::vector<ObjectDesc>> objects;  // the whole list after a change of objects
};
struct EventsSince {
    std::uint64_t seq{0};            // events after this number
    double timeout{0.0};             // [s] wall; waits so long when there are none yet (long poll)
    std::vector<std::string> types;  // empty: all
    std::int64_t limit{1000};
};
struct EventsSinceReply {
    std::vector<Event> events;
    std::uint64_t last_seq{};  // ask again with this
    std::uint64_t lost{};      // events that the server's memory no longer holds
};

struct ServerShutdown {};  // reply: Applied, then the server ends; recordings are closed

// ---- envelopes ------------------------------------------------------------------------------------------------------

// What another thread answers for the service thread.
using Reply =
    std::variant<Applied, SceneLoadReply, JobReply, ParamsSetReply, StreamOpenReply, StreamAckReply, StreamCloseReply,
                 FrameGetReply, RecordStartReply, RecordStopReply, StateHash, SimInspectReply>;

}  // namespace headrace::proto
