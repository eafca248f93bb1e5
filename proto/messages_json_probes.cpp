// Probes, what they gave, and one particle explained, member by member.
#include "proto/json_describe.h"

namespace headrace::proto {

namespace {

constexpr std::size_t kMaxReference = 2 * kMaxNameLength + 1;  // name.member
constexpr double kMaxSteps = 1e15;                             // below 2^53: exact in every JSON library
constexpr double kMaxProfilePoints = 1000;
constexpr double kMaxRows = 1e6;  // in one reply

constexpr About kStep{.meaning = "step number", .unit = "1"};
constexpr About kTime{.meaning = "simulated time", .unit = "s"};
constexpr About kColumns{.meaning = "of each row, time first"};

// Ends of a line of measurement.
void describe_line(Visitor& v, Vec3& from, Vec3& to) {
    v.required("from", from, {.meaning = "where the line begins", .unit = "m"});
    v.required("to", to, {.meaning = "where it ends", .unit = "m"});
}

}  // namespace

// ---- what is measured ----

void describe(Visitor& v, PressureProbe& probe) {
    v.required("point", probe.point, {.meaning = "where", .unit = "m"});
    v.unless_default(
        "radius", probe.radius,
        {.meaning = "greater than 0: the mean over a disc (2D: a segment) of this radius, which is 0 Pa where "
                    "there is no fluid",
         .unit = "m",
         .range = kNotNegative});
    v.unless_default("normal", probe.normal, {.meaning = "of the disc, of any length; needed for one", .unit = "1"});
}

void describe(Visitor& v, VelocityProbe& probe) {
    v.required("point", probe.point, {.meaning = "where", .unit = "m"});
}

void describe(Visitor& v, LevelProbe& probe) {
    describe_line(v, probe.from, probe.to);
    v.unless_default("surface", probe.surface,
                     {.meaning = "which, where the line crosses several: highest counts splashes and breaking waves, "
                                 "lowest is the top of the fluid that stands on the line's beginning"},
                     LevelSurface::highest);
}

void describe(Visitor& v, ProfileProbe& probe) {
    describe_line(v, probe.from, probe.to);
    v.optional(
        "points", probe.points,
        {.meaning = "how many, equidistant, ends included", .unit = "1", .range = between(2, kMaxProfilePoints)});
    v.optional("field", probe.field, {.meaning = "what is told at each point"});
}

void describe(Visitor& v, FrontProbe& probe) {
    v.optional("direction", probe.direction, {.meaning = "in which the fluid advances, of any length", .unit = "1"});
}

void describe(Visitor& v, DischargeProbe& probe) {
    v.required("point", probe.point, {.meaning = "a point of the plane", .unit = "m"});
    v.required("normal", probe.normal,
               {.meaning = "of the plane, of any length: this way counts as positive", .unit = "1"});
}

void describe(Visitor& v, ForceProbe& probe) {
    v.required("object", probe.object, {.meaning = "on which the fluid acts", .text = Text::name});
    v.optional("about", probe.about, {.meaning = "point about which the torque is taken", .unit = "m"});
}

void describe(Visitor&, EnergyProbe&) {}
void describe(Visitor&, DensityProbe&) {}

void describe(Visitor& v, ProbeDesc& probe) {
    v.required("name", probe.name, {.meaning = "name of the probe", .text = Text::name});
    v.required("kind", probe.kind, {.meaning = "what it measures"});
    v.optional("interval", probe.interval,
               {.meaning = "simulated time between samples; neither this nor every_steps: the scene's output interval",
                .unit = "s",
                .range = kPositive});
    v.optional("every_steps", probe.every_steps,
               {.meaning = "steps between samples", .unit = "1", .range = between(1, kMaxSteps)});
    v.at_most_one({{"interval", probe.interval.has_value()}, {"every_steps", probe.every_steps.has_value()}});
}

void describe(Visitor& v, ProbeConditionDesc& condition) {
    v.required("probe", condition.probe,
               {.meaning = "name of the probe; name.column when it has several", .max_length = kMaxReference});
    v.optional("above", condition.above, {.meaning = "holds while the value is greater; in the probe's unit"});
    v.optional("below", condition.below, {.meaning = "holds while the value is smaller; in the probe's unit"});
    v.exactly_one({{"above", condition.above.has_value()}, {"below", condition.below.has_value()}});
}

// ---- commands ----

void describe(Visitor&, ProbesList&) {}

void describe(Visitor& v, ProbesGet& m) {
    v.optional("name", m.name, {.meaning = "which probe; absent: all", .text = Text::name});
    v.optional("since", m.since, {.meaning = "samples after this simulated time; absent: from the first", .unit = "s"});
    v.optional(
        "limit", m.limit,
        {.meaning = "samples of each probe at most: the oldest ones", .unit = "1", .range = between(1, kMaxRows)});
}

void describe(Visitor& v, ProbesAdd& m) {
    v.required("probe", m.probe, {.meaning = "the new probe; its first sample is of the present state"});
}

void describe(Visitor& v, ProbesRemove& m) {
    v.required("name", m.name, {.meaning = "probe to remove, with its samples", .text = Text::name});
}

void describe(Visitor& v, SimInspect& m) {
    v.required("id", m.id, {.meaning = "of the particle"});
}

// ---- replies ----

void describe(Visitor& v, ProbeColumn& m) {
    v.required("name", m.name, {.meaning = "name of the quantity"});
    v.required("unit", m.unit, {.meaning = "SI; 1 when it has none"});
    v.optional("position", m.position, {.meaning = "of a profile's point along its line", .unit = "m"});
}

void describe(Visitor& v, ProbeState& m) {
    v.required("probe", m.probe, {.meaning = "what it measures"});
    v.required("columns", m.columns, kColumns);
    v.required("samples", m.samples, {.meaning = "samples that probes.get can give", .unit = "1"});
    v.required("dropped", m.dropped, {.meaning = "older ones that the server no longer holds", .unit = "1"});
    v.optional("latest", m.latest, {.meaning = "the last sample; null where there is no fluid to measure"});
    v.optional("failure", m.failure, {.meaning = "why it cannot be evaluated"});
}

void describe(Visitor& v, ProbesListReply& m) {
    v.required("probes", m.probes, {.meaning = "in the order in which they were added"});
}

void describe(Visitor& v, ProbeSeries& m) {
    v.required("name", m.name, {.meaning = "name of the probe"});
    v.required("columns", m.columns, kColumns);
    v.required("rows", m.rows,
               {.meaning = "one per sample, ascending in time; null where there is no fluid to measure"});
    v.required("dropped", m.dropped, {.meaning = "older samples that the server no longer holds", .unit = "1"});
}

void describe(Visitor& v, ProbesGetReply& m) {
    v.required("probes", m.probes, {.meaning = "the probes asked for"});
    v.optional("complete_to", m.complete_to,
               {.meaning = "no row up to this time is missing: ask again with it as since", .unit = "s"});
}

void describe(Visitor& v, ProbeSample& m) {
    v.required("probe", m.probe, {.meaning = "name of the probe"});
    v.optional("columns", m.columns, {.meaning = "of the values; absent: as in the sample of this probe before"});
    v.required("values", m.values, {.meaning = "null where there is no fluid to measure"});
}

void describe(Visitor& v, ProbeSamples& m) {
    v.required("time", m.time, kTime);
    v.required("samples", m.samples, {.meaning = "of the probes that were due"});
}

void describe(Visitor& v, InspectedNeighbour& m) {
    v.optional("id", m.id, {.meaning = "of a fluid particle"});
    v.optional("object", m.object, {.meaning = "the object that a wall's particle stands for"});
    v.required("distance", m.distance, {.meaning = "from the particle", .unit = "m", .may_be_non_finite = true});
    v.required("weight", m.weight, {.meaning = "volume times kernel", .unit = "1", .may_be_non_finite = true});
}

void describe(Visitor& v, InspectedTerm& m) {
    v.required("term", m.term, {.meaning = "name of the term, as in the plan"});
    v.required("acceleration", m.acceleration,
               {.meaning = "what it does to the particle", .unit = "m/s^2", .may_be_non_finite = true});
}

void describe(Visitor& v, SimInspectReply& m) {
    v.required("step", m.step, kStep);
    v.required("time", m.time, kTime);
    v.required("id", m.id, {.meaning = "of the particle"});
    v.required("position", m.position, {.meaning = "where it is", .unit = "m", .may_be_non_finite = true});
    v.required("velocity", m.velocity, {.meaning = "its velocity", .unit = "m/s", .may_be_non_finite = true});
    v.required("acceleration", m.acceleration,
               {.meaning = "its acceleration", .unit = "m/s^2", .may_be_non_finite = true});
    v.required("density", m.density, {.meaning = "its density", .unit = "kg/m^3", .may_be_non_finite = true});
    v.required("pressure", m.pressure, {.meaning = "its pressure", .unit = "Pa", .may_be_non_finite = true});
    v.required(
        "concentration", m.concentration,
        {.meaning = "sum of volume times kernel, itself and walls included", .unit = "1", .may_be_non_finite = true});
    v.required("min_eigenvalue", m.min_eigenvalue,
               {.meaning = "smallest of the moment matrix: below about 0.75 at a free surface",
                .unit = "1",
                .may_be_non_finite = true});
    v.required("neighbours", m.neighbours, {.meaning = "nearest first"});
    v.required("terms", m.terms, {.meaning = "they add up to the acceleration"});
}

}  // namespace headrace::proto
