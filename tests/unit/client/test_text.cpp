#include <catch2/catch.hpp>
#include <set>

#include "client/text.h"

using namespace headrace;
using namespace headrace::client;

TEST_CASE("Text.NumbersReadEasily") {
    CHECK(with_thousands(0) == "0");
    CHECK(with_thousands(999) == "999");
    CHECK(with_thousands(3'000) == "3,000");
    CHECK(with_thousands(-1'234'567) == "-1,234,567");
    CHECK(number(0.01) == "0.01");
    CHECK(number(12.340) == "12.34");
    CHECK(number(-0.0) == "0");
    CHECK(plural(1, "frame") == "1 frame");
    CHECK(plural(2'000, "frame") == "2,000 frames");
    CHECK(recording_summary(301, 0) == "301 frames, 0 gaps");
    CHECK(at_moment(1'234, 12.34) == "step 1,234, t 12.34 s");
    CHECK(duration_text(7.4) == "0:07");
    CHECK(duration_text(3'723) == "1:02:03");
    CHECK(duration_text(1.0 / 0.0) == "?");
}

TEST_CASE("Text.EnergiesHaveTheUnitOfTheirDimensions") {
    CHECK(energy_text(1.5, 3) == "1.5 J");
    CHECK(energy_text(1.5, 2) == "1.5 J/m");
    CHECK(energy_text(1.5, {}) == "1.5 J (2D: J/m)");
}

TEST_CASE("Text.ErrorLineNamesErrorPathAndRemedy") {
    using proto::ErrorCode;
    // A suggestion says it all.
    CHECK(error_line({ErrorCode::object_not_found, "there is no object \"pannel\"", "params.name",
                      "did you mean \"panel\"?"}) == "error object_not_found (params.name): did you mean \"panel\"?");
    CHECK(error_line({ErrorCode::wrong_state, "no scene is loaded", "", "load one first"}) ==
          "error wrong_state: no scene is loaded; load one first");
    // A file's name once.
    CHECK(error_line({ErrorCode::file_error, "a.mcap: not a regular file", "a.mcap", ""}) ==
          "error file_error (a.mcap): not a regular file");
    CHECK(error_line({ErrorCode::internal_error, "broken", "", ""}) == "error internal_error: broken");
}

TEST_CASE("Text.ExitStatusesAreTheDocumentedOnes") {
    std::set<int> statuses;
    for (const proto::ErrorInfo& info : proto::kErrors) statuses.insert(info.exit_code);
    CHECK(statuses == std::set<int>{1, 2, 3, 4, 5, 6, 7, 8});
    CHECK(proto::error_info(proto::ErrorCode::object_not_found).exit_code == 4);
    CHECK(proto::error_info(proto::ErrorCode::timed_out).exit_code == 8);
}

TEST_CASE("Text.ParametersPrintAsTheyAreTyped") {
    CHECK(parameter_text(3.5) == "3.5");
    CHECK(parameter_text(true) == "true");
    CHECK(parameter_text(std::string("cubic")) == "cubic");
    CHECK(parameter_text(proto::Vec3{0, -9.8, 0}) == "0,-9.8,0");
}
