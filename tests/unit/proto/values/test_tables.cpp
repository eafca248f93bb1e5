#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "proto/values/tables.h"

using namespace headrace;
using scene::Table;

namespace {

std::string refused_path(std::vector<std::vector<double>> rows, int columns = 1) {
    const auto table = Table::make({std::move(rows)}, columns, "here");
    if (table.ok()) return "taken";
    CHECK(table.error().code == proto::ErrorCode::scene_invalid);
    CHECK_FALSE(table.error().message.empty());
    CHECK_FALSE(table.error().hint.empty());
    return table.error().path;
}

// Rows of sin t over [0, 2 pi]: its second derivative vanishes at both ends, as the natural spline's does.
Table sine_table(int intervals) {
    proto::TableDesc desc;
    for (int k = 0; k <= intervals; ++k) {
        const double t = 2 * M_PI * k / intervals;
        desc.rows.push_back({t, std::sin(t)});
    }
    return *Table::make(desc, 1, "here");
}

double worst_error(int intervals) {
    const Table table = sine_table(intervals);
    double worst = 0.0;
    for (int k = 0; k <= 1000; ++k) {
        const double t = 2 * M_PI * k / 1000;
        worst = std::max(worst, std::abs(table.at(0, t).value - std::sin(t)));
    }
    return worst;
}

}  // namespace

TEST_CASE("Table.GoesThroughItsRows") {
    const auto table = Table::make({{{0.0, 1.0, -2.0}, {0.5, 3.0, 4.0}, {2.0, -1.0, 0.5}}}, 2, "here");
    REQUIRE(table.ok());
    CHECK(table->at(0, 0.0).value == 1.0);
    CHECK(table->at(0, 0.5).value == Approx(3.0).epsilon(1e-14));
    CHECK(table->at(1, 0.5).value == Approx(4.0).epsilon(1e-14));
    CHECK(table->at(1, 2.0).value == Approx(0.5).epsilon(1e-14));
    CHECK(table->start() == 0.0);
    CHECK(table->end() == 2.0);
}

TEST_CASE("Table.IsConstantOutside") {
    const auto table = Table::make({{{0.0, 1.0}, {1.0, 3.0}, {2.0, 2.0}}}, 1, "here");
    for (const double t : {-5.0, -1e-9}) {
        CHECK(table->at(0, t).value == 1.0);
        CHECK(table->at(0, t).rate == 0.0);
    }
    CHECK(table->at(0, 7.0).value == 2.0);
    CHECK(table->at(0, 7.0).acceleration == 0.0);
}

TEST_CASE("Table.TwoRowsAreALine") {
    const auto table = Table::make({{{1.0, 2.0}, {3.0, 8.0}}}, 1, "here");
    const scene::CurvePoint point = table->at(0, 1.5);
    CHECK(point.value == Approx(3.5));
    CHECK(point.rate == Approx(3.0));
    CHECK(point.acceleration == 0.0);
}

TEST_CASE("Table.ConvergesWithTheFourthOrder") {
    // Error 5/384 max|f''''| h^4 of a complete spline; the natural one of a function without curvature at the ends has
    // the same order. Halving h must gain nearly 16.
    CHECK(worst_error(20) < 2.0 * 5.0 / 384.0 * std::pow(2 * M_PI / 20, 4));
    CHECK(worst_error(20) / worst_error(40) > 14.0);
}

TEST_CASE("Table.DerivativesAreThoseOfItsValues") {
    const Table table = sine_table(20);
    const double h = 1e-5;  // truncation and rounding of these differences stay below 1e-9 and 1e-5
    for (const double t : {0.1, 1.0, 2.5, 4.0, 6.1}) {
        const double before = table.at(0, t - h).value, here = table.at(0, t).value, after = table.at(0, t + h).value;
        CHECK(table.at(0, t).rate == Approx((after - before) / (2 * h)).margin(1e-8));
        CHECK(table.at(0, t).acceleration == Approx((after - 2 * here + before) / (h * h)).margin(2e-5));
    }
    // Smooth over a row up to the second derivative.
    const double row = 2 * M_PI / 20 * 7;
    CHECK(table.at(0, row - 1e-12).acceleration == Approx(table.at(0, row + 1e-12).acceleration).margin(1e-10));
    CHECK(table.at(0, row - 1e-12).rate == Approx(table.at(0, row + 1e-12).rate).margin(1e-10));
}

TEST_CASE("Table.RefusalsNameTheRow") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused_path({{0, 1}, {1, 2}}) == "taken");
    CHECK(refused_path({{0, 1}}) == "here.table");
    CHECK(refused_path({{0, 1}, {1, 2}, {1, 3}}) == "here.table[2][0]");
    CHECK(refused_path({{0, 1}, {1, 2}, {0.5, 3}}) == "here.table[2][0]");
    CHECK(refused_path({{0, 1}, {1, 2, 3}}) == "here.table[1]");
    CHECK(refused_path({{0}, {1}}) == "here.table[0]");
    CHECK(refused_path({{0, 1}, {1, nan}}) == "here.table[1][1]");
    CHECK(refused_path({{0, 1}, {nan, 1}}) == "here.table[1][0]");
    // No curve of finite curvature goes through these.
    CHECK(refused_path({{0, 1e308}, {1e-300, -1e308}, {1, 0}}) == "here.table[1]");
}

TEST_CASE("Table.OfFlatVectorsMayHaveAThirdColumnOfZeros") {
    CHECK(Table::make({{{0, 1, 2, 0}, {1, 2, 3, 0}}}, 2, "here", true).ok());
    CHECK_FALSE(Table::make({{{0, 1, 2, 0.5}, {1, 2, 3, 0}}}, 2, "here", true).ok());
    CHECK_FALSE(Table::make({{{0, 1, 2, 0}, {1, 2, 3, 0}}}, 2, "here", false).ok());
}
