// What the client says to a person: numbers, places in a run, errors.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "proto/messages.h"

namespace headrace::client {

std::string with_thousands(std::int64_t number);                  // 1,234,567
std::string number(double value);                                 // six significant digits at most, no trailing zeros
std::string duration_text(double seconds);                        // "0:07", "12:03", "1:02:03"
std::string at_moment(std::uint64_t step, double time);           // "step 1,234, t 12.34 s"
std::string plural(std::int64_t count, const std::string& noun);  // "1 frame", "2,000 frames"

// "1.5 J", in 2 dimensions "1.5 J/m": what the fluid has per metre of depth. Where a server does not tell them: both.
std::string energy_text(double energy, std::optional<int> dimensions);

std::string recording_summary(std::uint64_t frames, std::uint64_t gaps);  // "301 frames, 0 gaps"

std::string parameter_text(const proto::ParameterValue& value);
std::string object_text(const proto::ObjectDesc& object);  // "panel: obstacle, box 0.1,0,0 to 0.12,1,1"
std::string event_line(const proto::Event& event);
std::string state_text(proto::SimState state);
std::string job_state_text(proto::JobState state);

// One line: `error NAME (PATH): MESSAGE; HINT`. A hint of the form "did you mean ..." says it all: then the message is
// left out.
std::string error_line(const proto::Error& error);

}  // namespace headrace::client
