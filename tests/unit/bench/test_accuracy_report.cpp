#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "tests/bench/accuracy_report.h"

using namespace headrace;
using bench::AccuracyRow;

namespace {

AccuracyRow row(double dp, double wall, double error, const std::string& option = "default") {
    return {"hydrostatic", "rms_pressure", "wcsph", option, 2, dp, 3.0, 44.3, 100, 10, wall, error};
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("ParetoFront.HoldsWhatNothingBeats") {
    const std::vector<AccuracyRow> rows{row(0.1, 1, 0.1),   row(0.1, 2, 0.2),  row(0.1, 3, 0.05), row(0.1, 4, kNone),
                                        row(0.1, 0.5, 1.0), row(0.1, 3, 0.04), row(0.1, 0.1, 1.1)};
    CHECK(bench::find_pareto_front(rows) == std::vector<std::size_t>{4, 0, 5});
    CHECK(bench::find_pareto_front({}).empty());
}

TEST_CASE("Order.IsTheSlopeOfTheErrors") {
    CHECK(*bench::fit_order({row(0.1, 1, 0.04), row(0.05, 1, 0.01), row(0.025, 1, 0.0025)}) == Approx(2.0));
    CHECK(*bench::fit_order({row(0.1, 1, 0.01), row(0.05, 1, kNone), row(0.025, 1, 0.02)}) == Approx(-0.5));
    CHECK_FALSE(bench::fit_order({row(0.1, 1, 0.04)}).has_value());
    CHECK_FALSE(bench::fit_order({row(0.1, 1, 0.04), row(0.1, 1, 0.02)}).has_value());
}

TEST_CASE("CheapestSetting.ReachesTheErrorInTheLeastTime") {
    const std::vector<AccuracyRow> rows{row(0.1, 1, 0.02), row(0.05, 3, 0.002), row(0.05, 2, 0.009)};
    CHECK(*bench::find_cheapest(rows, 0.01) == 2);
    CHECK(*bench::find_cheapest(rows, 0.003) == 1);
    CHECK_FALSE(bench::find_cheapest(rows, 1e-4).has_value());
}

TEST_CASE("AccuracyRows.SurviveTheFile") {
    const std::string path = "accuracy_rows_test.csv";
    const std::vector<AccuracyRow> written{row(0.02, 1.5, 0.003), row(0.01, 12, kNone, "c0 x 2")};
    {
        std::ofstream file(path);
        file << bench::accuracy_head() << '\n';
        for (const AccuracyRow& one : written) file << bench::to_csv(one) << '\n';
    }
    const auto read = bench::load_rows(path);
    std::remove(path.c_str());
    REQUIRE(read.size() == 2);
    CHECK(read[0].case_name == "hydrostatic");
    CHECK(read[0].metric == "rms_pressure");
    CHECK(read[0].particles == 100);
    CHECK(read[0].error == Approx(0.003));
    CHECK(read[1].option == "c0 x 2");
    CHECK(read[1].dp == Approx(0.01));
    CHECK(read[1].wall_s == Approx(12));
    CHECK(std::isnan(read[1].error));
}

TEST_CASE("Summary.NamesTheCheapestSettings") {
    const std::string text = bench::summarise({row(0.04, 1, 0.02), row(0.02, 8, 0.005)});
    CHECK(text.find("- 1 %: wcsph default, dp 0.02 m") != std::string::npos);
    CHECK(text.find("- 0.3 %: not reached") != std::string::npos);
    CHECK(text.find("| wcsph default | 2.0 |") != std::string::npos);
}
