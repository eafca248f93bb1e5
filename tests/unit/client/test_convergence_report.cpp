#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "client/convergence_report.h"

using namespace headrace;
using namespace headrace::client;

namespace {

// Probes that converge with order 1 and 2 to 1, with an error of the sound speed of 0.4/c^2; a profile, and a dry
// probe.
StudyRun sample_run(double spacing, double sound_speed) {
    StudyRun run{spacing, sound_speed, 100, 40, 0.5, {}};
    const double offset = 1 + 0.4 / (sound_speed * sound_speed);
    const double first = offset + spacing, second = offset + spacing * spacing;
    run.probes.push_back({"gauge", {{"time", "s", {}}, {"level", "m", {}}}, {{0.0, first}, {1.0, first}}, 0});
    run.probes.push_back({"line",
                          {{"time", "s", {}}, {"vx_0", "m/s", 0.0}, {"vx_1", "m/s", 0.5}},
                          {{0.0, second, std::nullopt}, {1.0, second, std::nullopt}},
                          0});
    run.probes.push_back({"dry", {{"time", "s", {}}, {"pressure", "Pa", {}}}, {{0.0, std::nullopt}}, 0});
    return run;
}

Study sample_study(Measure measure) {
    return {"sample",          2, 1.0, measure, {sample_run(0.4, 2), sample_run(0.2, 2), sample_run(0.1, 2)},
            sample_run(0.2, 4)};
}

constexpr double kRounding = 1e-10;  // of an order found by bisection; the rest is better

}  // namespace

TEST_CASE("ConvergenceReport.AddsTheBarsOfSpacingAndSound") {
    for (const Measure measure : {Measure::curve, Measure::last, Measure::max}) {
        const std::vector<StudyRow> rows = evaluate(sample_study(measure));
        REQUIRE(rows.size() == 5);
        const StudyRow& gauge = rows[0];
        CHECK(gauge.column == "level");
        CHECK(*gauge.resolution.order == Approx(1).margin(kRounding));
        CHECK(*gauge.extrapolated == Approx(1.1).margin(kRounding));
        CHECK(gauge.resolution.error == Approx(1.25 * 0.1).margin(kRounding));
        CHECK(*gauge.compressibility_error == Approx(1.25 * 0.1).margin(kRounding));
        CHECK(gauge.total_error == Approx(1.25 * 0.2).margin(kRounding));
    }
}

TEST_CASE("ConvergenceReport.AProfileIsOneResultAndItsPoints") {
    const std::vector<StudyRow> rows = evaluate(sample_study(Measure::curve));
    CHECK(rows[1].column == "profile");
    CHECK_FALSE(rows[1].is_point);
    CHECK(*rows[1].resolution.order == Approx(2).margin(kRounding));
    CHECK(rows[1].covered == Approx(0.5));
    CHECK(rows[2].is_point);
    CHECK(rows[2].is_compared);
    CHECK_FALSE(rows[3].is_compared);
    const std::string table = study_table(sample_study(Measure::curve), rows);
    CHECK(table.find("line.profile") != std::string::npos);
    CHECK(table.find("vx_0") == std::string::npos);
    CHECK(study_csv(rows).find("line,vx_0,0,m/s,") != std::string::npos);
}

TEST_CASE("ConvergenceReport.SaysWhereNothingCanBeCompared") {
    const Study study = sample_study(Measure::curve);
    const std::vector<StudyRow> rows = evaluate(study);
    CHECK_FALSE(rows[4].is_compared);
    CHECK(study_table(study, rows).find("no time at which all runs have a value") != std::string::npos);
    // Each line of the file has all columns, empty ones too.
    const std::string csv = study_csv(rows);
    std::size_t commas = 0;
    for (std::size_t at = 0, last = 0; (at = csv.find('\n', last)) != std::string::npos; last = at + 1) {
        const auto found = static_cast<std::size_t>(std::count(csv.begin() + last, csv.begin() + at, ','));
        if (commas == 0) commas = found;
        CHECK(found == commas);
    }
    CHECK_FALSE(study_json(study, rows)["results"][4].contains("total_error"));
}

TEST_CASE("ConvergenceReport.WorksWithoutASecondSoundSpeed") {
    Study study = sample_study(Measure::curve);
    study.faster.reset();
    const std::vector<StudyRow> rows = evaluate(study);
    CHECK_FALSE(rows[0].compressibility_error);
    CHECK(rows[0].total_error == rows[0].resolution.error);
    CHECK(study_table(study, rows).find("without that of the finite sound speed") != std::string::npos);
    CHECK(study_json(study, rows)["runs"].size() == 3);
}

TEST_CASE("ConvergenceReport.TellsWhenTheFluidsVolumeDiffers") {
    Study study = sample_study(Measure::curve);
    for (StudyRun& run : study.runs) run.particles = static_cast<std::int64_t>(1.6 / (run.spacing * run.spacing) + 0.5);
    CHECK(study_table(study, evaluate(study)).find("volume") == std::string::npos);
    study.runs[0].particles = 9;  // instead of 10: 1.44 instead of 1.6
    CHECK(study_table(study, evaluate(study)).find("volume differs by 11 %") != std::string::npos);
}
