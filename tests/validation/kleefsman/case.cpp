#include "tests/validation/support/case.h"

#include <array>
#include <cmath>

#include "tests/validation/support/gauges.h"
#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

namespace headrace::validation {

namespace {

constexpr double kDepth = 0.55;  // [m] of the reservoir
constexpr double kEnd = 6.0;     // [s]
constexpr std::array kNames{"H1", "H2", "H3", "H4"};

class Levels : public RegularObserver {
  public:
    explicit Levels(const scene::Run& run) : RegularObserver(kEnd, 0.01) {
        for (const char* name : kNames) gauges_.emplace_back(run, name);
    }

    void sample(const scene::Run& run) override {
        for (std::size_t k = 0; k < gauges_.size(); ++k) levels_[k].add(run.time(), gauges_[k].read(run));
    }

    std::vector<Measured> measured() const override {
        const Table table = load_reference("dam_break_3d_kleefsman/water_levels.csv");
        if (table.size() < 5) return {};
        std::vector<Measured> metrics;
        for (std::size_t k = 0; k < kNames.size(); ++k) {
            double square = 0.0;
            int count = 0;
            for (std::size_t i = 0; i < table[0].size() && table[0][i] <= kEnd; ++i, ++count)
                square +=
                    std::pow(interpolate_linear(levels_[k].t, levels_[k].value, table[0][i]) - table[k + 1][i], 2);
            metrics.push_back({std::string("level_") + kNames[k], std::sqrt(square / count) / kDepth});
        }
        return metrics;
    }

  private:
    std::vector<Gauge> gauges_;
    std::array<Series, kNames.size()> levels_;
};

}  // namespace

std::vector<Case> kleefsman_cases() {
    Case one;
    one.name = one.folder = "kleefsman";
    one.length_name = "H";
    one.length = kDepth;
    one.resolution = 20;
    one.main_metric = "level_H2";
    one.is_long = true;
    one.observe = [](const scene::Run& run, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Levels>(run);
    };
    return {one};
}

}  // namespace headrace::validation
