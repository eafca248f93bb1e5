#include "tests/validation/support/case.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/validation/support/gauges.h"
#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;      // [m/s^2]
constexpr double kRho = 1000.0;  // [kg/m^3]
constexpr double kH = 0.6;       // [m] of the column

// All times as t* = t sqrt(g/H).
constexpr double kFrom = 2.36, kEnd = 6.0;  // the reference begins with the impact; at 6.2 the breaker traps air
constexpr double kPlateauFrom = 3.0, kPlateauEnd = 5.0;
constexpr double kInterval = 0.01;  // the peers' samples

struct Place {
    const char* name;
    double top;  // [m]; the sensor reaches 8.4 mm down from here
};
constexpr std::array kSensors{Place{"P1", 0.006}, Place{"P2", 0.03}, Place{"P3", 0.06}, Place{"P4", 0.1642}};
constexpr double kWall = 5.366 * kH;  // [m]
constexpr double kSensorSize = 0.0084;
constexpr int kSensorPoints = 10;
constexpr double kWideReach = 8.0;  // [spacings]

double wendland_c2(double q) {
    return q < 1.0 ? std::pow(1 - q, 4) * (1 + 4 * q) : 0.0;
}

// As the peers read it: the weighted mean of the fluid's pressures, negative ones as 0, over a reach of 8 spacings
// around ten points half a spacing off the wall. [Pa]
double read_widely(const scene::Run& run, double top) {
    const solver::Particles& particles = run.particles();
    const double dp = run.scene().spacing, reach = kWideReach * dp, x = kWall - dp / 2;
    std::array<double, kSensorPoints> sum{}, weight{};
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (x - particles.x[0][i] > reach || particles.x[1][i] - top > reach) continue;
        for (std::size_t k = 0; k < kSensorPoints; ++k) {
            const double y = top - kSensorSize * static_cast<double>(k) / (kSensorPoints - 1);
            const double r = std::hypot(particles.x[0][i] - x, particles.x[1][i] - y);
            const double w = wendland_c2(r / reach) / particles.rho[i];
            sum[k] += w * std::max(0.0, particles.p[i]);
            weight[k] += w;
        }
    }
    double mean = 0.0;
    for (std::size_t k = 0; k < kSensorPoints; ++k)
        if (weight[k] > 0.0) mean += sum[k] / weight[k] / kSensorPoints;
    return mean;
}

class WallPressure : public RegularObserver {
  public:
    explicit WallPressure(const scene::Run& run) : RegularObserver(kEnd / rate(), kInterval / rate()) {
        for (const Place& place : kSensors) sensors_.push_back({place, Gauge(run, place.name), {}, {}});
    }

    void sample(const scene::Run& run) override {
        const double t = run.time() * rate(), unit = kRho * kG * kH;
        for (Sensor& sensor : sensors_) {
            sensor.pressure.add(t, sensor.gauge.read(run) / unit);
            sensor.wide.add(t, read_widely(run, sensor.place.top) / unit);
        }
    }

    std::vector<Measured> measured() const override {
        std::vector<Measured> close{{"nrmse", 0.0}}, wide{{"nrmse_wide", 0.0}}, plateaus;
        double arrival = 0.0;
        for (const Sensor& sensor : sensors_) {
            const std::string name = sensor.place.name;
            const Table table = load_reference("dam_break_2d_pressure/decourcy2024_sim_" + name + ".csv");
            if (table.size() < 2) return {};
            const Series reference{table[0], table[1]};
            if (plateaus.empty()) arrival = std::abs(arrival_of(sensor.pressure) - arrival_of(reference));
            close.push_back({"nrmse_" + name, deviation(sensor.pressure, reference)});
            wide.push_back({"nrmse_wide_" + name, deviation(sensor.wide, reference)});
            plateaus.push_back({"plateau_" + name, std::abs(plateau(sensor.pressure) / plateau(reference) - 1)});
            close.front().value += close.back().value / kSensors.size();
            wide.front().value += wide.back().value / kSensors.size();
        }
        std::vector<Measured> metrics = std::move(close);
        metrics.insert(metrics.end(), wide.begin(), wide.end());
        metrics.push_back({"arrival", arrival});
        metrics.insert(metrics.end(), plateaus.begin(), plateaus.end());
        return metrics;
    }

  private:
    struct Sensor {
        Place place;
        Gauge gauge;
        Series pressure, wide;  // p* over t*
    };

    static double rate() { return std::sqrt(kG / kH); }  // [1/s]

    // Root mean square of the difference at the run's samples, over the reference's largest.
    static double deviation(const Series& pressure, const Series& reference) {
        double square = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < pressure.t.size(); ++i) {
            if (pressure.t[i] < kFrom) continue;
            square += std::pow(pressure.value[i] - interpolate_linear(reference.t, reference.value, pressure.t[i]), 2);
            ++count;
        }
        const double largest = *std::max_element(reference.value.begin(), reference.value.end());
        return std::sqrt(square / count) / largest;
    }

    static double arrival_of(const Series& pressure) {
        for (std::size_t i = 0; i < pressure.t.size(); ++i)
            if (pressure.value[i] > 0.1) return pressure.t[i];
        return kEnd;
    }

    static double plateau(const Series& pressure) {
        return pressure.integral(kPlateauFrom, kPlateauEnd) / (kPlateauEnd - kPlateauFrom);
    }

    std::vector<Sensor> sensors_;
};

}  // namespace

std::vector<Case> dam_break_pressure_cases() {
    Case one;
    one.name = one.folder = "dam_break_pressure";
    one.length_name = "H";
    one.length = kH;
    one.resolution = 80;
    one.ladder = {20, 28, 40, 56, 80};
    one.main_metric = "nrmse_wide";
    one.observe = [](const scene::Run& run, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<WallPressure>(run);
    };
    return {one};
}

}  // namespace headrace::validation
