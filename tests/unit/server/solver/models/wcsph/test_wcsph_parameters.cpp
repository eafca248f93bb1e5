#include <algorithm>
#include <catch2/catch.hpp>

#include "server/solver/models/wcsph/parameters.h"

using namespace headrace::solver;

namespace {

bool same(const ParameterValue& a, const ParameterValue& b) {
    return a == b;
}

// Another value of the same kind that the row allows.
ParameterValue other_value(const ParameterInfo& info) {
    if (const auto* number = std::get_if<double>(&info.default_value)) {
        const double half = 0.5 * (*number + (std::isfinite(info.max) ? info.max : 2.0 * *number + 1.0));
        return half;
    }
    if (const auto* flag = std::get_if<bool>(&info.default_value)) return !*flag;
    if (const auto* name = std::get_if<std::string>(&info.default_value))
        return name->compare(info.choices.front()) == 0 ? info.choices.back() : info.choices.front();
    return Vec3{1.0, 2.0, 3.0};
}

}  // namespace

TEST_CASE("WcsphParameters.EveryRowGoesThereAndBack") {
    const std::vector<ParameterInfo> table = wcsph_parameter_table(2, 0.01);
    const ParameterMap defaults = to_parameter_map(make_wcsph_parameters({}));
    REQUIRE(defaults.size() == table.size());
    for (const ParameterInfo& info : table) {
        INFO(info.name);
        REQUIRE(defaults.contains(info.name));
        CHECK(same(defaults.at(info.name), info.default_value));
        const ParameterValue other = other_value(info);
        REQUIRE_FALSE(same(other, info.default_value));
        REQUIRE_FALSE(check_parameters(table, {{info.name, other}}));
        const ParameterMap changed = to_parameter_map(make_wcsph_parameters({{info.name, other}}));
        for (const auto& [name, value] : changed) {
            INFO("seen in " << name);
            CHECK(same(value, name == info.name ? other : defaults.at(name)));
        }
        for (const std::string& choice : info.choices) {
            const auto map = to_parameter_map(make_wcsph_parameters({{info.name, choice}}));
            CHECK(std::get<std::string>(map.at(info.name)) == choice);
        }
    }
}

TEST_CASE("WcsphParameters.AreExplained") {
    for (const ParameterInfo& info : wcsph_parameter_table(3, 0.01)) {
        INFO(info.name);
        CHECK(std::string(info.meaning).size() > 10);
        CHECK_FALSE(std::string(info.unit).empty());
        CHECK(info.choices.empty() == !std::holds_alternative<std::string>(info.default_value));
    }
}

TEST_CASE("WcsphParameters.BadValuesAreRefused") {
    const std::vector<ParameterInfo> table = wcsph_parameter_table(2, 0.01);
    CHECK(check_parameters(table, {{"rest_density", 0.0}}));
    CHECK(check_parameters(table, {{"viscosity", -1.0}}));
    CHECK(check_parameters(table, {{"kernel", std::string("gauss")}}));
    CHECK(check_parameters(table, {{"cfl", std::string("big")}}));
    CHECK(check_parameters(table, {{"shifting", 1.0}}));
    CHECK(check_parameters(table, {{"stiffness", 1.0}}));
}
