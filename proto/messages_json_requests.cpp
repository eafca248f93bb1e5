// Params of every method, member by member.
#include "proto/json_describe.h"

namespace headrace::proto {

namespace {

constexpr std::size_t kMaxNames = 1000;
constexpr std::size_t kMaxParameters = 256;
constexpr double kMaxWindow = 1024;      // frames under way to one reader
constexpr double kMaxEvents = 10'000;    // in one reply
constexpr double kMaxSteps = 1e15;       // below 2^53: exact in every JSON library
constexpr double kMaxLongPoll = 60;      // [s] of events.since: ask again after each answer
constexpr double kMaxWait = 86'400'000;  // [s] 1000 days, far below the range of the clocks
constexpr std::size_t kMaxFileName = 255;

constexpr About kStreamId{.meaning = "id of the stream", .max_length = kMaxNameLength};

}  // namespace

void describe(Visitor&, Hello&) {}
void describe(Visitor&, Describe&) {}
void describe(Visitor&, SceneGet&) {}
void describe(Visitor&, SceneList&) {}
void describe(Visitor&, SimPause&) {}
void describe(Visitor&, SimResume&) {}
void describe(Visitor&, SimCancel&) {}
void describe(Visitor&, SimReset&) {}
void describe(Visitor&, ObjectsList&) {}
void describe(Visitor&, ServerShutdown&) {}

void describe(Visitor& v, SceneLoad& m) {
    v.required("scene", m.scene, {.meaning = "a preset's name, or a scene document"});
    v.optional("parameters", m.parameters,
               {.meaning = "model parameters that override the scene's own", .max_items = kMaxParameters});
}

void describe(Visitor& v, SimStep& m) {
    v.optional("steps", m.steps, {.meaning = "steps to do", .unit = "1", .range = between(1, kMaxSteps)});
}

void describe(Visitor& v, RunUntil& m) {
    v.optional("time", m.time, {.meaning = "absolute simulated time", .unit = "s", .range = kNotNegative});
    v.optional("duration", m.duration, {.meaning = "simulated time from now", .unit = "s", .range = kPositive});
    v.optional("step", m.step, {.meaning = "absolute step number", .unit = "1", .range = between(0, kMaxSteps)});
    v.optional("steps", m.steps, {.meaning = "steps from now", .unit = "1", .range = between(1, kMaxSteps)});
    v.optional("at_rest", m.at_rest, {.meaning = "until the fluid is at rest", .only_true = true});
    v.optional("probe", m.probe, {.meaning = "until the last sample of a probe is above or below a value"});
    v.optional("timeout", m.timeout,
               {.meaning = "simulated time from now after which the run ends as timed_out; at_rest has the scene's own",
                .unit = "s",
                .range = kPositive});
    v.at_most_one({{"time", m.time.has_value()},
                   {"duration", m.duration.has_value()},
                   {"step", m.step.has_value()},
                   {"steps", m.steps.has_value()},
                   {"at_rest", m.at_rest.has_value()},
                   {"probe", m.probe.has_value()}});
}

void describe(Visitor& v, SimRun& m) {
    v.optional("until", m.until, {.meaning = "when the run ends; without a target: when paused or cancelled"});
    v.optional("wait", m.wait, {.meaning = "true: the reply is sent when the run has ended"});
    v.optional("pace", m.pace,
               {.meaning = "simulated seconds per wall second at most; absent: as fast as possible",
                .unit = "1",
                .range = kPositive});
}

void describe(Visitor& v, JobWait& m) {
    v.required("job", m.job, {.meaning = "number of the job", .range = at_least(1)});
    v.optional("timeout", m.timeout,
               {.meaning = "wall time, then the error timed_out", .unit = "s", .range = between(0, kMaxWait)});
}

void describe(Visitor& v, SimStatus& m) {
    v.optional("hash", m.hash, {.meaning = "true: a fresh state hash is computed before the reply"});
}

void describe(Visitor& v, ParamsGet& m) {
    v.optional("names", m.names,
               {.meaning = "parameters asked for; none: all", .text = Text::name, .max_items = kMaxNames});
}

void describe(Visitor& v, ParamsSet& m) {
    v.required("parameters", m.parameters,
               {.meaning = "model parameters; all or none are applied", .min_items = 1, .max_items = kMaxParameters});
    v.optional(
        "at_step", m.at_step,
        {.meaning = "applied before this step instead of the next one", .unit = "1", .range = between(0, kMaxSteps)});
}

void describe(Visitor& v, ObjectsAdd& m) {
    v.required("object", m.object, {.meaning = "the new collision object"});
}

void describe(Visitor& v, ObjectsMove& m) {
    v.required("name", m.name, {.meaning = "object to move", .text = Text::name});
    v.optional("to", m.to, {.meaning = "new centre of the shape", .unit = "m"});
    v.optional("by", m.by, {.meaning = "displacement", .unit = "m"});
    v.exactly_one({{"to", m.to.has_value()}, {"by", m.by.has_value()}});
}

void describe(Visitor& v, ObjectsRemove& m) {
    v.required("name", m.name, {.meaning = "object to remove", .text = Text::name});
}

void describe(Visitor& v, FrameGet& m) {
    v.optional("fields", m.fields, {.meaning = "particle fields of the frame", .min_items = 1});
    v.optional("precision", m.precision, {.meaning = "of the fields that are not integers"});
}

void describe(Visitor& v, StreamOpen& m) {
    v.optional("mode", m.mode, {.meaning = "live may skip frames, lossless never does"});
    const bool is_live = m.mode == StreamMode::live;
    v.optional("fields", m.fields, {.meaning = "particle fields of each frame", .min_items = 1});
    v.optional("precision", m.precision, {.meaning = "of the fields that are not integers"});

    v.begin_only_when({"mode", "live", true}, is_live);
    v.optional("rate", m.rate, {.meaning = "frames per wall second at most", .unit = "1/s", .range = kPositive});
    v.end_only_when();

    v.begin_only_when({"mode", "lossless", false}, !is_live);
    v.optional("interval", m.interval, {.meaning = "simulated time between frames", .unit = "s", .range = kPositive});
    v.optional("every_steps", m.every_steps,
               {.meaning = "steps between frames; neither this nor interval: every step",
                .unit = "1",
                .range = between(1, kMaxSteps)});
    v.optional("window", m.window,
               {.meaning = "frames sent and not acknowledged, at most", .unit = "1", .range = between(1, kMaxWindow)});
    v.optional("on_stall", m.on_stall, {.meaning = "what happens to the run while the window is full"});
    v.optional("stall_timeout", m.stall_timeout,
               {.meaning = "wall time; with pause, the stream fails when the window stays full so long",
                .unit = "s",
                .range = between(0, kMaxWait)});
    v.optional("resume", m.resume,
               {.meaning = "open stream to take over after a reconnect", .max_length = kMaxNameLength});
    v.optional("acked", m.acked, {.meaning = "last sequence number the client has; sending goes on after it"});
    v.end_only_when();

    v.at_most_one({{"interval", m.interval.has_value()}, {"every_steps", m.every_steps.has_value()}});
    v.only_with({"acked", m.acked.has_value()}, {"resume", m.resume.has_value()});
}

void describe(Visitor& v, StreamAck& m) {
    v.required("stream", m.stream, kStreamId);
    v.required("seq", m.seq, {.meaning = "this frame and all before it have arrived"});
}

void describe(Visitor& v, StreamClose& m) {
    v.required("stream", m.stream, kStreamId);
}

void describe(Visitor& v, RecordStart& m) {
    v.required("file", m.file,
               {.meaning = "below the server's data folder, ends in .mcap",
                .text = Text::recording_file,
                .max_length = kMaxFileName});
    v.optional("fields", m.fields, {.meaning = "particle fields of each frame; none: the scene's output fields"});
    v.optional("precision", m.precision, {.meaning = "of the fields that are not integers"});
    v.optional("interval", m.interval,
               {.meaning = "simulated time between frames; neither this nor every_steps: the scene's output interval",
                .unit = "s",
                .range = kPositive});
    v.optional("every_steps", m.every_steps,
               {.meaning = "steps between frames", .unit = "1", .range = between(1, kMaxSteps)});
    v.optional("compression", m.compression, {.meaning = "of each frame in the file"});
    v.optional("overwrite", m.overwrite, {.meaning = "true: an existing file is replaced"});
    v.at_most_one({{"interval", m.interval.has_value()}, {"every_steps", m.every_steps.has_value()}});
}

void describe(Visitor& v, RecordStop& m) {
    v.optional("recording", m.recording,
               {.meaning = "id of the recording; absent: the only one", .max_length = kMaxNameLength});
}

void describe(Visitor& v, EventsSince& m) {
    v.optional("seq", m.seq, {.meaning = "events after this number"});
    v.optional(
        "timeout", m.timeout,
        {.meaning = "wall time to wait when there are none yet", .unit = "s", .range = between(0, kMaxLongPoll)});
    v.optional("types", m.types,
               {.meaning = "types of events asked for; none: all", .text = Text::name, .max_items = kMaxNames});
    v.optional("limit", m.limit, {.meaning = "events at most", .unit = "1", .range = between(1, kMaxEvents)});
}

}  // namespace headrace::proto
