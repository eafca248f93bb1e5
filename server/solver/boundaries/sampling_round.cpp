#include "server/solver/boundaries/sampling_round.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "server/solver/boundaries/rigid_motion.h"
#include "server/solver/boundaries/sampling_lattice.h"

namespace headrace::solver {
namespace {

using std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Turns neighbouring rings and shells against each other, so that no seam forms: the golden section of a cell.
constexpr double kGolden = 0.6180339887498949;

struct Frame {
    Vec3 center{}, e1{}, e2{}, e3{};  // [m]; orthonormal
};

Frame frame_around(const Vec3& center, const Vec3& axis) {
    const Vec3 other = std::abs(axis[0]) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const double along = rigid::dot(other, axis);
    Vec3 e1 = rigid::minus(other, rigid::times(along, axis));
    e1 = rigid::times(1.0 / rigid::length(e1), e1);
    return {center, e1, rigid::cross(axis, e1), axis};
}

// A sphere around the domain grown by the depth; infinite where nothing bounds the sampling.
struct Ball {
    Vec3 center{};
    double radius{};
};

Ball bounding_ball(const SamplingSpace& space) {
    Ball ball;
    double square = 0.0;
    for (int k = 0; k < space.dimensions; ++k) {
        ball.center[k] = 0.5 * (space.domain.min[k] + space.domain.max[k]);
        const double half = space.high(k) - ball.center[k];
        square += half * half;
    }
    ball.radius = std::sqrt(square);
    return ball;
}

// Angles under which the ball is seen; a surface far larger than the domain is sampled only there.
Bounds angles_of(double ball_angle, double ball_distance, double ball_radius) {
    if (!(ball_distance > ball_radius)) return {-kInfinity, kInfinity};
    const double half = std::asin(ball_radius / ball_distance) + 1e-9;
    return {ball_angle - half, ball_angle + half};
}

// Radii around the centre, in the directions given, where the domain is.
Bounds radii_of(double ball_distance, double ball_radius) {
    return {ball_distance - ball_radius, ball_distance + ball_radius};
}

// Angles around e3, from e1 towards e2, under which the domain is seen.
Bounds azimuths(const Frame& frame, const SamplingSpace& space) {
    const Ball ball = bounding_ball(space);
    const Vec3 to_ball = rigid::minus(ball.center, frame.center);
    const double x = rigid::dot(to_ball, frame.e1), y = rigid::dot(to_ball, frame.e2);
    return angles_of(std::atan2(y, x), std::hypot(x, y), ball.radius);
}

// Equal parts of a full turn, as far as their middles lie within the bounds.
std::vector<Slot> parts_of_turn(double count, double phase, const Bounds& bounds) {
    const double step = 2.0 * pi / count;
    const double origin = (phase - std::floor(phase)) * step;
    std::vector<Slot> parts;
    if (bounds.high == kInfinity) {
        append_slots(origin, step, count, {-kInfinity, kInfinity}, false, parts);
    } else {
        // The bounds span less than half a turn: start the count half a turn before them.
        const double begin = std::floor((0.5 * (bounds.low + bounds.high) - pi - origin) / step) * step + origin;
        append_slots(begin, step, count, bounds, false, parts);
    }
    return parts;
}

struct Shell {
    double inner{}, outer{};  // [m] radii
    bool is_solid{};

    double middle() const { return 0.5 * (inner + outer); }
    double thickness() const { return outer - inner; }
};

// Of what lies within the solid layer [m]: a container's inside, an obstacle's core too deep to be seen.
double core_radius(double radius, bool is_container, const SamplingSpace& space) {
    if (is_container) return radius;
    const double layer = space.layers * space.dx;
    return radius < layer * (1.0 + 1e-9) ? 0.0 : radius - layer;
}

// Shells of a solid layer: outwards of a container's surface, inwards of an obstacle's; those that lie within the radii
// where the domain is.
std::vector<Shell> solid_shells(double radius, bool is_container, const SamplingSpace& space, const Bounds& radii) {
    std::vector<Shell> shells;
    const bool is_filled = !is_container && core_radius(radius, is_container, space) == 0.0;
    const int count = is_filled ? static_cast<int>(whole_number(radius, space.dx)) : space.layers;
    const double thickness = is_filled ? radius / count : space.dx;
    for (int k = 0; k < count; ++k) {
        const double from = radius + (is_container ? k : -k) * thickness;
        const double to = is_container ? from + thickness : (is_filled && k + 1 == count ? 0.0 : from - thickness);
        const Shell shell{std::min(from, to), std::max(from, to), true};
        if (shell.outer >= radii.low && shell.inner <= radii.high) shells.push_back(shell);
    }
    return shells;
}

// Shells of all that lies within a radius: a cylinder's end face. Far from the domain they are left out.
void append_core_shells(double radius, const Bounds& radii, const SamplingSpace& space, std::vector<Shell>& shells) {
    if (!(radius > 0.0)) return;
    std::vector<Slot> slots;
    const double count = whole_number(radius, space.dx);
    append_slots(0.0, radius / count, count, {radii.low - space.dx, radii.high + space.dx}, false, slots);
    for (const Slot& slot : slots) shells.push_back({slot.x - 0.5 * slot.width, slot.x + 0.5 * slot.width, false});
}

void sample_disc(const Body& body, const Sphere& disc, const SamplingSpace& space, Index object,
                 std::vector<Dummy>& dummies) {
    const Frame frame{disc.center, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    const Bounds bounds = azimuths(frame, space);
    const Ball ball = bounding_ball(space);
    const double distance = std::hypot(ball.center[0] - disc.center[0], ball.center[1] - disc.center[1]);
    double phase = 0.5;
    for (const Shell& shell : solid_shells(disc.radius, body.is_container, space, radii_of(distance, ball.radius))) {
        const double rho = shell.middle();
        const double count = whole_number(2.0 * pi * rho, space.dx);
        const double V = 2.0 * pi * rho * shell.thickness() / count;
        for (const Slot& part : parts_of_turn(count, phase, bounds)) {
            const double radius = count > 1.0 ? rho : 0.0;  // a single one stands in the middle
            const Vec3 out{std::cos(part.x), std::sin(part.x), 0.0};
            const Vec3 X = rigid::plus(disc.center, rigid::times(radius, out));
            append_dummy(body, space, {X[0], X[1], 0.0}, V, object, dummies);
        }
        phase += kGolden;
    }
}

// One shell of a sphere: zones of equal height in the polar angle, each cut into equal parts around the axis.
void sample_shell(const Body& body, const Frame& frame, const Shell& shell, double phase, const SamplingSpace& space,
                  Index object, std::vector<Dummy>& dummies) {
    const double rho = shell.middle();
    const double zones = whole_number(pi * rho, space.dx);
    const double cubes = (std::pow(shell.outer, 3) - std::pow(shell.inner, 3)) / 3.0;  // [m^3]
    const Ball ball = bounding_ball(space);
    const Vec3 to_ball = rigid::minus(ball.center, frame.center);
    const double distance = rigid::length(to_ball);
    const double ball_angle =
        distance > 0.0 ? std::acos(std::clamp(rigid::dot(to_ball, frame.e3) / distance, -1.0, 1.0)) : 0.0;
    const Bounds around = azimuths(frame, space), from_pole = angles_of(ball_angle, distance, ball.radius);
    if (from_pole.high == kInfinity) check_wall_count(4.0 * zones * zones / pi);  // area of the sphere / dx^2
    std::vector<Slot> polar;
    append_slots(0.0, pi / zones, zones, from_pole, false, polar);
    for (const Slot& zone : polar) {
        const double height = std::cos(zone.x - 0.5 * zone.width) - std::cos(zone.x + 0.5 * zone.width);
        const double count = zones > 1.0 ? whole_number(2.0 * pi * rho * std::sin(zone.x), space.dx) : 1.0;
        const double V = 2.0 * pi * cubes * height / count;
        for (const Slot& part : parts_of_turn(count, phase, around)) {
            const double radius = zones > 1.0 ? rho : 0.0;  // a single one stands in the middle
            Vec3 X = rigid::plus(frame.center, rigid::times(radius * std::cos(zone.x), frame.e3));
            X = rigid::plus(X, rigid::times(radius * std::sin(zone.x) * std::cos(part.x), frame.e1));
            X = rigid::plus(X, rigid::times(radius * std::sin(zone.x) * std::sin(part.x), frame.e2));
            append_dummy(body, space, X, V, object, dummies);
        }
        phase += kGolden;
    }
}

}  // namespace

void sample_sphere(const Body& body, const Sphere& sphere, const SamplingSpace& space, Index object,
                   std::vector<Dummy>& dummies) {
    if (space.dimensions == 2) return sample_disc(body, sphere, space, object, dummies);
    const Frame frame = frame_around(sphere.center, {0.0, 1.0, 0.0});
    const Ball ball = bounding_ball(space);
    const Bounds radii = radii_of(rigid::length(rigid::minus(ball.center, sphere.center)), ball.radius);
    double phase = 0.0;
    for (const Shell& shell : solid_shells(sphere.radius, body.is_container, space, radii)) {
        sample_shell(body, frame, shell, phase, space, object, dummies);
        phase += 0.5;
    }
}

void sample_cylinder(const Body& body, const Cylinder& cylinder, const SamplingSpace& space, Index object,
                     std::vector<Dummy>& dummies) {
    const Frame frame = frame_around(cylinder.center, cylinder.axis);
    const Ball ball = bounding_ball(space);
    const Vec3 to_ball = rigid::minus(ball.center, frame.center);
    const double ball_along = rigid::dot(to_ball, frame.e3);
    const double ball_distance = std::hypot(rigid::dot(to_ball, frame.e1), rigid::dot(to_ball, frame.e2));
    const Bounds around = azimuths(frame, space);

    // Layers along the axis: as a box's axis.
    std::vector<Slot> layers;
    const auto endless = std::find(body.endless.begin(), body.endless.end(), true);
    if (endless != body.endless.end()) {
        const int axis = static_cast<int>(endless - body.endless.begin());
        layers = slots_along_period(space, axis);
        for (Slot& layer : layers) layer.x = (layer.x - cylinder.center[axis]) * cylinder.axis[axis];
    } else {
        layers = slots_across(-cylinder.half_length, cylinder.half_length, body.is_container, space,
                              {ball_along - ball.radius, ball_along + ball.radius});
    }

    // Rings of the cross-section: the solid layer, and what lies within it.
    const Bounds radii = radii_of(ball_distance, ball.radius);
    std::vector<Shell> rings = solid_shells(cylinder.radius, body.is_container, space, radii);
    append_core_shells(core_radius(cylinder.radius, body.is_container, space), radii, space, rings);

    for (const Shell& ring : rings) {
        const double rho = ring.middle();
        const double count = whole_number(2.0 * pi * rho, space.dx);
        const double area = 2.0 * pi * rho * ring.thickness() / count;
        const std::vector<Slot> parts = parts_of_turn(count, kGolden * std::round(rho / space.dx), around);
        const double radius = count > 1.0 ? rho : 0.0;  // a single one stands in the middle
        check_wall_count(static_cast<double>(dummies.size() + parts.size() * (ring.is_solid ? layers.size() : 1)));
        for (const Slot& layer : layers) {
            if (!ring.is_solid && !layer.is_solid) continue;
            for (const Slot& part : parts) {
                Vec3 X = rigid::plus(frame.center, rigid::times(layer.x, frame.e3));
                X = rigid::plus(X, rigid::times(radius * std::cos(part.x), frame.e1));
                X = rigid::plus(X, rigid::times(radius * std::sin(part.x), frame.e2));
                append_dummy(body, space, X, area * layer.width, object, dummies);
            }
        }
    }
}

}  // namespace headrace::solver
