#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "server/solver/faults.h"
#include "tests/stability/cases/watch.h"

namespace headrace::stability {

namespace {

constexpr int kSamples = 60;  // a run, beside those at disturbances and at the end

bool is_finite(const solver::Particles& particles) {
    for (int k = 0; k < particles.dimensions; ++k)
        for (std::size_t i = 0; i < particles.size(); ++i)
            if (!std::isfinite(particles.x[k][i]) || !std::isfinite(particles.v[k][i])) return false;
    return true;
}

std::string describe(const solver::Fault& fault, const scene::Run& run) {
    char text[160];
    std::snprintf(text, sizeof text, "%s: particle %u at (%.4g, %.4g, %.4g), |v| = %.3g m/s, t = %.4g s; ",
                  solver::name_of(fault.kind), fault.particle, fault.x[0], fault.x[1], fault.x[2],
                  std::hypot(fault.v[0], fault.v[1], fault.v[2]), run.time());
    return text + fault.remedy;
}

Verdict judge(const Scenario& scenario, const Outcome& outcome, bool ends_finite) {
    Verdict verdict = Verdict::passed;
    for (const Criterion& one : outcome.criteria) {
        if (!(one.margin() > 1.0)) continue;
        const bool may_be = !one.is_hard || scenario.is_beyond_limits;
        verdict = std::max(verdict, may_be ? Verdict::bounded : Verdict::failed);
    }
    if (!outcome.fault.empty())
        verdict = std::max(verdict, scenario.is_beyond_limits && ends_finite ? Verdict::bounded : Verdict::failed);
    return verdict;
}

}  // namespace

const char* name_of(Verdict verdict) {
    constexpr const char* kNames[] = {"passed", "bounded", "failed"};
    return kNames[static_cast<std::size_t>(verdict)];
}

const Criterion& Outcome::worst() const {
    return *std::max_element(criteria.begin(), criteria.end(),
                             [](const Criterion& a, const Criterion& b) { return a.margin() < b.margin(); });
}

proto::Result<Outcome> run_scenario(const Scenario& scenario) {
    const auto start = std::chrono::steady_clock::now();
    auto built = scene::Run::build(scenario.scene);
    if (!built) return built.error();
    scene::Run& run = **built;
    run.follow_energies(true);
    Watch watch(scenario, run);
    watch.sample(run);
    double next_sample = scenario.duration / kSamples;
    const std::size_t every = std::max<std::size_t>(1, scenario.most_steps / kSamples);
    while (run.time() < scenario.duration && run.step_number() < scenario.most_steps && !run.last_report().fault) {
        if (scenario.disturb && scenario.disturb(run)) watch.note_disturbance();
        run.step();
        if (run.last_report().fault) break;
        watch.note_step(run);
        if (run.time() < next_sample && run.step_number() % every != 0) continue;
        watch.sample(run);
        next_sample += scenario.duration / kSamples;
    }
    const bool ends_finite = is_finite(run.particles());
    if (ends_finite) watch.sample(run);

    Outcome outcome{scenario.name, scenario.variant, Verdict::passed, watch.criteria()};
    if (run.last_report().fault) outcome.fault = describe(*run.last_report().fault, run);
    outcome.particles = run.particles().size();
    outcome.steps = run.step_number();
    outcome.simulated = run.time();
    outcome.verdict = judge(scenario, outcome, ends_finite);
    outcome.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

std::string describe(const Outcome& outcome) {
    char text[256];
    const Criterion& worst = outcome.worst();
    std::snprintf(text, sizeof text, "%-20s %-14s %-8s N=%-6zu steps=%-7zu t=%-8.3g %6.2f s  worst %s %.3g of %.3g",
                  outcome.name.c_str(), outcome.variant.c_str(), name_of(outcome.verdict), outcome.particles,
                  outcome.steps, outcome.simulated, outcome.wall, worst.name, worst.value, worst.bound);
    std::string line = text;
    for (const Criterion& one : outcome.criteria) {
        if (&one == &worst || !(one.margin() > 1.0)) continue;
        std::snprintf(text, sizeof text, ", %s %.3g of %.3g", one.name, one.value, one.bound);
        line += text;
    }
    return outcome.fault.empty() ? line : line + "\n    " + outcome.fault;
}

const std::vector<Scenario>& scenarios() {
    static const std::vector<Scenario> all = [] {
        std::vector<Scenario> list;
        for (auto* make : {&step_scenarios, &impact_scenarios, &gap_scenarios, &disturbance_scenarios, &start_scenarios,
                           &rest_scenarios, &random_scenarios})
            for (Scenario& one : make()) list.push_back(std::move(one));
        return list;
    }();
    return all;
}

}  // namespace headrace::stability
