// Scenes: loading and resetting.
#include "server/scene/validate.h"
#include "server/simulation_impl.h"

namespace headrace::server {

void Simulation::Impl::apply(Token token, proto::SceneLoad load) {
    if (is_allowed(token, "scene.load")) start_load(token, std::get<proto::SceneDesc>(load.scene), false);
}

void Simulation::Impl::apply(Token token, proto::SimReset) {
    if (is_allowed(token, "sim.reset")) start_load(token, run->scene(), true);
}

void Simulation::Impl::start_load(Token token, const proto::SceneDesc& scene, bool is_reset) {
    load_token = token;
    loader.start(scene, threads, data_folder, [this, is_reset](Result<std::shared_ptr<scene::Run>> built) {
        inbox.put(0, LoadFinished{std::move(built), is_reset});
    });
    write_status();
}

void Simulation::Impl::apply(Token, LoadFinished load) {
    loader.finish();
    const Token token = std::exchange(load_token, 0);
    const std::vector<Token> cancels = std::exchange(load_cancels, {});
    // A cancel that came when the work was nearly done still holds.
    if (!cancels.empty() && load.run) load.run = scene::cancelled_error();
    Result<probes::ProbeSet> measured = load.run ? ProbeWatch::make(**load.run) : load.run.error();
    if (!measured) {
        report("scene.load_failed", measured.error().message, {{"path", measured.error().path}});
        write_status();
        outbox.put(token, measured.error());
        for (const Token cancel : cancels) outbox.put(cancel, Reply(applied()));
        return;
    }
    if (paused) end_job(*std::exchange(paused, std::nullopt), {proto::JobState::cancelled, "another scene"});
    refuse_deferred({ErrorCode::cancelled, "another scene was loaded before that step", "params.at_step", ""});
    run = std::move(*load.run);
    team = TeamChoice(threads);
    is_faulted = is_at_rest = is_overdue_reported = false;
    frame_seconds = 0.0;
    scene_events.restart();
    at_rest.emplace(*run);
    status.forget_run();
    status.refresh_lists(*run);
    status.set_hash(solver::compute_state_hash(run->particles()), 0);
    hub.restart();
    probes.restart(*std::move(measured), hub.generation());
    sample_probes();
    report("scene.loaded", run->scene().name + (load.is_reset ? ", reset" : ""), {{"scene", run->scene().name}}, true);
    answer(token, load_reply());
}

proto::SceneLoadReply Simulation::Impl::load_reply() const {
    proto::SceneLoadReply reply;
    reply.scene = run->scene().name;
    reply.step = place().step;
    reply.time = place().time;
    reply.particles = static_cast<std::int64_t>(run->particles().size());
    reply.time_step = run->model().time_step();
    reply.state = state();
    for (const proto::ObjectDesc& object : run->objects()) reply.objects.push_back(object.name);
    return reply;
}

}  // namespace headrace::server
