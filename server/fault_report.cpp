#include "server/fault_report.h"

#include "server/solver/faults.h"

namespace headrace::server {

proto::FaultReport report_of(const solver::Fault& fault, const Place& now) {
    return {solver::name_of(fault.kind), fault.particle, fault.x, fault.v, now.step, now.time, fault.remedy};
}

proto::FaultReport report_of_internal_error(const std::string& what, const Place& now) {
    return {
        "internal_error", 0, {}, {}, now.step, now.time, what + "; sim.reset or scene.load, and report this as a bug"};
}

std::string message_of(const proto::FaultReport& report) {
    std::string message = report.criterion;
    if (report.criterion != "internal_error") message += ": particle " + std::to_string(report.particle);
    return message + " in step " + std::to_string(report.step) + "; " + report.remedy;
}

}  // namespace headrace::server
