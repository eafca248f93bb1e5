// When probes are sampled, what is refused, and conditions on their values.
#include <omp.h>

#include <catch2/catch.hpp>
#include <utility>

#include "server/probes/probe_set.h"
#include "tests/unit/server/probes/fixtures.h"

using namespace headrace;
using namespace headrace::test;
using probes::ProbeSet;
using proto::ErrorCode;

namespace {

proto::ProbeDesc front(const char* name) {
    return {name, proto::FrontProbe{{1, 0, 0}}, {}, {}};
}

struct Tank {
    solver::Particles fluid = make_box(2, 0.1, {0, 0, 0}, {0.5, 0.3, 0});
    StillModel model{0.3};
    Scene scene{fluid, model, 0.1};
};

// Steps at which a probe is sampled in `steps` steps of dt.
std::vector<std::uint64_t> sampled_steps(const proto::ProbeDesc& desc, double dt, std::uint64_t steps,
                                         std::uint64_t first = 0) {
    const Tank tank;
    ProbeSet set(0.05);
    REQUIRE(set.add(desc, tank.scene.view(first, static_cast<double>(first) * dt), "p"));
    std::vector<std::uint64_t> sampled;
    for (std::uint64_t step = first; step <= first + steps; ++step)
        if (!set.sample_due(tank.scene.view(step, static_cast<double>(step) * dt)).empty()) sampled.push_back(step);
    return sampled;
}

using Steps = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("ProbeSet.SamplesAtOnceThenAtItsInterval") {
    proto::ProbeDesc desc = front("a");
    // The scene's output interval is 0.05 s.
    CHECK(sampled_steps(desc, 0.01, 12) == Steps{0, 5, 10});
    desc.interval = 0.03;
    CHECK(sampled_steps(desc, 0.01, 7) == Steps{0, 3, 6});
    // It counts from when it was added.
    CHECK(sampled_steps(desc, 0.01, 7, 100) == Steps{100, 103, 106});
    // Steps do not hit the instants: the first step past each. One that is longer than the interval: every step.
    CHECK(sampled_steps(desc, 0.02, 6) == Steps{0, 2, 3, 5, 6});
    CHECK(sampled_steps(desc, 0.1, 3) == Steps{0, 1, 2, 3});
    desc.interval.reset();
    desc.every_steps = 4;
    CHECK(sampled_steps(desc, 0.01, 9, 3) == Steps{3, 7, 11});
}

TEST_CASE("ProbeSet.RefusesWhatCannotBeMeasured") {
    Tank tank;
    ProbeSet set(0.1);
    REQUIRE(set.add(front("tip"), tank.scene.view(), "params.probe"));
    const auto refusal = [&](const proto::ProbeKind& kind, const char* name = "new") {
        const proto::Status added = set.add({name, kind, {}, {}}, tank.scene.view(), "params.probe");
        REQUIRE_FALSE(added);
        CHECK_FALSE(added.error().hint.empty());
        return added.error();
    };
    CHECK(refusal(proto::FrontProbe{}, "tip").code == ErrorCode::probe_exists);
    CHECK(refusal(proto::FrontProbe{{0, 0, 0}}).path == "params.probe.kind.front.direction");
    CHECK(refusal(proto::LevelProbe{{1, 1, 0}, {1, 1, 0}}).path == "params.probe.kind.level.to");
    CHECK(refusal(proto::ProfileProbe{{1, 1, 0}, {1, 1, 0}}).path == "params.probe.kind.profile.to");
    CHECK(refusal(proto::ProfileProbe{{}, {1, 1, 0}, 5, proto::ProfileField::velocity_z}).path ==
          "params.probe.kind.profile.field");
    CHECK(refusal(proto::PressureProbe{{}, 0.1, {}}).path == "params.probe.kind.pressure.normal");
    CHECK(refusal(proto::DischargeProbe{}).path == "params.probe.kind.discharge.normal");
    // The fluid has two dimensions: what points out of them would measure nothing.
    CHECK(refusal(proto::FrontProbe{{0, 0, 1}}).path == "params.probe.kind.front.direction[2]");
    CHECK(refusal(proto::DischargeProbe{{}, {0, 0, 1}}).path == "params.probe.kind.discharge.normal[2]");
    CHECK(refusal(proto::LevelProbe{{}, {0, 0, 1}}).path == "params.probe.kind.level.to[2]");
    CHECK(refusal(proto::VelocityProbe{{0, 0, 1}}).path == "params.probe.kind.velocity.point[2]");
    CHECK(refusal(proto::PressureProbe{{}, 0.1, {0, 0, 1}}).path == "params.probe.kind.pressure.normal[2]");
    // Lengths whose squares overflow, and those in which a spacing is lost to round-off.
    for (const double far : {1e300, 1e9}) {
        CHECK(refusal(proto::LevelProbe{{0, -far, 0}, {0, far, 0}}).path == "params.probe.kind.level.from");
        CHECK(refusal(proto::ProfileProbe{{}, {far, 0, 0}}).path == "params.probe.kind.profile.to");
        CHECK(refusal(proto::PressureProbe{{}, far, {1, 0, 0}}).path == "params.probe.kind.pressure.radius");
        CHECK(refusal(proto::PressureProbe{{far, 0, 0}, 0.0, {}}).path == "params.probe.kind.pressure.point");
        CHECK(refusal(proto::ForceProbe{"tank", {far, 0, 0}}).path == "params.probe.kind.force.about");
    }
    // This model tells no energies, and no forces.
    CHECK(refusal(proto::EnergyProbe{}).message.find("still") != std::string::npos);
    tank.scene.objects = {box_object("tank", solver::Role::container, {0, 0, 0}, {1, 1, 1})};
    CHECK(refusal(proto::ForceProbe{"tank", {}}).code == ErrorCode::invalid_params);
    const auto unknown = refusal(proto::ForceProbe{"tnak", {}});
    CHECK(unknown.code == ErrorCode::object_not_found);
    CHECK(unknown.hint.find("tank") != std::string::npos);

    const proto::Status removed = set.remove("tipp", "params.name");
    REQUIRE_FALSE(removed);
    CHECK(removed.error().code == ErrorCode::probe_not_found);
    CHECK(removed.error().hint.find("tip") != std::string::npos);
    CHECK(set.remove("tip", "params.name"));
    CHECK(set.is_empty());
}

TEST_CASE("ProbeSet.AFailureIsToldOnceUntilThereAreValuesAgain") {
    Tank tank;
    tank.model.loads = {{{1, 2, 3}, {}}};
    tank.scene.objects = {box_object("tank", solver::Role::container, {0, 0, 0}, {1, 1, 1})};
    ProbeSet set(0.1);
    REQUIRE(set.add({"force", proto::ForceProbe{"tank", {}}, {}, 1}, tank.scene.view(), "p"));
    const auto sample = [&](std::uint64_t step) {
        return set.sample_due(tank.scene.view(step, 0.01 * static_cast<double>(step))).at(0);
    };
    CHECK_FALSE(sample(0).failure);

    const auto objects = std::exchange(tank.scene.objects, {});
    const auto failed = sample(1);
    CHECK(failed.has_just_failed);
    CHECK(failed.failure->find("tank") != std::string::npos);
    CHECK(failed.values == proto::ProbeRow{{}, {}, {}});
    CHECK(sample(2).failure);
    CHECK_FALSE(sample(3).has_just_failed);

    tank.scene.objects = objects;
    CHECK_FALSE(sample(4).failure);
    tank.scene.objects.clear();
    CHECK(sample(5).has_just_failed);
}

TEST_CASE("ProbeSet.ConditionsNameProbesAndTheirValues") {
    const Tank tank;
    ProbeSet set(0.1);
    REQUIRE(set.add(front("tip.x"), tank.scene.view(), "p"));  // names may have dots
    REQUIRE(set.add({"rho", proto::DensityProbe{}, {}, {}}, tank.scene.view(), "p"));
    const auto holds = [&](const char* probe, std::optional<double> above, std::optional<double> below) {
        return set.holds({probe, above, below}).has_value();
    };
    CHECK_FALSE(holds("tip.x", 0.0, {}));  // not sampled yet
    set.sample_due(tank.scene.view());
    // The fluid reaches to 0.5 m; its volume is 0.15 m^2.
    CHECK(holds("tip.x", 0.49, {}));
    CHECK_FALSE(holds("tip.x", 0.51, {}));
    CHECK(holds("tip.x", {}, 0.51));
    CHECK_FALSE(holds("tip.x", {}, 0.49));
    CHECK(holds("rho.volume", 0.14, {}));
    CHECK(*set.holds({"rho.volume", 0.14, {}}) == "probe rho.volume is 0.15 m^2, above 0.14 m^2");

    const auto refusal = [&](const char* probe) { return set.check({probe, 1.0, {}}, "params.until.probe").error(); };
    CHECK(set.check({"tip.x", 1.0, {}}, "p"));
    CHECK(set.check({"rho.max_error", 1.0, {}}, "p"));
    CHECK(refusal("rho").path == "params.until.probe.probe");
    CHECK(refusal("rho").hint.find("rho.mean_error") != std::string::npos);
    CHECK(refusal("rho.volumn").hint.find("rho.volume") != std::string::npos);
    CHECK(refusal("tip.y").code == ErrorCode::probe_not_found);
    CHECK(refusal("nothing").code == ErrorCode::probe_not_found);
}

TEST_CASE("ProbeSet.ValuesDoNotDependOnTheNumberOfThreads") {
    const unsigned seed = 5;
    INFO("seed " << seed);
    auto fluid = make_box(3, 0.04, {0, 0, 0}, {1, 0.6, 1}, 0.3, seed);  // more than ten blocks of particles
    set_field(fluid, fluid.p, [](const Vec3& x) { return 1e3 * x[1] * x[1]; });
    set_field(fluid, fluid.v[0], [](const Vec3& x) { return x[0] * x[1]; });
    const StillModel model(0.12);
    const Scene scene{fluid, model, 0.04};
    const auto measure = [&](int threads) {
        omp_set_num_threads(threads);
        std::vector<proto::ProbeRow> rows;
        for (const proto::ProbeKind& kind :
             {proto::ProbeKind{proto::PressureProbe{{0.5, 0.3, 0.5}}},
              proto::ProbeKind{proto::LevelProbe{{0.5, 0, 0.5}, {0.5, 1, 0.5}}},
              proto::ProbeKind{proto::DischargeProbe{{0.5, 0, 0}, {1, 1, 0}}}, proto::ProbeKind{proto::DensityProbe{}}})
            rows.push_back(scene.measure(kind));
        return rows;
    };
    const int before = omp_get_max_threads();
    const auto alone = measure(1), together = measure(3);
    omp_set_num_threads(before);
    CHECK(alone == together);
}
