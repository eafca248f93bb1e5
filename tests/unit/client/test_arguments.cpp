#include <catch2/catch.hpp>

#include "client/arguments.h"

using namespace headrace;
using namespace headrace::client;

TEST_CASE("Arguments.ValuesTakeTheTypeTheyLookLike") {
    CHECK(std::get<double>(parse_parameter_value("5")) == 5.0);
    CHECK(std::get<double>(parse_parameter_value("-9.8e3")) == -9.8e3);
    CHECK(std::get<bool>(parse_parameter_value("true")));
    CHECK_FALSE(std::get<bool>(parse_parameter_value("false")));
    CHECK(std::get<proto::Vec3>(parse_parameter_value("0,-9.8,0")) == proto::Vec3{0, -9.8, 0});
    CHECK(std::get<proto::Vec3>(parse_parameter_value("1,2")) == proto::Vec3{1, 2, 0});
    CHECK(std::get<std::string>(parse_parameter_value("wendland")) == "wendland");
    // Neither is a number that may travel.
    CHECK(std::get<std::string>(parse_parameter_value("nan")) == "nan");
    CHECK(std::get<std::string>(parse_parameter_value("5 ")) == "5 ");
}

TEST_CASE("Arguments.AssignmentsNeedNameAndValue") {
    const auto parameters = parse_assignments({"viscosity=5", "label=a=b"});
    REQUIRE(parameters);
    CHECK(std::get<double>(parameters->at("viscosity")) == 5.0);
    CHECK(std::get<std::string>(parameters->at("label")) == "a=b");
    for (const char* word : {"viscosity", "=5", ""}) {
        const auto refused = parse_assignments({word});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == proto::ErrorCode::usage);
    }
    CHECK_FALSE(parse_assignments({"a=1", "a=2"}));
}

TEST_CASE("Arguments.UntilNamesOneEnd") {
    CHECK(parse_until("at-rest")->at_rest == true);
    CHECK(parse_until("2")->time == 2.0);
    CHECK(parse_until("2.5s")->time == 2.5);
    CHECK(parse_until("+0.5")->duration == 0.5);
    CHECK(parse_until("step=400")->step == 400);
    CHECK(parse_until("steps=7")->steps == 7);
    CHECK(parse_until("gauge>0.3")->probe->probe == "gauge");
    CHECK(parse_until("gauge>0.3")->probe->above == 0.3);
    CHECK(parse_until("tank.fx<-1e3")->probe->below == -1e3);
    CHECK_FALSE(parse_until("tank.fx<-1e3")->probe->above);
    CHECK_FALSE(parse_until("gauge>high"));
    CHECK_FALSE(parse_until(">0.3"));
    const auto until = parse_until("2");
    CHECK_FALSE(until->at_rest);
    CHECK_FALSE(until->duration);
    for (const char* word : {"", "rest?", "-1", "step=", "step=-3", "steps=1.5", "inf"}) {
        const auto refused = parse_until(word);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().path == "--until");
    }
}

TEST_CASE("Arguments.FieldsComeFromTheTable") {
    const auto fields = parse_fields("id,velocity");
    REQUIRE(fields);
    CHECK(*fields == proto::FieldSet{proto::Field::id, proto::Field::velocity});
    const auto slip = parse_fields("velocty");
    REQUIRE_FALSE(slip);
    CHECK(slip.error().hint == "did you mean \"velocity\"?");
}

TEST_CASE("Arguments.ColoursMayBeNamedAsPeopleDo") {
    for (const char* word : {"velocity", "speed", "|velocity|"})
        CHECK(*parse_color_field(word) == proto::Field::velocity);
    CHECK(*parse_color_field("p") == proto::Field::pressure);
    CHECK(*parse_color_field("rho") == proto::Field::density);
    CHECK(parse_color_field("presure").error().hint == "did you mean \"pressure\"?");
    CHECK(parse_color_field("speedy").error().path == "--color-by");
}

TEST_CASE("Arguments.RangeMayBeOpen") {
    CHECK(parse_range("0:2")->first == 0.0);
    CHECK(parse_range("0:2")->second == 2.0);
    CHECK_FALSE(parse_range(":2")->first);
    CHECK_FALSE(parse_range("1:")->second);
    for (const char* word : {"2", "2:1", "a:b", "1:2:3"}) CHECK_FALSE(parse_range(word));
}

TEST_CASE("Arguments.SizeIsWidthByHeight") {
    CHECK(*parse_size("1280x720") == std::pair{1280, 720});
    for (const char* word : {"1280", "0x100", "axb", "100000x10", "1x2x3"}) CHECK_FALSE(parse_size(word));
}

TEST_CASE("Arguments.RemovalNamesObjectAndMoment") {
    const auto at_rest = parse_removal("panel@at-rest");
    REQUIRE(at_rest);
    CHECK(at_rest->object == "panel");
    CHECK(at_rest->when.at_rest == true);
    CHECK(parse_removal("panel@1.5")->when.time == 1.5);
    for (const char* word : {"panel", "@2", "panel@", "panel@never"}) CHECK_FALSE(parse_removal(word));
}

TEST_CASE("Arguments.ShapesHaveTheirNumbers") {
    CHECK(parse_box("0,1,2,3,4,5")->max == proto::Vec3{3, 4, 5});
    CHECK(parse_box("0,1,2,3")->max == proto::Vec3{2, 3, 0});
    CHECK(parse_sphere("1,2,3,0.5")->radius == 0.5);
    CHECK(parse_sphere("1,2,0.5")->center == proto::Vec3{1, 2, 0});
    CHECK_FALSE(parse_box("0,1,2"));
    CHECK_FALSE(parse_sphere("0,1"));
    CHECK(parse_cylinder("0,1,2,3,4,5,0.5")->to == proto::Vec3{3, 4, 5});
    CHECK(parse_cylinder("0,1,2,3,4,5,0.5")->radius == 0.5);
    CHECK_FALSE(parse_cylinder("0,1,2,3,0.5"));
    CHECK(parse_plane("1,2,0,-1")->normal == proto::Vec3{0, -1, 0});
    CHECK(parse_plane("1,2,3,0,0,1")->point == proto::Vec3{1, 2, 3});
    CHECK_FALSE(parse_plane("1,2,0"));
    CHECK_FALSE(parse_vector("1", "--by"));
}
