#include <catch2/catch.hpp>

#include "client/frame_selection.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using proto::Field;
using tests::SyntheticFrame;

TEST_CASE("FrameSelection.RegionKeepsTheParticlesInsideFacesIncluded") {
    SyntheticFrame frame(2, 4, 0.5, 7);
    frame.column<std::uint32_t>(Field::id, "<u4", 1, {10, 11, 12, 13});
    frame.column<float>(Field::position, "<f4", 2, {0, 0, 1, 1, 2, 1, 0.5f, 3});
    frame.column<double>(Field::density, "<f8", 1, {1, 2, 3, 4});
    std::vector<std::byte> bytes;
    // z does not count in a flat frame.
    const proto::FrameView part = client::select_region(frame.view(), {{0, 0, 5}, {1, 1, 6}}, bytes);
    REQUIRE(part.info.particle_count == 2);
    CHECK(part.info.step == 7);
    CHECK(proto::FrameView::value(*part.find(Field::id), 1, 0) == 11);
    CHECK(proto::FrameView::value(*part.find(Field::position), 1, 1) == 1);
    CHECK(proto::FrameView::value(*part.find(Field::density), 1, 0) == 2);

    CHECK(client::select_region(frame.view(), {{7, 7, 0}, {8, 8, 0}}, bytes).info.particle_count == 0);
}

TEST_CASE("FrameSelection.FieldsKeepTheirOrderAndBytes") {
    SyntheticFrame frame(3, 1, 0);
    frame.column<std::uint32_t>(Field::id, "<u4", 1, {1}).column<float>(Field::pressure, "<f4", 1, {2});
    const proto::FrameView part = client::select_fields(frame.view(), {Field::pressure, Field::velocity});
    REQUIRE(part.columns.size() == 1);
    CHECK(part.columns[0].bytes.data() == frame.view().columns[1].bytes.data());
}

// A thousand particles in a row, two of them far away: two in a thousand are spray.
TEST_CASE("FrameSelection.BoundsLeaveOutTheSpray") {
    std::vector<float> places;
    for (int k = 0; k < 1000; ++k) {
        places.push_back(k < 2 ? 100.0f : static_cast<float>(k) / 1000);
        places.push_back(0.5f);
    }
    SyntheticFrame frame(2, 1000, 0);
    frame.column<float>(Field::position, "<f4", 2, places);
    const proto::BoxDesc bounds = client::bounds_without_spray(frame.view());
    CHECK(bounds.max[0] < 1);
    CHECK(bounds.max[0] > 0.99);
    CHECK(bounds.min[0] < 0.01);
    CHECK(bounds.min[1] == 0.5);
    CHECK(bounds.min[2] == 0);

    SyntheticFrame empty(2, 0, 0);
    empty.column<float>(Field::position, "<f4", 2, {});
    CHECK(client::bounds_without_spray(empty.view()).min[0] > client::bounds_without_spray(empty.view()).max[0]);
}
