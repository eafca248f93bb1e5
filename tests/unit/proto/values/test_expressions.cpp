#include <omp.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include "proto/values/expressions.h"

using namespace headrace;
using scene::Formula;
using scene::Symbols;

namespace {

constexpr Symbols kAll{.dimensions = 3, .spacing = 0.05, .position = true, .time = true};

Formula compiled(const char* text, const Symbols& symbols = kAll) {
    const auto formula = Formula::compile(std::string(text), symbols, "here");
    if (!formula) FAIL(formula.error().message);
    return *formula;
}

proto::Error refusal(const char* text, const Symbols& symbols = kAll) {
    const auto formula = Formula::compile(std::string(text), symbols, "here");
    REQUIRE_FALSE(formula.ok());
    CHECK(formula.error().code == proto::ErrorCode::scene_invalid);
    CHECK(formula.error().path == "here");
    CHECK_FALSE(formula.error().hint.empty());
    return formula.error();
}

bool has(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Formula.HasTheValueOfItsExpression") {
    const proto::Vec3 x{0.3, -0.2, 1.5};
    const double t = 0.7;
    // The same double-precision operations: equal but for the order of a product.
    CHECK(compiled("sin(2*pi*x)*cos(y)")(x, t) ==
          Approx(std::sin(2 * std::numbers::pi * 0.3) * std::cos(-0.2)).epsilon(1e-15));
    CHECK(compiled("x^2 + z/dx - t")(x, t) == Approx(0.09 + 1.5 / 0.05 - 0.7).epsilon(1e-15));
    CHECK(compiled("t < 0.5 ? 1 : 2")(x, t) == 2.0);
    CHECK(compiled("x >= 0.3 && y != 0 ? -1 : 0")(x, t) == -1.0);
    CHECK(compiled("ln(exp(1))")(x, t) == Approx(1.0));
    CHECK(compiled("log(exp(1))")(x, t) == Approx(1.0));  // natural, as in C
    CHECK(compiled("min(x, y, z)")(x, t) == -0.2);
}

TEST_CASE("Formula.KnowsWhatItDependsOn") {
    CHECK(compiled("3*pi + dx").is_constant());
    CHECK(compiled("3*pi + dx")({}, 0.0) == Approx(3 * std::numbers::pi + 0.05).epsilon(1e-15));
    CHECK(compiled("0*2").is_zero());
    CHECK_FALSE(compiled("x").is_constant());
    CHECK(compiled("y + t").uses_position());
    CHECK(compiled("y + t").uses_time());
    CHECK_FALSE(compiled("t").uses_position());
    CHECK_FALSE(compiled("z").uses_time());
    CHECK(Formula::compile(2.5, kAll, "here")->is_constant());
}

TEST_CASE("Formula.RefusalsSayWhatAndWhereAndWhatIsAllowed") {
    CHECK(has(refusal("sin(q)").message, "Unexpected token \"q"));
    CHECK(has(refusal("sin(q)").message, "position 4"));
    CHECK(has(refusal("sin(q)").hint, "x, y, z, t"));
    CHECK(has(refusal("2*(x").message, "arenthesis"));
    CHECK(has(refusal("").message, "no valid expression"));
    CHECK(has(refusal("x y").message, "no valid expression"));
    CHECK(has(refusal("foo(x)").message, "no valid expression"));
    CHECK(has(refusal("\"word\"").message, "no valid expression"));
    CHECK(has(refusal("1, 2").message, "must be one value"));
    CHECK(has(refusal("x = 3").message, "cannot assign"));
    const auto cut = Formula::compile(std::string("x\0y", 3), kAll, "here");  // muParser would end at the NUL
    REQUIRE_FALSE(cut.ok());
    CHECK(has(cut.error().message, "control character"));
    CHECK(has(refusal("1/0").message, "not a finite number"));
    CHECK(has(refusal("sqrt(-1)").message, "not a finite number"));
    CHECK_FALSE(Formula::compile(std::nan(""), kAll, "here").ok());
}

TEST_CASE("Formula.NamesOnlyWhatIsAllowedThere") {
    CHECK(has(refusal("t", {.spacing = 1, .position = true}).hint, "x, y, z;"));
    CHECK(has(refusal("x", {.spacing = 1, .time = true}).hint, "name t;"));
    CHECK(has(refusal("z", {.dimensions = 2, .spacing = 1, .position = true}).hint, "x, y;"));
    CHECK(has(refusal("x", {}).hint, "no variables"));
    CHECK(compiled("x*y", {.dimensions = 2, .spacing = 1, .position = true})({2, 3, 0}, 0) == 6.0);
}

TEST_CASE("Formula.IsTheSameFromEveryThread") {
    const Formula formula = compiled("sin(37*x)*exp(-y)/(1 + z*z) + t");
    const auto place = [](int k) { return proto::Vec3{0.01 * k, 0.02 * k, 0.03 * k}; };
    std::vector<double> expected, guarded(4000), team_values(4000);
    for (int k = 0; k < 4000; ++k) expected.push_back(formula(place(k), 0.5));

    std::vector<std::thread> threads;
    for (int part = 0; part < 4; ++part)
        threads.emplace_back([&, part] {
            for (int k = part; k < 4000; k += 4) guarded[k] = formula(place(k), 0.5);
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(guarded == expected);

    scene::FormulaTeam team(formula);
    team.prepare(4);
#pragma omp parallel for num_threads(4)
    for (int k = 0; k < 4000; ++k) team_values[k] = team(omp_get_thread_num(), place(k), 0.5);
    CHECK(team_values == expected);
}

TEST_CASE("Formula.CopiesDoNotDisturbEachOther") {
    const Formula a = compiled("x + t");
    const Formula b = a;
    CHECK(a({1, 0, 0}, 2) == 3.0);
    CHECK(b({4, 0, 0}, 5) == 9.0);
    CHECK(a({1, 0, 0}, 2) == 3.0);
}

TEST_CASE("CompileVector.NamesTheComponent") {
    const auto vector = scene::compile_vector({std::string("x"), 2.0, std::string("oops")}, kAll, "v");
    REQUIRE_FALSE(vector.ok());
    CHECK(vector.error().path == "v[2]");
    // In 2D the third does not count.
    CHECK(scene::compile_vector({std::string("x"), 2.0, 0.0}, {.dimensions = 2, .spacing = 1, .position = true}, "v")
              .ok());
}
