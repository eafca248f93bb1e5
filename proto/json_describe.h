// Declares `describe` for every message; each is defined in messages_json_{scene,probes,requests,replies}.cpp.
#pragma once

#include "proto/json_members.h"

namespace headrace::proto {

// scene
void describe(Visitor& v, BoxDesc& box);
void describe(Visitor& v, SphereDesc& sphere);
void describe(Visitor& v, CylinderDesc& cylinder);
void describe(Visitor& v, PlaneDesc& plane);
void describe(Visitor& v, DifferenceDesc& difference);
void describe(Visitor& v, IntersectionDesc& intersection);
void describe(Visitor& v, TableDesc& table);
void describe(Visitor& v, FluidStartDesc& start);
void describe(Visitor& v, MotionDesc& motion);
void describe(Visitor& v, ParticleFileDesc& particles);
void describe(Visitor& v, FluidDesc& fluid);
void describe(Visitor& v, ObjectDesc& object);
void describe(Visitor& v, DomainDesc& domain);
void describe(Visitor& v, AtRestDesc& at_rest);
void describe(Visitor& v, RemoveObjectAction& action);
void describe(Visitor& v, MoveObjectAction& action);
void describe(Visitor& v, SetParametersAction& action);
void describe(Visitor& v, PauseAction& action);
void describe(Visitor& v, SceneEventDesc& event);
void describe(Visitor& v, ProbeConditionDesc& condition);  // messages_json_probes.cpp
void describe(Visitor& v, ProbeDesc& probe);               // likewise
void describe(Visitor& v, PressureProbe& probe);
void describe(Visitor& v, VelocityProbe& probe);
void describe(Visitor& v, LevelProbe& probe);
void describe(Visitor& v, ProfileProbe& probe);
void describe(Visitor& v, FrontProbe& probe);
void describe(Visitor& v, DischargeProbe& probe);
void describe(Visitor& v, ForceProbe& probe);
void describe(Visitor& v, EnergyProbe& probe);
void describe(Visitor& v, DensityProbe& probe);
void describe(Visitor& v, OutputDesc& output);
void describe(Visitor& v, SceneDesc& scene);

// requests
void describe(Visitor& v, Hello& m);
void describe(Visitor& v, Describe& m);
void describe(Visitor& v, SceneLoad& m);
void describe(Visitor& v, SceneGet& m);
void describe(Visitor& v, SceneList& m);
void describe(Visitor& v, SimStep& m);
void describe(Visitor& v, RunUntil& m);
void describe(Visitor& v, SimRun& m);
void describe(Visitor& v, JobWait& m);
void describe(Visitor& v, SimPause& m);
void describe(Visitor& v, SimResume& m);
void describe(Visitor& v, SimCancel& m);
void describe(Visitor& v, SimReset& m);
void describe(Visitor& v, SimStatus& m);
void describe(Visitor& v, SimInspect& m);
void describe(Visitor& v, ParamsGet& m);
void describe(Visitor& v, ParamsSet& m);
void describe(Visitor& v, ObjectsList& m);
void describe(Visitor& v, ObjectsAdd& m);
void describe(Visitor& v, ObjectsMove& m);
void describe(Visitor& v, ObjectsRemove& m);
void describe(Visitor& v, ProbesList& m);
void describe(Visitor& v, ProbesGet& m);
void describe(Visitor& v, ProbesAdd& m);
void describe(Visitor& v, ProbesRemove& m);
void describe(Visitor& v, FrameGet& m);
void describe(Visitor& v, StreamOpen& m);
void describe(Visitor& v, StreamAck& m);
void describe(Visitor& v, StreamClose& m);
void describe(Visitor& v, RecordStart& m);
void describe(Visitor& v, RecordStop& m);
void describe(Visitor& v, EventsSince& m);
void describe(Visitor& v, ServerShutdown& m);

// replies and events
void describe(Visitor& v, HelloReply& m);
void describe(Visitor& v, SceneLoadReply& m);
void describe(Visitor& v, SceneSummary& m);
void describe(Visitor& v, SceneListReply& m);
void describe(Visitor& v, JobReply& m);
void describe(Visitor& v, Applied& m);
void describe(Visitor& v, StateHash& m);
void describe(Visitor& v, PlanStage& m);
void describe(Visitor& v, FaultReport& m);
void describe(Visitor& v, Diagnostics& m);
void describe(Visitor& v, StreamState& m);
void describe(Visitor& v, SimStatusReply& m);
void describe(Visitor& v, InspectedNeighbour& m);
void describe(Visitor& v, InspectedTerm& m);
void describe(Visitor& v, SimInspectReply& m);
void describe(Visitor& v, ParameterEntry& m);
void describe(Visitor& v, ParamsGetReply& m);
void describe(Visitor& v, ParamsSetReply& m);
void describe(Visitor& v, ObjectsListReply& m);
void describe(Visitor& v, ProbeColumn& m);
void describe(Visitor& v, ProbeState& m);
void describe(Visitor& v, ProbesListReply& m);
void describe(Visitor& v, ProbeSeries& m);
void describe(Visitor& v, ProbesGetReply& m);
void describe(Visitor& v, ProbeSample& m);
void describe(Visitor& v, ProbeSamples& m);
void describe(Visitor& v, FrameGetReply& m);
void describe(Visitor& v, StreamOpenReply& m);
void describe(Visitor& v, StreamAckReply& m);
void describe(Visitor& v, StreamCloseReply& m);
void describe(Visitor& v, RecordStartReply& m);
void describe(Visitor& v, RecordStopReply& m);
void describe(Visitor& v, Event& m);
void describe(Visitor& v, EventsSinceReply& m);

}  // namespace headrace::proto
