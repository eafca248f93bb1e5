#include "client/writers/scene_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/writers/boxes.h"
#include "proto/shape_bounds.h"

namespace headrace::client {

namespace {

using proto::bounding_box;
using proto::BoxDesc;
using proto::SceneDesc;

constexpr double kWaterDensity = 1000.0;  // [kg/m^3] where a scene does not say
constexpr double kGravity = 9.81;         // [m/s^2]

double number_parameter(const SceneDesc& scene, const std::string& name, double otherwise) {
    const auto found = scene.parameters.find(name);
    if (found == scene.parameters.end()) return otherwise;
    const double* number = std::get_if<double>(&found->second);
    return number != nullptr && *number > 0 ? *number : otherwise;
}

Vec3 gravity_of(const SceneDesc& scene) {
    const auto found = scene.parameters.find("gravity");
    const Vec3* vector = found == scene.parameters.end() ? nullptr : std::get_if<Vec3>(&found->second);
    return vector != nullptr ? *vector : Vec3{0, -kGravity, 0};
}

// Planes have no end: they do not say what is to be seen.
bool is_plane(const proto::ShapeDesc& shape) {
    return std::holds_alternative<proto::PlaneDesc>(shape);
}

// [m/s] What a scene's numbers say of the speed at the start; where an expression stands, nothing.
double stated_speed(const proto::ScalarVec3& velocity) {
    Vec3 stated{};
    for (std::size_t k = 0; k < 3; ++k)
        if (const double* number = std::get_if<double>(&velocity[k])) stated[k] = *number;
    return length(stated);
}

// [m] From the lowest point that the fluid can reach to its top at the start.
double fall_height(const SceneDesc& scene) {
    const Vec3 up = up_axis(scene);
    const BoxDesc bounds = visible_bounds(scene);
    BoxDesc fluid = kNowhere;
    for (const proto::FluidDesc& desc : scene.fluids)
        include(fluid, desc.particles ? bounds : bounding_box(desc.shape));
    if (scene.fluids.empty()) fluid = bounds;
    // One of the two corners is the lower one, whichever way up is.
    const double floor = std::min(dot(bounds.min, up), dot(bounds.max, up));
    const double top = std::max(dot(fluid.min, up), dot(fluid.max, up));
    return std::max(top - floor, 0.0);
}

// The next number upwards that reads well on a scale.
double rounded_up(double value) {
    if (!(value > 0) || !std::isfinite(value)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0})
        if (value <= step * power * (1 + 1e-9)) return step * power;
    return 10 * power;
}

}  // namespace

Vec3 up_axis(const SceneDesc& scene) {
    const Vec3 gravity = gravity_of(scene);
    std::size_t steepest = 1;
    for (std::size_t k = 0; k < (scene.dimensions == 2 ? 2u : 3u); ++k)
        if (std::abs(gravity[k]) > std::abs(gravity[steepest])) steepest = k;
    Vec3 up{};
    up[steepest] = gravity[steepest] > 0 ? -1 : 1;
    return up;
}

BoxDesc visible_bounds(const SceneDesc& scene) {
    const BoxDesc containers = container_bounds(at_rest(scene.objects));
    BoxDesc bounds = containers;
    for (const proto::FluidDesc& fluid : scene.fluids)
        if (!fluid.particles) include(bounds, bounding_box(fluid.shape));
    for (const proto::ObjectDesc& object : scene.objects)
        if (object.role == proto::ObjectRole::obstacle && !is_plane(object.shape))
            include(bounds, common_part(bounding_box(object.shape), containers));
    if (is_nowhere(bounds)) bounds = {scene.domain.min, scene.domain.max};
    for (std::size_t k = 0; k < 3; ++k) {
        if (k == 2 && scene.dimensions == 2) bounds.min[k] = bounds.max[k] = 0;
        // A flat scene still has a picture.
        const bool is_flat_by_design = k == 2 && scene.dimensions == 2;
        if (!is_flat_by_design && !(bounds.max[k] > bounds.min[k])) bounds.max[k] = bounds.min[k] + 1;
    }
    return bounds;
}

double particle_radius(const SceneDesc& scene) {
    const double rest_density = number_parameter(scene, "rest_density", kWaterDensity);
    const double lattice_mass = rest_density * std::pow(scene.spacing, scene.dimensions);
    const double volume = number_parameter(scene, "particle_mass", lattice_mass) / rest_density;
    if (scene.dimensions == 2) return std::sqrt(volume / std::numbers::pi);
    return std::cbrt(3 * volume / (4 * std::numbers::pi));
}

ColorScale make_color_scale(const SceneDesc& scene, const PictureOptions& options) {
    const double g = length(gravity_of(scene)), rest_density = number_parameter(scene, "rest_density", kWaterDensity);
    const double height = fall_height(scene);
    ColorScale scale{options.color_field, 0, 1, options.palette};
    switch (options.color_field) {
        case proto::Field::velocity: {
            double start = 0;  // [m/s] fastest fluid at the start
            for (const proto::FluidDesc& fluid : scene.fluids) start = std::max(start, stated_speed(fluid.velocity));
            scale.max = rounded_up(std::sqrt(start * start + 2 * g * height));
            break;
        }
        case proto::Field::acceleration:
            scale.max = rounded_up(3 * g);
            break;
        case proto::Field::pressure:
            scale.max = rounded_up(rest_density * g * height);
            break;
        case proto::Field::density:
            scale.min = 0.9 * rest_density;
            scale.max = 1.5 * rest_density;
            break;
        case proto::Field::position: {
            const BoxDesc bounds = visible_bounds(scene);
            scale.max = rounded_up(std::max(length(bounds.min), length(bounds.max)));
            break;
        }
        case proto::Field::id: {
            double volume = 0;
            for (const proto::FluidDesc& fluid : scene.fluids) {
                const BoxDesc box = bounding_box(fluid.shape);
                const Vec3 size = box.max - box.min;
                volume += size[0] * size[1] * (scene.dimensions == 2 ? 1 : size[2]);
            }
            scale.max = rounded_up(volume / std::pow(scene.spacing, scene.dimensions));
            break;
        }
    }
    // An end that was asked for stands; a guessed one makes room.
    const double extent = scale.max - scale.min;
    if (options.color_min) scale.min = *options.color_min;
    if (options.color_max) scale.max = *options.color_max;
    if (!(scale.max > scale.min)) (options.color_max ? scale.min = scale.max - extent : scale.max = scale.min + extent);
    return scale;
}

std::vector<float> color_values(const proto::FrameView& frame, proto::Field field) {
    const proto::FrameColumn& column = *frame.find(field);
    std::vector<float> values(frame.info.particle_count);
    for (std::size_t row = 0; row < values.size(); ++row) {
        double sum = 0;
        for (int component = 0; component < column.components; ++component) {
            const double value = proto::FrameView::value(column, row, component);
            sum = column.components == 1 ? value : std::hypot(sum, value);
        }
        values[row] = static_cast<float>(sum);
    }
    return values;
}

std::vector<Vec3> particle_positions(const proto::FrameView& frame) {
    const proto::FrameColumn& column = *frame.find(proto::Field::position);
    std::vector<Vec3> positions(frame.info.particle_count, Vec3{});
    for (std::size_t row = 0; row < positions.size(); ++row)
        for (int component = 0; component < column.components; ++component)
            positions[row][component] = proto::FrameView::value(column, row, component);
    return positions;
}

}  // namespace headrace::client
