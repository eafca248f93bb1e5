#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <sstream>

#include "client/writers/writer.h"
#include "tests/unit/client/writers/synthetic.h"

using namespace headrace;
using namespace headrace::tests;
using proto::Field;

namespace {

std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& file) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(read_text(file));
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        rows.push_back(cells);
    }
    return rows;
}

std::unique_ptr<client::Writer> csv_writer(const TemporaryFolder& folder) {
    client::WriterOptions options;
    options.folder = folder.path();
    options.stem = "wave";
    auto writer = client::make_writer("csv", options);
    REQUIRE(writer.ok());
    return std::move(*writer);
}

}  // namespace

TEST_CASE("CsvWriter.EveryNumberReadsBackExactly") {
    const unsigned seed = std::random_device{}();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    constexpr std::size_t kRows = 200;
    // Finite numbers of all magnitudes, by random bits.
    std::vector<float> velocities(2 * kRows);
    for (float& value : velocities) do
            value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        while (!std::isfinite(value));
    std::vector<double> densities(kRows);
    for (double& value : densities) do
            value = std::bit_cast<double>(random());
        while (!std::isfinite(value));
    std::vector<std::uint32_t> ids(kRows);
    for (std::uint32_t& id : ids) id = static_cast<std::uint32_t>(random());

    TemporaryFolder folder;
    auto writer = csv_writer(folder);
    SyntheticFrame frame(2, kRows, 0.5);
    frame.column(Field::id, "<u4", 1, ids).column(Field::velocity, "<f4", 2, velocities);
    frame.column(Field::density, "<f8", 1, densities);
    REQUIRE(writer->write(frame.view(), {}).ok());

    const auto rows = read_csv(folder / "wave_000000.csv");
    REQUIRE(rows.size() == kRows + 1);
    CHECK(rows[0] == std::vector<std::string>{"id", "velocity_x [m/s]", "velocity_y [m/s]", "density [kg/m^3]"});
    for (std::size_t k = 0; k < kRows; ++k) {
        REQUIRE(rows[k + 1].size() == 4);
        CHECK(std::stoul(rows[k + 1][0]) == ids[k]);
        // strtof and strtod: the standard streams refuse denormal numbers.
        CHECK(std::strtof(rows[k + 1][1].c_str(), nullptr) == velocities[2 * k]);
        CHECK(std::strtof(rows[k + 1][2].c_str(), nullptr) == velocities[2 * k + 1]);
        CHECK(std::strtod(rows[k + 1][3].c_str(), nullptr) == densities[k]);
    }
}

TEST_CASE("CsvWriter.SinglePrecisionIsNotDressedUpAsDouble") {
    TemporaryFolder folder;
    auto writer = csv_writer(folder);
    SyntheticFrame frame(3, 1, 0);
    frame.column<float>(Field::density, "<f4", 1, {0.1f});
    REQUIRE(writer->write(frame.view(), {}).ok());
    CHECK(read_text(folder / "wave_000000.csv") == "density [kg/m^3]\n0.1\n");
}

TEST_CASE("CsvWriter.IndexTellsTheTimeOfEachFile") {
    TemporaryFolder folder;
    auto writer = csv_writer(folder);
    for (const double time : {0.0, 0.1}) {
        SyntheticFrame frame(3, 1, time, static_cast<std::uint64_t>(100 * time));
        frame.column<float>(Field::density, "<f4", 1, {1});
        REQUIRE(writer->write(frame.view(), {}).ok());
    }
    REQUIRE(writer->finish().ok());
    const auto rows = read_csv(folder / "wave_frames.csv");
    REQUIRE(rows.size() == 3);
    CHECK(rows[0] == std::vector<std::string>{"step", "time [s]", "particles", "file"});
    CHECK(rows[2] == std::vector<std::string>{"10", "0.1", "1", "wave_000001.csv"});
    for (std::size_t k = 1; k < rows.size(); ++k) CHECK(std::filesystem::exists(folder / rows[k][3]));
}
