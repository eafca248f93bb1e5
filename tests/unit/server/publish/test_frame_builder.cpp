#include <catch2/catch.hpp>
#include <cstring>

#include "server/publish/frame_builder.h"

using namespace headrace;

namespace {

template <class Value>
Value at(const publish::Column& column, std::size_t index) {
    Value value;
    std::memcpy(&value, column.bytes.get() + index * sizeof value, sizeof value);
    return value;
}

// Three particles in storage order 2, 0, 1.
solver::Particles shuffled(int dimensions) {
    solver::Particles particles;
    particles.dimensions = dimensions;
    particles.resize(3);
    particles.id = {2, 0, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        for (int k = 0; k < dimensions; ++k) particles.x[k][i] = 10.0 * particles.id[i] + k;
        particles.rho[i] = 1'000.0 + particles.id[i];
    }
    return particles;
}

}  // namespace

TEST_CASE("FrameBuilder.RowsAscendById") {
    const int dimensions = GENERATE(2, 3);
    const auto capture =
        publish::copy_fields(shuffled(dimensions), {proto::Field::id, proto::Field::position, proto::Field::density},
                             proto::Precision::f8, {7, 0.5, {}}, 4);
    REQUIRE(capture->columns.size() == 3);
    CHECK(capture->step == 7);
    CHECK(capture->generation == 4);
    CHECK(capture->columns[1].components == dimensions);
    CHECK(capture->columns[1].dtype == "<f8");
    for (std::size_t row = 0; row < 3; ++row) {
        CHECK(at<std::uint32_t>(capture->columns[0], row) == row);
        for (int k = 0; k < dimensions; ++k)
            CHECK(at<double>(capture->columns[1],
                             row * static_cast<std::size_t>(dimensions) + static_cast<std::size_t>(k)) ==
                  10.0 * static_cast<double>(row) + k);
        CHECK(at<double>(capture->columns[2], row) == 1'000.0 + static_cast<double>(row));
    }
}

TEST_CASE("FrameBuilder.SinglePrecisionIsTheNearestFloat") {
    const auto capture =
        publish::copy_fields(shuffled(3), {proto::Field::density}, proto::Precision::f4, {0, 0.0, {}}, 0);
    REQUIRE(capture->columns.size() == 1);
    CHECK(capture->columns[0].size == 12);
    CHECK(at<float>(capture->columns[0], 1) == 1'001.0f);
}
