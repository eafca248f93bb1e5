// Results of every method, and events, member by member.
#include "proto/json_describe.h"

namespace headrace::proto {

namespace {

constexpr About kStep{.meaning = "step number", .unit = "1"};
constexpr About kTime{.meaning = "simulated time", .unit = "s"};
constexpr About kObjects{.meaning = "collision objects, in the order they are tested"};

}  // namespace

void describe(Visitor& v, HelloReply& m) {
    v.required("program", m.program, {.meaning = "name of the server program"});
    v.required("version", m.version, {.meaning = "version of the server program"});
    v.required("protocol", m.protocol, {.meaning = "protocol number; a client refuses another one"});
    v.required("session", m.session, {.meaning = "16 hex digits, new at each server start"});
    v.optional("events_port", m.events_port, {.meaning = "tcp port of the events socket"});
    v.optional("frames_port", m.frames_port, {.meaning = "tcp port of the frames socket"});
    v.optional("data_port", m.data_port, {.meaning = "tcp port of the data socket"});
    v.optional("events_endpoint", m.events_endpoint, {.meaning = "endpoint of the events socket when on ipc"});
    v.optional("frames_endpoint", m.frames_endpoint, {.meaning = "endpoint of the frames socket when on ipc"});
    v.optional("data_endpoint", m.data_endpoint, {.meaning = "endpoint of the data socket when on ipc"});
    v.required("threads", m.threads, {.meaning = "threads of the solver", .unit = "1"});
    v.required("soft_message_limit", m.soft_message_limit,
               {.meaning = "larger requests are answered with message_too_large", .unit = "byte"});
    v.required("hard_message_limit", m.hard_message_limit,
               {.meaning = "larger messages disconnect the peer", .unit = "byte"});
}

void describe(Visitor& v, SceneLoadReply& m) {
    v.required("scene", m.scene, {.meaning = "name of the scene"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("particles", m.particles, {.meaning = "number of particles", .unit = "1"});
    v.required("time_step", m.time_step, {.meaning = "first time step", .unit = "s"});
    v.required("state", m.state, {.meaning = "state after loading"});
    v.required("objects", m.objects, {.meaning = "names of the objects, in the scene's order"});
}

void describe(Visitor& v, SceneSummary& m) {
    v.required("name", m.name, {.meaning = "name of the scene"});
    v.required("description", m.description, {.meaning = "what it shows"});
    v.required("dimensions", m.dimensions, {.meaning = "2 or 3"});
    v.required("particles", m.particles, {.meaning = "number of particles it gives", .unit = "1"});
}

void describe(Visitor& v, SceneListReply& m) {
    v.required("scenes", m.scenes, {.meaning = "the scenes that come with the server"});
}

void describe(Visitor& v, JobReply& m) {
    v.required("job", m.job, {.meaning = "number of the job"});
    v.required("state", m.state, {.meaning = "state of the job"});
    v.required("reason", m.reason, {.meaning = "why it ended; empty while it runs"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("steps", m.steps, {.meaning = "steps done by this job", .unit = "1"});
    v.required("wall_s", m.wall_s, {.meaning = "wall time spent in this job", .unit = "s"});
}

void describe(Visitor& v, Applied& m) {
    v.required("step", m.step, {.meaning = "applied before this step is computed", .unit = "1"});
    v.required("time", m.time, kTime);
    v.optional(
        "pending", m.pending,
        {.meaning = "sim.pause, sim.cancel: the step (or load) under way is still being computed, it is the last one"});
}

void describe(Visitor& v, StateHash& m) {
    v.required("value", m.value, {.meaning = "16 hex digits; equal for equal states"});
    v.required("step", m.step, kStep);
}

void describe(Visitor& v, PlanStage& m) {
    v.required("stage", m.stage, {.meaning = "name of the stage"});
    v.required("active", m.active, {.meaning = "false: left out"});
    v.required("reason", m.reason, {.meaning = "why it is left out, or what it does"});
    v.required("seconds", m.seconds, {.meaning = "wall time spent in it so far", .unit = "s"});
}

void describe(Visitor& v, FaultReport& m) {
    v.required("criterion", m.criterion,
               {.meaning = "what was violated: non_finite, left_domain, density, speed, time_step or internal_error"});
    v.required("particle", m.particle, {.meaning = "id of the particle"});
    v.required("position", m.position, {.meaning = "last known position", .unit = "m", .may_be_non_finite = true});
    v.required("velocity", m.velocity, {.meaning = "last known velocity", .unit = "m/s", .may_be_non_finite = true});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("remedy", m.remedy, {.meaning = "what usually helps"});
}

void describe(Visitor& v, Diagnostics& m) {
    v.required("max_speed", m.max_speed, {.meaning = "largest speed", .unit = "m/s", .may_be_non_finite = true});
    v.required("kinetic_energy", m.kinetic_energy,
               {.meaning = "kinetic energy (2D: per metre)", .unit = "J", .may_be_non_finite = true});
    v.required(
        "potential_energy", m.potential_energy,
        {.meaning = "potential energy relative to the origin (2D: per metre)", .unit = "J", .may_be_non_finite = true});
    v.required("mean_density", m.mean_density,
               {.meaning = "mean density", .unit = "kg/m^3", .may_be_non_finite = true});
    v.required("max_density", m.max_density,
               {.meaning = "largest density", .unit = "kg/m^3", .may_be_non_finite = true});
}

void describe(Visitor& v, StreamState& m) {
    v.required("stream", m.stream, {.meaning = "id of the stream"});
    v.required("mode", m.mode, {.meaning = "live may skip frames, lossless never does"});
    v.required("subscribed", m.subscribed, {.meaning = "live: somebody listens; lossless: it is not closing"});
    v.required("frames", m.frames, {.meaning = "frames captured so far", .unit = "1"});
    v.optional("behind", m.behind, {.meaning = "lossless: frames captured and not acknowledged", .unit = "1"});
    v.optional("window", m.window,
               {.meaning = "lossless: at so many behind the run waits, or the stream fails", .unit = "1"});
}

void describe(Visitor& v, SimStatusReply& m) {
    v.required("state", m.state, {.meaning = "state of the server"});
    v.optional("scene", m.scene, {.meaning = "name of the scene"});
    v.optional("model", m.model, {.meaning = "name of the model"});
    v.optional("dimensions", m.dimensions, {.meaning = "2 or 3: in 2D sums are per metre of depth", .unit = "1"});
    v.optional("strategy", m.strategy,
               {.meaning = "how its pairs are summed: scheme, precision, instruction set; another one may change the "
                           "last bits of a run"});
    v.optional(
        "threads", m.threads,
        {.meaning = "threads that its steps take just now: those of the server, or fewer where fewer have turned "
                    "out to be faster",
         .unit = "1"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("time_step", m.time_step, {.meaning = "of the last step, or of the next before the first", .unit = "s"});
    v.required("time_step_limit", m.time_step_limit, {.meaning = "what limits it: fixed, or a criterion"});
    v.required("particles", m.particles, {.meaning = "number of particles", .unit = "1"});
    v.required("steps_per_second", m.steps_per_second, {.meaning = "steps per wall second of late", .unit = "1/s"});
    v.required("real_time_factor", m.real_time_factor,
               {.meaning = "simulated seconds per wall second of late", .unit = "1"});
    v.optional("job", m.job, {.meaning = "the running or paused job, else the last one"});
    v.optional("diagnostics", m.diagnostics, {.meaning = "sums over all particles"});
    v.optional("state_hash", m.state_hash, {.meaning = "of the last pause or end of a run, or as asked for"});
    v.optional("fault", m.fault, {.meaning = "why the run is faulted"});
    v.required("plan", m.plan, {.meaning = "stages of a step, and those left out"});
    v.required("streams", m.streams, {.meaning = "open streams", .unit = "1"});
    v.optional("readers", m.readers, {.meaning = "each open stream; absent: none"});
    v.required("recordings", m.recordings, {.meaning = "running recordings", .unit = "1"});
    v.required("stalled", m.stalled, {.meaning = "a lossless reader holds the run up just now"});
    v.required("load_progress", m.load_progress, {.meaning = "0 to 1 while a scene is loading", .unit = "1"});
    v.required("uptime_s", m.uptime_s, {.meaning = "wall time since the server's start", .unit = "s"});
}

void describe(Visitor& v, ParameterEntry& m) {
    v.required("name", m.name, {.meaning = "name of the parameter"});
    v.required("value", m.value, {.meaning = "present value, in the unit below"});
    v.required("default_value", m.default_value, {.meaning = "default for the scene's dimensions and spacing"});
    v.required("unit", m.unit, {.meaning = "SI; 1 when it has none"});
    v.required("meaning", m.meaning, {.meaning = "what it does"});
}

void describe(Visitor& v, ParamsGetReply& m) {
    v.required("parameters", m.parameters, {.meaning = "the parameters asked for"});
}

void describe(Visitor& v, ParamsSetReply& m) {
    v.required("step", m.step, {.meaning = "applied before this step is computed", .unit = "1"});
    v.required("time", m.time, kTime);
    v.required("previous", m.previous, {.meaning = "values before the change"});
}

void describe(Visitor& v, ObjectsListReply& m) {
    v.required("objects", m.objects, kObjects);
}

void describe(Visitor& v, FrameGetReply& m) {
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("bytes", m.bytes, {.meaning = "size of the frame that follows", .unit = "byte"});
}

void describe(Visitor& v, StreamOpenReply& m) {
    v.required("stream", m.stream, {.meaning = "id of the stream, and its topic on the frames socket"});
    v.required("mode", m.mode, {.meaning = "live may skip frames, lossless never does"});
    v.required("window", m.window, {.meaning = "window granted", .unit = "1"});
    v.required("next_seq", m.next_seq, {.meaning = "sequence number of the next frame"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
}

void describe(Visitor& v, StreamAckReply& m) {
    v.required("acked", m.acked, {.meaning = "last sequence number acknowledged"});
}

void describe(Visitor& v, StreamCloseReply& m) {
    v.required("frames", m.frames, {.meaning = "frames captured over the stream's life", .unit = "1"});
    v.required("last_seq", m.last_seq, {.meaning = "lossless: frames up to this one still arrive"});
}

void describe(Visitor& v, RecordStartReply& m) {
    v.required("recording", m.recording, {.meaning = "id of the recording"});
    v.required("file", m.file, {.meaning = "file being written"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
}

void describe(Visitor& v, RecordStopReply& m) {
    v.required("recording", m.recording, {.meaning = "id of the recording"});
    v.required("file", m.file, {.meaning = "file that was written"});
    v.required("frames", m.frames, {.meaning = "frames written", .unit = "1"});
    v.required("gaps", m.gaps, {.meaning = "jumps in the frames' numbers", .unit = "1"});
    v.required("bytes", m.bytes, {.meaning = "size of the file", .unit = "byte"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
}

void describe(Visitor& v, Event& m) {
    v.required("seq", m.seq, {.meaning = "from 1, gap-free within a session"});
    v.required("type", m.type, {.meaning = "what happened"});
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("wall_clock", m.wall_clock, {.meaning = "seconds since 1970-01-01 UTC", .unit = "s"});
    v.required("message", m.message, {.meaning = "the same for a person"});
    v.optional("data", m.data, {.meaning = "details; which ones depends on the type"});
    v.optional("objects", m.objects, kObjects);
}

void describe(Visitor& v, EventsSinceReply& m) {
    v.required("events", m.events, {.meaning = "ascending in seq"});
    v.required("last_seq", m.last_seq, {.meaning = "ask again with this"});
    v.required("lost", m.lost, {.meaning = "events that the server no longer holds", .unit = "1"});
}

}  // namespace headrace::proto
