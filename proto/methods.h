// The methods of the protocol: name, params, result, socket. The one list behind `describe`, the schema files and the
// tests; handlers and their states are the server's.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>

#include "proto/messages.h"

namespace headrace::proto {

// Which socket takes a method. data: where frames are fetched and lossless ones arrive. both: either of the two.
enum class MethodSocket { control, data, both };

struct OpenRpcDocument {};  // result of `describe`, made by the server

struct MethodInfo {
    std::string_view name;
    MethodSocket socket;
    std::string_view summary;  // one sentence
};

template <class ParamsT, class ResultT>
struct Method {
    using Params = ParamsT;
    using Result = ResultT;
    MethodInfo info;
};

inline constexpr std::tuple kMethodTypes{
    Method<Hello, HelloReply>{{"hello", MethodSocket::control, "Says who the server is and where its sockets are."}},
    Method<Describe, OpenRpcDocument>{
        {"describe", MethodSocket::control, "Describes every method as an OpenRPC document."}},
    Method<SceneLoad, SceneLoadReply>{
        {"scene.load", MethodSocket::control, "Builds a scene, a preset or a document, and makes it the simulation."}},
    Method<SceneGet, SceneDesc>{
        {"scene.get", MethodSocket::control, "Gives the scene as it was loaded, with its overrides."}},
    Method<SceneList, SceneListReply>{
        {"scene.list", MethodSocket::control, "Lists the scenes that come with the server."}},
    Method<SimStep, JobReply>{
        {"sim.step", MethodSocket::control, "Does so many steps and replies when they are done."}},
    Method<SimRun, JobReply>{{"sim.run", MethodSocket::control,
                              "Starts a run as a job, until a time, a step, rest, a probe's value or a pause."}},
    Method<JobWait, JobReply>{{"job.wait", MethodSocket::control, "Replies when the job has ended."}},
    Method<SimPause, Applied>{
        {"sim.pause", MethodSocket::control, "Pauses the run before the next step; its job stays."}},
    Method<SimResume, JobReply>{
        {"sim.resume", MethodSocket::control, "Continues the paused job, or starts an open-ended run."}},
    Method<SimCancel, Applied>{
        {"sim.cancel", MethodSocket::control, "Ends the running or paused job, or the load under way."}},
    Method<SimReset, SceneLoadReply>{
        {"sim.reset", MethodSocket::control, "Loads the scene anew, with its own objects and parameters."}},
    Method<SimStatus, SimStatusReply>{
        {"sim.status", MethodSocket::control, "Gives state, clock, diagnostics, plan and, on request, a state hash."}},
    Method<SimInspect, SimInspectReply>{
        {"sim.inspect", MethodSocket::control, "Explains one particle: its neighbours and the force of each term."}},
    Method<ParamsGet, ParamsGetReply>{
        {"params.get", MethodSocket::control, "Gives model parameters with default, unit and meaning."}},
    Method<ParamsSet, ParamsSetReply>{
        {"params.set", MethodSocket::control, "Sets model parameters between two steps, all or none."}},
    Method<ObjectsList, ObjectsListReply>{{"objects.list", MethodSocket::control, "Lists the collision objects."}},
    Method<ObjectsAdd, Applied>{{"objects.add", MethodSocket::control, "Adds a collision object between two steps."}},
    Method<ObjectsMove, Applied>{
        {"objects.move", MethodSocket::control, "Moves a collision object between two steps."}},
    Method<ObjectsRemove, Applied>{
        {"objects.remove", MethodSocket::control, "Removes a collision object between two steps."}},
    Method<ProbesList, ProbesListReply>{
        {"probes.list", MethodSocket::control, "Lists the probes with their columns and last samples."}},
    Method<ProbesGet, ProbesGetReply>{
        {"probes.get", MethodSocket::control, "Gives the samples of one probe or of all, after a time."}},
    Method<ProbesAdd, Applied>{{"probes.add", MethodSocket::control, "Adds a probe between two steps."}},
    Method<ProbesRemove, Applied>{{"probes.remove", MethodSocket::control, "Removes a probe between two steps."}},
    Method<FrameGet, FrameGetReply>{
        {"frame.get", MethodSocket::data, "Replies with a frame of the present state as a second message part."}},
    Method<StreamOpen, StreamOpenReply>{
        {"stream.open", MethodSocket::both, "Opens a live stream, or on the data socket a lossless one."}},
    Method<StreamAck, StreamAckReply>{
        {"stream.ack", MethodSocket::data, "Acknowledges the frames of a lossless stream up to a number."}},
    Method<StreamClose, StreamCloseReply>{{"stream.close", MethodSocket::both, "Closes a stream."}},
    Method<RecordStart, RecordStartReply>{
        {"record.start", MethodSocket::control, "Starts a recording in the server's data folder."}},
    Method<RecordStop, RecordStopReply>{{"record.stop", MethodSocket::control, "Finishes a recording."}},
    Method<EventsSince, EventsSinceReply>{
        {"events.since", MethodSocket::control, "Gives the events after a number, waiting for one if asked to."}},
    Method<ServerShutdown, Applied>{
        {"server.shutdown", MethodSocket::control, "Closes recordings and ends the server."}},
};

inline constexpr std::size_t kMethodCount = std::tuple_size_v<decltype(kMethodTypes)>;

inline constexpr std::array<MethodInfo, kMethodCount> kMethods = std::apply(
    [](const auto&... method) { return std::array<MethodInfo, kMethodCount>{method.info...}; }, kMethodTypes);

constexpr const MethodInfo* find_method(std::string_view name) {
    for (const MethodInfo& info : kMethods)
        if (info.name == name) return &info;
    return nullptr;
}

}  // namespace headrace::proto
