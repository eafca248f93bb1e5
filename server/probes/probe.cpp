#include "server/probes/probe.h"

#include <cmath>
#include <type_traits>

#include "server/probes/vectors.h"

namespace headrace::probes {

namespace {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Status;

Error invalid(const std::string& path, std::string message, std::string hint) {
    return {ErrorCode::invalid_params, std::move(message), path, std::move(hint)};
}

Status check_direction(const Vec3& direction, const std::string& path) {
    const double l = length(direction);
    if (std::isfinite(l) && l > 0.0) return Done{};
    return invalid(path, "must be a direction, not zero", "give a vector of any length");
}

Status check_line(const Vec3& from, const Vec3& to, const std::string& path) {
    const double l = length(minus(to, from));
    if (std::isfinite(l) && l > 0.0) return Done{};
    return invalid(path + ".to", "must differ from `from`", "give the two ends of the line [m]");
}

Status check(const proto::PressureProbe& probe, int, const std::string& path) {
    if (!(probe.radius > 0.0)) return Done{};
    return check_direction(probe.normal, path + ".normal");
}
Status check(const proto::LevelProbe& probe, int, const std::string& path) {
    return check_line(probe.from, probe.to, path);
}
Status check(const proto::ProfileProbe& probe, int dimensions, const std::string& path) {
    if (probe.points < 2) return invalid(path + ".points", "must be at least 2", "both ends are points");
    if (dimensions == 2 && probe.field == proto::ProfileField::velocity_z)
        return invalid(path + ".field", "velocity_z is for 3 dimensions only", "choose velocity_x or velocity_y");
    return check_line(probe.from, probe.to, path);
}
Status check(const proto::FrontProbe& probe, int, const std::string& path) {
    return check_direction(probe.direction, path + ".direction");
}
Status check(const proto::DischargeProbe& probe, int, const std::string& path) {
    return check_direction(probe.normal, path + ".normal");
}
template <class Other>
Status check(const Other&, int, const std::string&) {
    return Done{};
}

// Tag of the kind in the document, in the order of proto::ProbeKind.
constexpr const char* kTags[]{"pressure",  "velocity", "level",    "profile", "front",
                              "discharge", "force",    "energies", "density"};
static_assert(std::size(kTags) == std::variant_size_v<proto::ProbeKind>);

}  // namespace

Status check_probe(const proto::ProbeDesc& desc, int dimensions, const std::string& path) {
    const std::string below = path + ".kind." + kTags[desc.kind.index()];
    return std::visit([&](const auto& kind) { return check(kind, dimensions, below); }, desc.kind);
}

std::unique_ptr<Probe> make_probe(const proto::ProbeDesc& desc, int dimensions) {
    return std::visit([&](const auto& kind) { return make_probe(kind, dimensions); }, desc.kind);
}

}  // namespace headrace::probes
