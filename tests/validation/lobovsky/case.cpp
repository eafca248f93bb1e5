#include "tests/validation/support/case.h"

#include <cmath>
#include <map>

#include "tests/validation/support/gauges.h"
#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;     // [m/s^2]
constexpr double kRho = 997.0;  // [kg/m^3]
constexpr double kH = 0.3;      // [m] of the column
constexpr double kEnd = 5.0;    // t* = t sqrt(g/H)
constexpr double kBandFrom = 2.4, kImpulseFrom = 2.3;
constexpr double kInterval = 0.002;  // of t*: the experiment's sampling is 2.9e-4, its peak is 0.1 wide

// Level gauge -> columns of the runs in the table of levels.
const std::map<std::string, std::vector<std::size_t>> kLevels{
    {"H1", {1}}, {"H2", {2, 3}}, {"H3", {4, 5}}, {"H4", {6, 7}}};

class Impact : public RegularObserver {
  public:
    explicit Impact(const scene::Run& run) : RegularObserver(kEnd / rate(), kInterval / rate()), gauge_(run, "P2") {
        for (const auto& [name, columns] : kLevels) levels_.push_back({Gauge(run, name), {}});
    }

    void sample(const scene::Run& run) override {
        const double t = run.time() * rate();
        pressure_.add(t, gauge_.read(run) / (kRho * kG * kH));
        for (auto& [gauge, series] : levels_) series.add(t, gauge.read(run) / kH);
    }

    std::vector<Measured> measured() const override {
        const Table band = load_reference("dam_break_lobovsky2014/H300_sensor2_percentiles_100runs.csv");
        const Table levels = load_reference("dam_break_lobovsky2014/H300_water_levels.csv");
        if (band.size() < 4 || levels.size() < 8) return {};
        Series median{band[0], band[2]};
        const double impulse = pressure_.integral(kImpulseFrom, kEnd) / median.integral(kImpulseFrom, kEnd);
        std::vector<Measured> metrics{{"p2_outside_band", 1 - share_inside(band)},
                                      {"p2_impulse", std::abs(impulse - 1)},
                                      {"p2_onset", onset(pressure_) - onset(median)}};
        std::size_t k = 0;
        for (const auto& [name, columns] : kLevels)
            metrics.push_back({"level_" + name, level_error(levels_[k++].series, levels, columns)});
        return metrics;
    }

  private:
    static double rate() { return std::sqrt(kG / kH); }  // [1/s]

    // Of the time in [2.4, 5], weighted by the sampling interval.
    double share_inside(const Table& band) const {
        double inside = 0.0, whole = 0.0;
        for (std::size_t i = 1; i < pressure_.t.size(); ++i) {
            const double t = pressure_.t[i], dt = t - pressure_.t[i - 1], p = pressure_.value[i];
            if (t < kBandFrom || t > kEnd) continue;
            whole += dt;
            if (p >= interpolate_linear(band[0], band[1], t) && p <= interpolate_linear(band[0], band[3], t))
                inside += dt;
        }
        return inside / whole;
    }

    static double onset(const Series& series) {
        for (std::size_t i = 0; i < series.t.size(); ++i)
            if (series.t[i] > 2.0 && series.value[i] > 0.1) return series.t[i];
        return kEnd;
    }

    // rms(h - h_experiment)/H over 0..5, against the mean of the runs.
    static double level_error(const Series& level, const Table& table, const std::vector<std::size_t>& columns) {
        double square = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < table[0].size() && table[0][i] <= kEnd; ++i) {
            double measured = 0.0;
            for (const std::size_t column : columns) measured += table[column][i] / static_cast<double>(columns.size());
            if (std::isnan(measured)) continue;
            square += std::pow(interpolate_linear(level.t, level.value, table[0][i]) - measured, 2);
            ++count;
        }
        return std::sqrt(square / count);
    }

    struct Level {
        Gauge gauge;
        Series series;
    };
    Gauge gauge_;
    std::vector<Level> levels_;
    Series pressure_;
};

Case make(const std::string& name, double spacing) {
    Case one;
    one.name = one.folder = name;
    one.length_name = "H";
    one.length = kH;
    one.resolution = kH / spacing;
    one.targets = {{"p2_outside_band", 0.25, 0.1}, {"p2_impulse", 0.1, 0.05}};
    one.main_metric = "p2_outside_band";
    one.is_long = true;
    one.observe = [](const scene::Run& run, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Impact>(run);
    };
    return one;
}

}  // namespace

std::vector<Case> lobovsky_cases() {
    return {make("lobovsky", 0.003), make("lobovsky_3d", 0.005)};
}

}  // namespace headrace::validation
