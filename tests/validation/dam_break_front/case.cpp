#include "tests/validation/support/case.h"

#include <algorithm>
#include <cmath>

#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;         // [m/s^2]
constexpr double kWidth = 0.05715;  // [m] of the column
constexpr double kEnd = 3.0;        // T = t sqrt(2 g / a)
constexpr double kFrom = 0.8;

// Edge of the outermost particle.
class Front : public RegularObserver {
  public:
    Front() : RegularObserver(kEnd / rate(), 0.01 / rate()) {}

    void sample(const scene::Run& run) override {
        const auto& x = run.particles().x[0];
        front_.add(run.time() * rate(), (*std::max_element(x.begin(), x.end()) + run.scene().spacing / 2) / kWidth);
    }

    std::vector<Measured> measured() const override {
        const Table table = load_reference("dam_break_2d_front/martin_moyce1952_n2sq2_a2.25in_front.csv");
        if (table.size() < 2) return {};
        double square = 0.0, mean = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < table[0].size(); ++i) {
            const double T = table[0][i];
            if (T < kFrom || T > kEnd) continue;
            square += std::pow(interpolate_linear(front_.t, front_.value, T) - table[1][i], 2);
            mean += table[1][i];
            ++count;
        }
        return {{"front_nrmse", std::sqrt(square / count) / (mean / count)}};
    }

  private:
    static double rate() { return std::sqrt(2 * kG / kWidth); }  // [1/s]

    Series front_;  // Z = x/a over T
};

}  // namespace

std::vector<Case> dam_break_front_cases() {
    Case one;
    one.name = one.folder = "dam_break_front";
    one.length_name = "a";
    one.length = kWidth;
    one.resolution = 40;
    one.ladder = {14, 20, 28, 40, 56};
    one.main_metric = "front_nrmse";
    one.observe = [](const scene::Run&, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Front>();
    };
    return {one};
}

}  // namespace headrace::validation
