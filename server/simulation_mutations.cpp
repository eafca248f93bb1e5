// Commands between two steps: parameters, objects, probes, inspection, hash.
#include <exception>

#include "server/inspection.h"
#include "server/simulation_impl.h"
#include "server/state_table.h"

namespace headrace::server {

void Simulation::Impl::apply(InboxItem item) {
    try {
        std::visit([&](auto&& mutation) { apply(item.token, std::forward<decltype(mutation)>(mutation)); },
                   std::move(item.mutation));
    } catch (const std::exception& problem) {
        outbox.put(item.token, Error{ErrorCode::internal_error, problem.what(), "", "report this as a bug"});
    }
}

bool Simulation::Impl::is_allowed(Token token, std::string_view method) {
    const auto refusal = refuse_in_state(method, state());
    if (refusal) outbox.put(token, *refusal);
    return !refusal;
}

void Simulation::Impl::answer(Token token, const proto::Status& outcome) {
    if (outcome)
        answer(token, applied());
    else
        outbox.put(token, outcome.error());
}

void Simulation::Impl::apply(Token token, proto::ParamsSet request) {
    if (!is_allowed(token, "params.set")) return;
    const std::uint64_t now = run->step_number();
    const auto at_step = static_cast<std::uint64_t>(request.at_step.value_or(static_cast<std::int64_t>(now)));
    // Refused now rather than at its step, if it can be known now.
    if (at_step == now || solver::check_parameters(run->model().parameter_table(), request.parameters))
        return set_parameters(token, request.parameters);
    if (const auto refusal = deferred.add(at_step, now, {token, std::move(request.parameters)}))
        outbox.put(token, *refusal);
}

void Simulation::Impl::set_parameters(Token token, const proto::Parameters& values) {
    auto reply = change_parameters(values);
    if (reply)
        answer(token, *std::move(reply));
    else
        outbox.put(token, reply.error());
}

proto::Result<proto::ParamsSetReply> Simulation::Impl::change_parameters(const proto::Parameters& values) {
    proto::ParamsSetReply reply{place().step, place().time, {}};
    if (const proto::Status outcome = run->set_parameters(values, &reply.previous); !outcome) return outcome.error();
    std::string names;
    for (const auto& [name, value] : values) names += (names.empty() ? "" : ", ") + name;
    status.refresh_lists(*run);
    report("params.changed", "changed: " + names, {{"parameters", names}});
    return reply;
}

// What an event of the scene does; nobody waits for an answer.
proto::Status Simulation::Impl::act(const proto::RemoveObjectAction& action) {
    return change_objects(run->remove_object(action.name), "object.removed", action.name);
}

proto::Status Simulation::Impl::act(const proto::MoveObjectAction& action) {
    return change_objects(run->move_object(action.name, action.to, {}), "object.moved", action.name);
}

proto::Status Simulation::Impl::act(const proto::SetParametersAction& action) {
    const auto changed = change_parameters(action.parameters);
    return changed ? proto::Status(proto::Done{}) : changed.error();
}

proto::Status Simulation::Impl::act(const proto::PauseAction&) {
    pause_job();
    return proto::Done{};
}

void Simulation::Impl::apply_due_parameters() {
    for (const auto& change : deferred.take_due(run->step_number())) set_parameters(change.token, change.values);
}

void Simulation::Impl::refuse_deferred(const Error& error) {
    for (const auto& change : deferred.take_all()) outbox.put(change.token, error);
}

void Simulation::Impl::apply(Token token, const proto::ObjectsAdd& request) {
    if (!is_allowed(token, "objects.add")) return;
    answer(token, change_objects(run->add_object(request.object), "object.added", request.object.name));
}

void Simulation::Impl::apply(Token token, const proto::ObjectsMove& request) {
    if (!is_allowed(token, "objects.move")) return;
    answer(token, change_objects(run->move_object(request.name, request.to, request.by), "object.moved", request.name));
}

void Simulation::Impl::apply(Token token, const proto::ObjectsRemove& request) {
    if (!is_allowed(token, "objects.remove")) return;
    answer(token, change_objects(run->remove_object(request.name), "object.removed", request.name));
}

proto::Status Simulation::Impl::change_objects(proto::Status outcome, const char* event, const std::string& name) {
    if (!outcome) return outcome;
    status.refresh_lists(*run);
    report(event, name, {{"name", name}}, true);
    return outcome;
}

void Simulation::Impl::apply(Token token, const proto::ProbesAdd& request) {
    if (!is_allowed(token, "probes.add")) return;
    const proto::Status added = probes.add(*run, request.probe);
    if (added) {
        sample_probes();
        report("probe.added", request.probe.name, {{"probe", request.probe.name}});
    }
    answer(token, added);
}

void Simulation::Impl::apply(Token token, const proto::ProbesRemove& request) {
    if (!is_allowed(token, "probes.remove")) return;
    for (const auto* each : {&job, &paused}) {
        if (!*each || !(*each)->until_probe) continue;
        if (probes.probes().probe_of(*(*each)->until_probe) != request.name) continue;
        outbox.put(token, Error{ErrorCode::wrong_state,
                                "job " + std::to_string((*each)->number) + " runs until this probe has a value",
                                "params.name", "sim.cancel the job first"});
        return;
    }
    const proto::Status removed = probes.remove(*run, request.name);
    if (removed) report("probe.removed", request.name, {{"probe", request.name}});
    answer(token, removed);
}

void Simulation::Impl::apply(Token token, const proto::SimInspect& request) {
    if (!is_allowed(token, "sim.inspect")) return;
    auto found = inspect_particle(*run, request.id);
    if (found)
        outbox.put(token, Reply(*std::move(found)));
    else
        outbox.put(token, found.error());
}

void Simulation::Impl::apply(Token token, HashWanted) {
    if (!run) {
        outbox.put(token, Error{ErrorCode::wrong_state, "no scene is loaded", "", "load a scene first (scene.load)"});
        return;
    }
    answer(token, refresh_hash());
}

void Simulation::Impl::apply(Token token, proto::ServerShutdown) {
    if (job) end_job(*std::exchange(job, std::nullopt), {proto::JobState::cancelled, "the server stops"});
    answer(token, applied());
}

}  // namespace headrace::server
