// What the status and the events say of a fault.
#pragma once

#include <string>

#include "proto/messages.h"
#include "server/job.h"
#include "server/solver/step_report.h"

namespace headrace::server {

proto::FaultReport report_of(const solver::Fault& fault, const Place& now);

// An exception in our own code while the run stepped.
proto::FaultReport report_of_internal_error(const std::string& what, const Place& now);

// For a person: criterion, particle, step, remedy.
std::string message_of(const proto::FaultReport& report);

}  // namespace headrace::server
