// A validation case: one description for the tests and for `headrace_bench accuracy`. Its scene is the scene.json of
// its folder, with the spacing and the numerical parameters asked for.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/scene/run.h"

namespace headrace::validation {

// What varies between two runs of a case.
struct Settings {
    std::optional<double> resolution;            // spacings per length of the case; absent: the target's
    std::optional<double> support_over_spacing;  // absent: the model's default
    double sound_speed_factor{1.0};              // times the sound speed the model would choose
    std::string model{"wcsph"};
    proto::Parameters parameters;  // over those of the scene
    bool brief{false};             // only the metrics that need the shortest time
};

// An error metric, 0 for a perfect run. Its targets stand in the case.
struct Measured {
    std::string metric;
    double value{};
};

struct Target {
    std::string metric;
    double must{};
    double aim{};
};

// Follows a run and takes the measure of it.
class Observer {
  public:
    virtual ~Observer() = default;
    virtual double end_time() const = 0;                 // [s]
    virtual double next_sample(double t) const = 0;      // [s] the first after t; the end is sampled in any case
    virtual void sample(const scene::Run& run) = 0;      // the first time before the first step
    virtual bool is_finished() const { return false; }   // before the end time
    virtual std::vector<Measured> measured() const = 0;  // after the last sample
};

// Samples at equal intervals.
class RegularObserver : public Observer {
  public:
    RegularObserver(double end, double interval) : end_(end), interval_(interval) {}
    double end_time() const override { return end_; }
    double next_sample(double t) const override;

  private:
    double end_, interval_;  // [s]
};

struct Case {
    std::string name;
    std::string folder;            // below tests/validation
    std::string length_name;       // "R0": resolution is R0/dp
    double length{};               // [m]
    double resolution{};           // of the targets
    std::vector<double> ladder;    // resolutions of the diagrams, ascending; empty: not on them
    std::vector<Target> targets;   // at `resolution`
    std::string main_metric;       // of the diagrams
    bool follows_energies{false};  // its observer asks the model for its energy budget
    bool is_long{false};           // its full run takes many minutes
    std::function<void(proto::SceneDesc&, double resolution)> adapt;  // beyond the spacing; may be empty
    std::function<std::unique_ptr<Observer>(const scene::Run&, const Settings&)> observe;
};

// Each folder's; some hold variants of one scene.
std::vector<Case> oscillating_drop_cases();
std::vector<Case> elliptical_drop_cases();
std::vector<Case> taylor_green_cases();
std::vector<Case> channel_cases();
std::vector<Case> cavity_cases();
std::vector<Case> hydrostatic_cases();
std::vector<Case> standing_wave_cases();
std::vector<Case> acoustic_wave_cases();
std::vector<Case> capillary_drop_cases();
std::vector<Case> dam_break_front_cases();
std::vector<Case> dam_break_pressure_cases();
std::vector<Case> lobovsky_cases();
std::vector<Case> kleefsman_cases();
std::vector<Case> free_fall_cases();
std::vector<Case> balance_cases();

// All of them, in this order.
const std::vector<Case>& cases();
const Case* find_case(const std::string& name);

// The scene of the case as its folder holds it, then with the settings. Errors: those of the scene document.
proto::Result<proto::SceneDesc> load_scene(const Case& one);
proto::Result<proto::SceneDesc> make_scene(const Case& one, const Settings& settings);

struct Outcome {
    std::vector<Measured> metrics;  // "leaked" among them: particles lost or found behind a wall
    std::string fault;              // empty: none; else the metrics are worthless
    double spacing{};               // [m]
    double support{};               // [m]
    double sound_speed{};           // [m/s]; 0: unknown
    std::size_t particles{};
    std::size_t steps{};
    double simulated{};  // [s]
    double wall{};       // [s] in the steps alone; one thread: its processor time, undisturbed by other programs

    double value(const std::string& metric) const;  // NaN: not measured
};

// Errors: the model refuses the scene or a parameter.
proto::Result<Outcome> run_case(const Case& one, const Settings& settings);

}  // namespace headrace::validation
