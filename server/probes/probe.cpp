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

// What the checks need to know of the scene.
struct Scene {
    int dimensions{3};
    Vec3 center{};      // [m] of the domain
    double diagonal{};  // [m]
};

// Farther off, nothing is measured but round-off.
constexpr double kFarthest = 1e3;  // [diagonals of the domain]

Scene scene_of(const RunView& run) {
    Scene scene{run.particles.dimensions, {}, 0.0};
    Vec3 extent{};
    for (int k = 0; k < scene.dimensions; ++k) {
        const double min = run.surroundings.domain.min[k], max = run.surroundings.domain.max[k];
        scene.center[k] = 0.5 * min + 0.5 * max;
        extent[k] = max - min;
    }
    scene.diagonal = length(extent);
    return scene;
}

Status check_flat(const Vec3& vector, const Scene& scene, const std::string& path) {
    if (scene.dimensions == 3 || vector[2] == 0.0) return Done{};
    return invalid(path + "[2]", "must be 0 in a scene of 2 dimensions", "leave the third number out");
}

Status check_place(const Vec3& place, const Scene& scene, const std::string& path) {
    if (Status flat = check_flat(place, scene, path); !flat) return flat;
    if (length(minus(place, scene.center)) <= kFarthest * scene.diagonal) return Done{};
    return invalid(path, "is more than a thousand times the domain's size away from it",
                   "give a place in or near scene.domain [m]");
}

Status check_direction(const Vec3& direction, const Scene& scene, const std::string& path) {
    if (Status flat = check_flat(direction, scene, path); !flat) return flat;
    const double l = length(direction);
    if (std::isfinite(l) && l > 0.0) return Done{};
    return invalid(path, "must be a direction, not zero", "give a vector of any length");
}

Status check_line(const Vec3& from, const Vec3& to, const Scene& scene, const std::string& path) {
    if (Status place = check_place(from, scene, path + ".from"); !place) return place;
    if (Status place = check_place(to, scene, path + ".to"); !place) return place;
    const double l = length(minus(to, from));
    if (std::isfinite(l) && l > 0.0) return Done{};
    return invalid(path + ".to", "must differ from `from`", "give the two ends of the line [m]");
}

Status check(const proto::PressureProbe& probe, const Scene& scene, const std::string& path) {
    if (Status place = check_place(probe.point, scene, path + ".point"); !place) return place;
    if (!(probe.radius > 0.0)) return Done{};
    if (!(probe.radius <= kFarthest * scene.diagonal))
        return invalid(path + ".radius", "is more than a thousand times the domain's size", "give lengths in m");
    return check_direction(probe.normal, scene, path + ".normal");
}
Status check(const proto::VelocityProbe& probe, const Scene& scene, const std::string& path) {
    return check_place(probe.point, scene, path + ".point");
}
Status check(const proto::LevelProbe& probe, const Scene& scene, const std::string& path) {
    return check_line(probe.from, probe.to, scene, path);
}
Status check(const proto::ProfileProbe& probe, const Scene& scene, const std::string& path) {
    if (probe.points < 2) return invalid(path + ".points", "must be at least 2", "both ends are points");
    if (scene.dimensions == 2 && probe.field == proto::ProfileField::velocity_z)
        return invalid(path + ".field", "velocity_z is for 3 dimensions only", "choose velocity_x or velocity_y");
    return check_line(probe.from, probe.to, scene, path);
}
Status check(const proto::FrontProbe& probe, const Scene& scene, const std::string& path) {
    return check_direction(probe.direction, scene, path + ".direction");
}
Status check(const proto::DischargeProbe& probe, const Scene& scene, const std::string& path) {
    if (Status place = check_place(probe.point, scene, path + ".point"); !place) return place;
    return check_direction(probe.normal, scene, path + ".normal");
}
Status check(const proto::ForceProbe& probe, const Scene& scene, const std::string& path) {
    return check_place(probe.about, scene, path + ".about");
}
template <class Other>
Status check(const Other&, const Scene&, const std::string&) {
    return Done{};
}

// Tag of the kind in the document, in the order of proto::ProbeKind.
constexpr const char* kTags[]{"pressure",  "velocity", "level",    "profile", "front",
                              "discharge", "force",    "energies", "density"};
static_assert(std::size(kTags) == std::variant_size_v<proto::ProbeKind>);

}  // namespace

Status check_probe(const proto::ProbeDesc& desc, const RunView& run, const std::string& path) {
    const Scene scene = scene_of(run);
    const std::string below = path + ".kind." + kTags[desc.kind.index()];
    return std::visit([&](const auto& kind) { return check(kind, scene, below); }, desc.kind);
}

std::unique_ptr<Probe> make_probe(const proto::ProbeDesc& desc, int dimensions) {
    return std::visit([&](const auto& kind) { return make_probe(kind, dimensions); }, desc.kind);
}

}  // namespace headrace::probes
