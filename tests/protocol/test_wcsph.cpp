// The model wcsph from outside: what it tells of forces, energies and single particles is what it does.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "tests/support/server/client.h"
#include "tests/support/server/scenes.h"
#include "tests/support/server/test_server.h"

using namespace headrace;
using namespace headrace::test;

namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

Json box(const Json& min, const Json& max) {
    return {{"box", {{"min", min}, {"max", max}}}};
}

Json every_step(const char* name, const Json& kind) {
    return {{"name", name}, {"kind", kind}, {"every_steps", 1}};
}

Json wcsph_scene() {
    return {{"headrace_scene", 1},      {"name", "water"},        {"dimensions", 2},
            {"model", "wcsph"},         {"spacing", 0.01},        {"parameters", {{"gravity", {0, -kGravity}}}},
            {"objects", Json::array()}, {"fluids", Json::array()}};
}

// 0.1 m of still water on a floor, 0.2 m of an endless channel: 200 particles.
Json still_channel() {
    Json scene = wcsph_scene();
    scene["domain"] = {{"min", {0, -0.1}}, {"max", {0.2, 0.2}}, {"periodic", {true, false}}};
    scene["fluids"].push_back({{"name", "water"}, {"shape", box({0, 0}, {0.2, 0.1})}, {"hydrostatic", true}});
    scene["objects"].push_back({{"name", "floor"}, {"shape", {{"plane", {{"point", {0, 0}}, {"normal", {0, 1}}}}}}});
    scene["probes"] = Json::array({every_step("load", {{"force", {{"object", "floor"}}}}),
                                   every_step("turned", {{"force", {{"object", "floor"}, {"about", {0.1, 0.05}}}}}),
                                   every_step("budget", {{"energies", Json::object()}})});
    return scene;
}

// A column of 0.1 m collapses in a closed tank that is shaken to and fro: 400 particles.
Json shaken_collapse() {
    Json scene = wcsph_scene();
    scene["spacing"] = 0.005;
    scene["domain"] = {{"min", {-0.5, -0.5}}, {"max", {1, 1}}};
    scene["fluids"].push_back({{"name", "water"}, {"shape", box({0, 0}, {0.1, 0.1})}});
    scene["objects"].push_back({{"name", "tank"},
                                {"role", "container"},
                                {"shape", box({0, 0}, {0.2, 0.2})},
                                {"motion", {{"displacement", {"0.02*(1-cos(10*t))", 0}}}}});
    scene["probes"] = Json::array({every_step("load", {{"force", {{"object", "tank"}}}}),
                                   every_step("budget", {{"energies", Json::object()}}),
                                   every_step("tip", {{"front", Json::object()}})});
    return scene;
}

struct Loaded {
    explicit Loaded(const Json& scene) { client.call("scene.load", {{"scene", scene}}); }
    Json rows(const char* name) { return client.call("probes.get", {{"name", name}})["probes"][0]["rows"]; }
    void run_to(double time) { client.call("sim.run", {{"until", {{"time", time}}}, {"wait", true}}); }

    TestServer server;
    Client client{server->control_endpoint()};
};

double at(const Json& row, std::size_t column) {
    return row.at(column).get<double>();
}

// Integral over time of a column times a weight, by the trapezoidal rule.
template <class Weight>
double integral(const Json& rows, std::size_t column, Weight weight) {
    double sum = 0.0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double t0 = at(rows[k - 1], 0), t1 = at(rows[k], 0);
        sum += 0.5 * (t1 - t0) * (at(rows[k - 1], column) * weight(t0) + at(rows[k], column) * weight(t1));
    }
    return sum;
}

double initial_energy(const Json& budget) {
    return at(budget[0], 1) + at(budget[0], 2) + at(budget[0], 3);
}

double largest_imbalance(const Json& budget) {
    double largest = 0.0;
    for (const Json& row : budget) largest = std::max(largest, std::abs(at(row, 6)));
    return largest;
}

// The particles of a 2D frame by id, in double precision.
struct Snapshot {
    explicit Snapshot(const std::string& endpoint) : data(endpoint) {
        data.call("frame.get", {{"fields", {"id", "position", "acceleration"}}, {"precision", "f8"}});
        message = data.await_frame();
        frame = frame_of(message);
    }
    double value(proto::Field field, std::size_t id, int component) const {
        return proto::FrameView::value(*frame.find(field), id, component);
    }
    // Ids of the others within the distance [m].
    std::set<std::size_t> within(double distance, std::size_t id) const {
        std::set<std::size_t> found;
        for (std::size_t j = 0; j < frame.info.particle_count; ++j) {
            const auto gap = [&](int k) {
                return value(proto::Field::position, id, k) - value(proto::Field::position, j, k);
            };
            if (j != id && std::hypot(gap(0), gap(1)) < distance) found.insert(j);
        }
        return found;
    }

    Client data;
    std::string message;
    proto::FrameView frame;
};

}  // namespace

// Momentum: the floor's force is the weight but for what the fluid's own momentum changes by, at most M max_speed over
// the time of the mean. Samples at the steps' ends miss part of the sound's oscillation (below 1 % of the weight, some
// ten periods): a thousandth covers both. Half a spacing of water more or less would be 50 thousandths.
TEST_CASE("Wcsph.TheFloorBearsTheWeightOfStillWater") {
    Loaded loaded(still_channel());
    // Particles start with the mass that their place in still, compressible water has: the mean density is the mass.
    const double density = loaded.client.call("sim.status")["diagnostics"]["mean_density"];
    CHECK(density == Approx(1000.0).epsilon(0.005));
    const double weight = density * 0.2 * 0.1 * kGravity;  // [N/m]
    loaded.run_to(0.2);
    const Json load = loaded.rows("load"), turned = loaded.rows("turned");
    const double duration = at(load.back(), 0);
    const double speed = loaded.client.call("sim.status")["diagnostics"]["max_speed"];
    CHECK(speed / (kGravity * duration) < 2e-4);
    const auto mean = [&](std::size_t column) { return integral(load, column, [](double) { return 1.0; }) / duration; };
    CHECK(mean(2) / weight == Approx(-1.0).epsilon(1e-3));
    // Mirror images of each other, to the round-off of single precision, which grows.
    CHECK(std::abs(mean(1) / weight) < 1e-6);
    // The load is even along the channel, so it acts in its middle: torque = r x F, about both points.
    for (std::size_t k = 0; k < load.size(); ++k) {
        CHECK(at(load[k], 3) == Approx(0.1 * at(load[k], 2)).epsilon(1e-6));
        CHECK(at(turned[k], 3) ==
              Approx(at(load[k], 3) - (0.1 * at(load[k], 2) - 0.05 * at(load[k], 1))).margin(1e-12 * weight));
    }
}

TEST_CASE("Wcsph.TheEnergyBudgetOfStillWaterIsStill") {
    Loaded loaded(still_channel());
    loaded.run_to(0.2);
    const Json budget = loaded.rows("budget");
    // M g times the height of the middle; compressibility moves both by less than 0.5 %.
    CHECK(at(budget[0], 2) == Approx(1000.0 * 0.02 * kGravity * 0.05).epsilon(5e-3));
    CHECK(at(budget.back(), 1) < 1e-6 * initial_energy(budget));
    CHECK(at(budget.back(), 5) == 0.0);  // a floor at rest does no work
    CHECK(largest_imbalance(budget) < 2e-4 * initial_energy(budget));
}

// The scheme's own loss falls with the spacing (of the energy at the start: 4.5 % at 10 mm, 2.3 % at 5 mm here).
TEST_CASE("Wcsph.TheEnergyBudgetOfACollapseCloses") {
    Loaded loaded(shaken_collapse());
    loaded.run_to(0.4);
    const Json budget = loaded.rows("budget");
    CHECK(at(budget.back(), 1) > 0.1 * initial_energy(budget));
    CHECK(at(budget.back(), 4) > 0.0);
    CHECK(largest_imbalance(budget) < 0.04 * initial_energy(budget));
    for (const Json& row : budget) {
        const double stored = at(row, 1) + at(row, 2) + at(row, 3);
        CHECK(at(row, 6) == Approx(stored - initial_energy(budget) + at(row, 4) - at(row, 5)).margin(1e-12));
    }
    // Work = - integral of the fluid's force on the tank times the tank's velocity, 0.2 sin(10 t). Impacts last a few
    // steps, and forces are sampled once in each: 5 %.
    const double work = -integral(loaded.rows("load"), 1, [](double t) { return 0.2 * std::sin(10.0 * t); });
    CHECK(work > 0.1 * initial_energy(budget));
    CHECK(at(budget.back(), 5) == Approx(work).epsilon(0.05));
}

// At the start it is the acceleration of the first step, later that of the state as it is: a frame has the one that the
// step before has used.
TEST_CASE("Wcsph.InspectionAddsUpToWhatTheParticleDoes") {
    Loaded loaded(shaken_collapse());
    const double time = GENERATE(0.0, 0.15);  // [s]
    if (time > 0.0) loaded.run_to(time);
    const Snapshot now(loaded.server->data_endpoint());
    std::size_t at_walls = 0;
    for (const std::size_t id : {0, 19, 200, 210, 380, 399}) {
        INFO("particle " << id);
        const Json told = loaded.client.call("sim.inspect", {{"id", id}});
        std::array<double, 2> sum{};
        double largest = 0.0;  // term [m/s^2]
        for (const Json& term : told["terms"])
            for (std::size_t k = 0; k < 2; ++k) {
                sum[k] += term["acceleration"][k].get<double>();
                largest = std::max(largest, std::abs(term["acceleration"][k].get<double>()));
            }
        for (int k = 0; k < 2; ++k) {
            const auto axis = static_cast<std::size_t>(k);
            CHECK(told["position"][axis] == now.value(proto::Field::position, id, k));
            CHECK(told["acceleration"][axis].get<double>() == Approx(sum[axis]).margin(1e-12 * largest));
            if (time == 0.0)
                CHECK(told["acceleration"][axis].get<double>() ==
                      Approx(now.value(proto::Field::acceleration, id, k)).margin(1e-9 * largest));
        }

        std::set<std::size_t> fluid;
        double distance = 0.0, weights = 0.0;
        for (const Json& neighbour : told["neighbours"]) {
            CHECK(neighbour["distance"] >= distance);
            distance = neighbour["distance"];
            weights += neighbour["weight"].get<double>();
            if (neighbour.contains("id"))
                CHECK(fluid.insert(neighbour["id"].get<std::size_t>()).second);
            else
                CHECK(neighbour["object"] == "tank");
        }
        CHECK(distance < 3 * 0.005);  // the support
        CHECK(fluid == now.within(3 * 0.005, id));
        CHECK(weights < told["concentration"]);  // which counts the particle itself
        at_walls += fluid.size() < told["neighbours"].size() ? 1 : 0;
    }
    CHECK(at_walls >= 2);
}

TEST_CASE("Wcsph.InspectionOfWhatIsNoParticleSaysSo") {
    Loaded loaded(still_channel());
    for (const char* bad : {"-1", "1e10", "3.5", "true", "null", "[1]", R"("x")"}) {
        INFO(bad);
        const Answer refused = loaded.client.ask("sim.inspect", {{"id", Json::parse(bad)}});
        CHECK(refused.error_name() == "invalid_params");
        CHECK(refused.path() == "params.id");
    }
    CHECK(loaded.client.ask("sim.inspect").path() == "params.id");
    const Answer past = loaded.client.ask("sim.inspect", {{"id", 200}});
    CHECK(past.error_name() == "particle_not_found");
    CHECK(past.hint().find("0 to 199") != std::string::npos);
}

TEST_CASE("Wcsph.ARunEndsAtAnEnergyAForceOrAFront") {
    Loaded loaded(shaken_collapse());
    const auto run_until = [&](const Json& condition) {
        return loaded.client.call("sim.run", {{"until", {{"probe", condition}, {"timeout", 1}}}, {"wait", true}});
    };
    const Json moved = run_until({{"probe", "budget.kinetic"}, {"above", 0.1}});
    CHECK(moved["state"] == "finished");
    CHECK(moved["reason"].get<std::string>().find("probe budget.kinetic is 0.1") == 0);
    CHECK(at(loaded.rows("budget").back(), 1) > 0.1);
    CHECK(run_until({{"probe", "tip"}, {"above", 0.12}})["state"] == "finished");
    CHECK(run_until({{"probe", "load.fy"}, {"below", -50}})["state"] == "finished");
    CHECK(at(loaded.rows("load").back(), 2) < -50);
    CHECK(run_until({{"probe", "budget.kinetic"}, {"above", 1e9}})["state"] == "timed_out");

    const auto refused = [&](const Json& condition) {
        return loaded.client.ask("sim.run", {{"until", {{"probe", condition}}}});
    };
    CHECK(refused({{"probe", "budget"}, {"above", 1}}).hint().find("budget.kinetic") != std::string::npos);
    CHECK(refused({{"probe", "budget.kinetc"}, {"above", 1}}).hint() == "did you mean \"budget.kinetic\"?");
    CHECK(refused({{"probe", "load.tx"}, {"above", 1}}).error_name() == "probe_not_found");  // 2D has tz alone
}
