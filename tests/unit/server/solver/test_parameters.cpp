#include <catch2/catch.hpp>
#include <cmath>

#include "server/solver/parameters.h"

using namespace headrace::solver;

namespace {

std::vector<ParameterInfo> table() {
    ParameterInfo step{"step", "s", "Time step.", 0.01};
    step.min = 0.0;
    step.min_is_exclusive = true;
    ParameterInfo share{"share", "1", "A share.", 0.5};
    share.min = 0.0;
    share.max = 1.0;
    ParameterInfo form{"form", "1", "A form.", std::string("round")};
    form.choices = {"round", "square"};
    return {step, share, form, {"flag", "1", "A flag.", true}, {"g", "m/s^2", "A vector.", Vec3{}}};
}

std::string refusal(const char* name, ParameterValue value) {
    const auto error = check_parameters(table(), {{name, std::move(value)}});
    if (!error) return "accepted";
    CHECK(error->name == name);
    CHECK_FALSE(error->unknown);
    return error->message;
}

}  // namespace

TEST_CASE("Parameters.AdmissibleValuesAreAccepted") {
    CHECK_FALSE(check_parameters(
        table(),
        {{"step", 1e-9}, {"share", 1.0}, {"form", std::string("square")}, {"flag", false}, {"g", Vec3{0, -9.82, 0}}}));
    CHECK_FALSE(check_parameters(table(), {{"share", 0.0}}));
    CHECK_FALSE(check_parameters(table(), {}));
}

TEST_CASE("Parameters.UnknownNameIsSaidToBeUnknown") {
    const auto error = check_parameters(table(), {{"stepp", 1.0}});
    REQUIRE(error);
    CHECK(error->unknown);
    CHECK(error->name == "stepp");
    CHECK(error->hint.find("step") != std::string::npos);
}

TEST_CASE("Parameters.RefusalsSayWhatIsWrong") {
    CHECK(refusal("step", -0.01) == "must be greater than 0 s, got -0.01");
    CHECK(refusal("step", 0.0) == "must be greater than 0 s, got 0");
    CHECK(refusal("share", -0.5) == "must be at least 0, got -0.5");
    CHECK(refusal("share", 1.5) == "must be at most 1, got 1.5");
    CHECK(refusal("share", std::nan("")) == "must be finite");
    CHECK(refusal("step", INFINITY) == "must be finite");
    CHECK(refusal("g", Vec3{0, INFINITY, 0}) == "each component must be finite");
    CHECK(refusal("form", std::string("oval")) == "must be one of \"round\" \"square\", got \"oval\"");
    CHECK(refusal("form", 1.0) == "must be a string, got a number");
    CHECK(refusal("flag", 1.0) == "must be true or false, got a number");
    CHECK(refusal("step", true) == "must be a number, got true or false");
    CHECK(refusal("g", 9.82) == "must be a vector of three numbers, got a number");
}
