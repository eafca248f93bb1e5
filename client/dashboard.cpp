#include "client/dashboard.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "client/text.h"

namespace headrace::client {

namespace {

constexpr std::size_t kSamples = 240;  // a curve's memory: wider than a screen
constexpr std::size_t kWarnings = 6;
constexpr std::size_t kNameWidth = 16, kValueWidth = 30;
constexpr const char* kBold = "1";
constexpr const char* kYellow = "33";
constexpr const char* kRed = "31";

// Events that tell of something wrong.
constexpr std::array<std::string_view, 10> kWarningTypes{
    "server.problem", "server.stopping",    "scene.load_failed", "sim.not_at_rest", "sim.faulted",
    "probe.failed",   "scene_event.failed", "stream.stalled",    "stream.failed",   "record.failed"};

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string percent(double ratio) {
    return number(100.0 * ratio) + " %";
}

}  // namespace

void Dashboard::Curve::add(double value) {
    values.push_back(value);
    if (values.size() > kSamples) values.pop_front();
}

void Dashboard::add(const proto::SimStatusReply& status, const Extras& extras) {
    if (status_ && (status.scene != status_->scene || status.step < status_->step))
        speed_ = kinetic_ = energy_ = balance_ = mean_error_ = max_error_ = {};  // another run
    status_ = status;
    extras_ = extras;
    speed_.add(status.steps_per_second);
    if (extras.energy_balance) balance_.add(*extras.energy_balance);
    if (!status.diagnostics) return;
    const proto::Diagnostics& sums = *status.diagnostics;
    kinetic_.add(sums.kinetic_energy);
    energy_.add(sums.kinetic_energy + sums.potential_energy);
    if (!extras.rest_density) return;
    mean_error_.add(sums.mean_density / *extras.rest_density - 1.0);
    max_error_.add(sums.max_density / *extras.rest_density - 1.0);
}

void Dashboard::add(const proto::Event& event) {
    if (std::find(kWarningTypes.begin(), kWarningTypes.end(), event.type) == kWarningTypes.end()) return;
    warnings_.push_back(event_line(event));
    if (warnings_.size() > kWarnings) warnings_.pop_front();
}

// Whether the model can tell where its energy goes, and nobody asks it to: a stage of its plan that is skipped.
bool Dashboard::may_follow_energies() const {
    return std::any_of(status_->plan.begin(), status_->plan.end(),
                       [](const proto::PlanStage& stage) { return stage.stage == "energies" && !stage.active; });
}

std::string Dashboard::colored(const std::string& text, const char* code) const {
    return style_.colors ? "\x1b[" + std::string(code) + "m" + text + "\x1b[0m" : text;
}

std::string Dashboard::row(const std::string& name, const std::string& value, const Curve* curve, int columns) const {
    const std::string text = padded(name, kNameWidth) + padded(value, kValueWidth);
    const auto room = static_cast<std::size_t>(std::max(columns, 0));
    if (curve == nullptr || room <= text.size()) return text;
    return text + sparkline(curve->values, room - text.size(), style_.glyphs);
}

std::vector<std::string> Dashboard::run_lines(int columns, bool with_keys) const {
    const proto::SimStatusReply& s = *status_;
    std::vector<std::string> lines{
        row("time", number(s.time) + " s", nullptr, columns),
        row("step", with_thousands(static_cast<std::int64_t>(s.step)), nullptr, columns),
        row("steps/s", number(s.steps_per_second), &speed_, columns),
        row("real time", number(s.real_time_factor) + " simulated s per s", nullptr, columns),
        row("time step", number(s.time_step) + " s, limit: " + s.time_step_limit, nullptr, columns),
        row("particles", with_thousands(s.particles), nullptr, columns)};
    if (!s.diagnostics) return lines;
    const proto::Diagnostics& sums = *s.diagnostics;
    lines.push_back(row("max speed", number(sums.max_speed) + " m/s", nullptr, columns));
    lines.push_back(row("kinetic energy", energy_text(sums.kinetic_energy, s.dimensions), &kinetic_, columns));
    lines.push_back(
        row("energy", energy_text(sums.kinetic_energy + sums.potential_energy, s.dimensions), &energy_, columns));
    if (extras_.energy_balance)
        lines.push_back(row("energy error", energy_text(*extras_.energy_balance, s.dimensions), &balance_, columns));
    else if (may_follow_energies())
        lines.push_back(row("energy error",
                            with_keys ? "not followed, as that makes steps longer: e adds a probe that does"
                                      : "not followed: a probe of the kind energies does (headrace help probes)",
                            nullptr, columns));
    if (extras_.rest_density) {
        const double rest = *extras_.rest_density;
        lines.push_back(row("density error", "mean " + percent(sums.mean_density / rest - 1.0), &mean_error_, columns));
        lines.push_back(row("", "largest " + percent(sums.max_density / rest - 1.0), &max_error_, columns));
    }
    return lines;
}

std::vector<std::string> Dashboard::reader_lines() const {
    std::vector<std::string> lines;
    for (const proto::StreamState& reader : status_->readers) {
        std::string text =
            padded(reader.stream, kNameWidth) + plural(static_cast<std::int64_t>(reader.frames), "frame");
        if (reader.behind)
            text +=
                ", " + std::to_string(*reader.behind) + " of " + std::to_string(reader.window.value_or(0)) + " behind";
        else if (!reader.subscribed)
            text += ", nobody listens";
        const bool is_full = reader.behind && reader.window && *reader.behind >= *reader.window;
        lines.push_back(is_full ? colored(text + ", full", kYellow) : text);
    }
    if (status_->recordings > 0)
        lines.push_back(padded("recordings", kNameWidth) + std::to_string(status_->recordings));
    return lines;
}

std::vector<std::string> Dashboard::warning_lines() const {
    std::vector<std::string> lines;
    if (status_->fault)
        lines.push_back(colored("faulted: " + status_->fault->criterion + ", particle " +
                                    with_thousands(status_->fault->particle) + "; " + status_->fault->remedy,
                                kRed));
    if (status_->stalled) lines.push_back(colored("the run waits for a reader", kYellow));
    for (const std::string& warning : warnings_) lines.push_back(colored(warning, kYellow));
    return lines;
}

std::vector<std::string> Dashboard::lines(int rows, int columns, bool with_keys) const {
    if (!status_) return {"headrace watch " + endpoint_};
    std::string state = state_text(status_->state);
    if (status_->job && status_->job->state == proto::JobState::paused) state = "paused";
    if (status_->state == proto::SimState::loading) state += " " + percent(status_->load_progress);
    std::vector<std::string> lines{
        colored(status_->scene.value_or("no scene") + (status_->model ? " (" + *status_->model + ")" : ""), kBold) +
        "  " + state + "  " + endpoint_};

    std::vector<std::string> keys;
    if (!choices_.empty()) {
        std::string question = "remove which?";
        for (std::size_t k = 0; k < choices_.size() && k < 9; ++k)
            question += "  " + std::to_string(k + 1) + " " + choices_[k];
        keys.push_back(colored(question + "  Esc none", kBold));
    } else if (with_keys) {
        keys.push_back("p pause  r resume  s step  d remove an object  e follow energies  q quit");
    }
    if (with_keys) keys.insert(keys.begin(), note_);

    // From the most important part to the least; what has no room is left out.
    std::size_t room = static_cast<std::size_t>(std::max(rows, 1)) - std::min<std::size_t>(rows, 1 + keys.size());
    const auto take = [&](const std::vector<std::string>& part) {
        for (const std::string& line : part) {
            if (room == 0) return;
            lines.push_back(line);
            --room;
        }
    };
    const std::vector<std::string> warnings = warning_lines();
    if (status_->scene) take(run_lines(columns, with_keys));
    if (!warnings.empty()) take({""}), take(warnings);
    const std::vector<std::string> readers = reader_lines();
    if (!readers.empty()) take({""}), take(readers);
    lines.insert(lines.end(), keys.begin(), keys.end());
    return lines;
}

}  // namespace headrace::client
