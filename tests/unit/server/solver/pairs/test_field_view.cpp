// Fields as the pair loops read them: stored, or made of what is stored.
#include <array>
#include <catch2/catch.hpp>
#include <vector>

#include "server/solver/pairs/field_view.h"

using namespace headrace::solver;

namespace {

const std::vector<double> kWide{0.1, -2.0, 3.0, 0.7}, kDivisor{3.0, 7.0, -0.3, 11.0};
const std::vector<float> kNarrow{0.1F, 5.0F, -0.25F, 1e-30F};

}  // namespace

TEST_CASE("FieldView.MakesInDoublePrecisionWhatIsNotStored") {
    const FieldView product(kWide, kNarrow), quotient = FieldView::quotient(kWide, kDivisor), scaled(1e-40, kNarrow),
                                             extrapolated = FieldView::extrapolated(kWide, 0.3, kNarrow);
    for (std::size_t i = 0; i < kWide.size(); ++i) {
        CHECK(FieldView(kWide)[i] == kWide[i]);
        CHECK(FieldView(kNarrow)[i] == static_cast<double>(kNarrow[i]));
        CHECK(product[i] == kWide[i] * static_cast<double>(kNarrow[i]));
        CHECK(quotient[i] == kWide[i] / kDivisor[i]);
        CHECK(scaled[i] == 1e-40 * static_cast<double>(kNarrow[i]));
        CHECK(extrapolated[i] == kWide[i] + 0.3 * static_cast<double>(kNarrow[i]));
        CHECK(FieldView()[i] == 0.0);
    }
}

TEST_CASE("FieldView.ReadsAsManyAsAskedFor") {
    std::array<double, 4> to{9.0, 9.0, 9.0, 9.0};
    FieldView(kWide).read(1, 2, to.data());
    CHECK(to == std::array<double, 4>{-2.0, 3.0, 9.0, 9.0});
}

TEST_CASE("FieldView.WhatIsNotStoredIsZero") {
    CHECK(view_or_zero(std::vector<double>{})[3] == 0.0);
    CHECK(view_or_zero(std::vector<float>{})[3] == 0.0);
    CHECK(view_or_zero(kWide)[3] == 0.7);
}
