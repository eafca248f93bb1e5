// The events of a server: type, when it happens, members of `data`. The one list behind `describe` and the reference.
// Within a protocol number types are only added; a client ignores those that it does not know.
#pragma once

#include <array>
#include <string_view>

namespace headrace::proto {

struct EventTypeInfo {
    std::string_view type;
    std::string_view when;
    std::string_view data;    // names, with commas
    bool has_objects{false};  // the whole list of objects comes with it
};

inline constexpr EventTypeInfo kEventTypes[] = {
    {"server.started", "the server listens", ""},
    {"server.stopping", "the server ends; recordings are closed", ""},
    {"server.problem", "an internal error of a thread that went on", ""},
    {"scene.loaded", "a scene was loaded or reset", "scene", true},
    {"scene.load_failed", "a scene was refused while it was built, or its load was cancelled", "path"},
    {"job.started", "a run began", "job"},
    {"job.paused", "a run was paused", "job"},
    {"job.resumed", "a paused run goes on", "job"},
    {"job.ended", "a run finished, was cancelled, timed out or faulted", "job,reason"},
    {"sim.at_rest", "a run until at rest has come there", "job"},
    {"sim.not_at_rest", "an event of the scene waits for rest and at_rest.timeout has passed", "timeout"},
    {"sim.faulted", "the run stopped before garbage spread", "criterion,particle,remedy"},
    {"params.changed", "parameters were changed", "parameters"},
    {"object.added", "an object was added", "name", true},
    {"object.moved", "an object was moved", "name", true},
    {"object.removed", "an object was removed", "name", true},
    {"probe.added", "a probe was added", "probe"},
    {"probe.removed", "a probe was removed", "probe"},
    {"probe.failed", "a probe can no longer be evaluated", "probe"},
    {"scene_event.fired", "an event of the scene document fired", "event"},
    {"scene_event.failed", "what it should have done was refused; the run goes on without", "event,error"},
    {"stream.opened", "a lossless stream was opened", "stream"},
    {"stream.closed", "a lossless stream was closed", "stream"},
    {"stream.stalled", "the run has waited for a reader for a second", "stream"},
    {"stream.failed", "time-out, or a full window with on_stall: fail", "stream"},
    {"record.started", "a recording by the server began", "recording"},
    {"record.stopped", "a recording by the server is finished", "recording"},
    {"record.failed", "a recording by the server ended with an error; what it has is readable", "recording"},
};

constexpr const EventTypeInfo* find_event_type(std::string_view type) {
    for (const EventTypeInfo& info : kEventTypes)
        if (info.type == type) return &info;
    return nullptr;
}

}  // namespace headrace::proto
