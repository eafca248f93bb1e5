#include "client/text.h"

#include <cmath>
#include <cstdio>

namespace headrace::client {

namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

std::string vector_text(const proto::Vec3& vector) {
    return number(vector[0]) + "," + number(vector[1]) + "," + number(vector[2]);
}

}  // namespace

std::string with_thousands(std::int64_t number) {
    std::string digits = std::to_string(number);
    const std::ptrdiff_t first = number < 0 ? 1 : 0;
    for (std::ptrdiff_t at = std::ssize(digits) - 3; at > first; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value == 0 ? 0.0 : value);  // no "-0"
    return text;
}

std::string duration_text(double seconds) {
    if (!(seconds >= 0) || seconds > 1e7) return "?";
    const long long whole = std::llround(seconds);
    char text[32];
    if (whole < 3600)
        std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
    else
        std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
    return text;
}

std::string at_moment(std::uint64_t step, double time) {
    return "step " + with_thousands(static_cast<std::int64_t>(step)) + ", t " + number(time) + " s";
}

std::string plural(std::int64_t count, const std::string& noun) {
    return with_thousands(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string energy_text(double energy, std::optional<int> dimensions) {
    return number(energy) + (!dimensions ? " J (2D: J/m)" : *dimensions == 2 ? " J/m" : " J");
}

std::string recording_summary(std::uint64_t frames, std::uint64_t gaps) {
    return plural(static_cast<std::int64_t>(frames), "frame") + ", " + plural(static_cast<std::int64_t>(gaps), "gap");
}

std::string parameter_text(const proto::ParameterValue& value) {
    return std::visit(Overloaded{[](double real) { return number(real); },
                                 [](bool flag) { return std::string(flag ? "true" : "false"); },
                                 [](const std::string& word) { return word; },
                                 [](const proto::Vec3& vector) { return vector_text(vector); }},
                      value);
}

std::string object_text(const proto::ObjectDesc& object) {
    const std::string shape = std::visit(
        Overloaded{
            [](const proto::BoxDesc& box) { return "box " + vector_text(box.min) + " to " + vector_text(box.max); },
            [](const proto::SphereDesc& sphere) {
                return "sphere at " + vector_text(sphere.center) + ", radius " + number(sphere.radius);
            },
            [](const proto::CylinderDesc& cylinder) {
                return "cylinder " + vector_text(cylinder.from) + " to " + vector_text(cylinder.to) + ", radius " +
                       number(cylinder.radius);
            },
            [](const proto::PlaneDesc& plane) {
                return "plane at " + vector_text(plane.point) + ", fluid towards " + vector_text(plane.normal);
            },
            [](const proto::DifferenceDesc&) { return std::string("a difference of shapes"); },
            [](const proto::IntersectionDesc&) { return std::string("an intersection of shapes"); }},
        object.shape);
    return object.name + ": " + (object.role == proto::ObjectRole::container ? "container" : "obstacle") + ", " +
           shape + (object.motion ? ", moves" : "");
}

std::string event_line(const proto::Event& event) {
    return "#" + std::to_string(event.seq) + "  " + at_moment(event.step, event.time) + "  " + event.type +
           (event.message.empty() ? "" : "  " + event.message);
}

std::string state_text(proto::SimState state) {
    switch (state) {
        case proto::SimState::empty:
            return "empty";
        case proto::SimState::loading:
            return "loading";
        case proto::SimState::idle:
            return "idle";
        case proto::SimState::running:
            return "running";
        case proto::SimState::faulted:
            return "faulted";
    }
    return "?";
}

std::string job_state_text(proto::JobState state) {
    switch (state) {
        case proto::JobState::running:
            return "running";
        case proto::JobState::paused:
            return "paused";
        case proto::JobState::finished:
            return "finished";
        case proto::JobState::cancelled:
            return "cancelled";
        case proto::JobState::timed_out:
            return "timed out";
        case proto::JobState::faulted:
            return "faulted";
    }
    return "?";
}

std::string error_line(const proto::Error& error) {
    std::string line = "error " + std::string(error.name());
    if (!error.path.empty()) line += " (" + error.path + ")";
    const bool hint_says_it_all = error.hint.starts_with("did you mean") || error.message.empty();
    if (hint_says_it_all) return line + ": " + error.hint;
    // The path of a file stands in front of some messages: once is enough.
    const bool names_path = !error.path.empty() && error.message.starts_with(error.path + ": ");
    line += names_path ? error.message.substr(error.path.size()) : ": " + error.message;
    if (!error.hint.empty()) line += "; " + error.hint;
    return line;
}

}  // namespace headrace::client
