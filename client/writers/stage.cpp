#include "client/writers/stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client/writers/boxes.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

namespace {

using proto::BoxDesc;
using proto::SceneDesc;

constexpr double kMargin = 0.06;   // of the fluid's size, left around it
constexpr double kNear = 0.25;     // of the fluid's size: walls so near are shown, and obstacles that cost no more
constexpr double kWorthIt = 1.15;  // so many times as large, or all is shown
constexpr double kAspect = 1.6;    // of the place for the scene, roughly

std::vector<Vec3> corners_of(const BoxDesc& box) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) points.push_back(box_corner(box, k));
    return points;
}

std::vector<Vec3> surface_of(const proto::SphereDesc& sphere, int dimensions) {
    const double equator = dimensions == 2 ? 0 : 1;
    constexpr int kSteps = 64;
    std::vector<Vec3> points;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j <= kSteps; ++j) {
            const double around = 2 * std::numbers::pi * i / kSteps;
            const double polar = std::numbers::pi * j / kSteps;
            points.push_back(sphere.center + sphere.radius * Vec3{std::sin(polar) * std::cos(around), std::cos(polar),
                                                                  equator * std::sin(polar) * std::sin(around)});
        }
    return points;
}

bool has_containers(const SceneDesc& scene) {
    return std::ranges::any_of(scene.objects, [](const proto::ObjectDesc& object) {
        return object.role == proto::ObjectRole::container && !std::holds_alternative<proto::PlaneDesc>(object.shape);
    });
}

// Are the containers boxes at rest, which can be cut open?
bool can_be_cut(const SceneDesc& scene) {
    return std::ranges::all_of(scene.objects, [](const proto::ObjectDesc& object) {
        const bool is_open =
            object.role == proto::ObjectRole::obstacle || std::holds_alternative<proto::PlaneDesc>(object.shape);
        return is_open || (std::holds_alternative<BoxDesc>(object.shape) && !object.motion);
    });
}

// All that there is to see.
BoxDesc whole_of(const SceneDesc& scene, const std::optional<Extents>& extents) {
    BoxDesc whole = visible_bounds(scene);
    if (!extents) return whole;
    include(whole, extents->containers);
    if (!has_containers(scene)) include(whole, extents->fluid);
    if (scene.dimensions == 2) whole.min[2] = whole.max[2] = 0;
    return whole;
}

double pixels_per_metre(const BoxDesc& box) {
    return 1 / std::max((box.max[0] - box.min[0]) / kAspect, box.max[1] - box.min[1]);
}

// Makes room on both sides, as far as there is something to see; all of what is beside the fluid where that is little.
void add_room(BoxDesc& part, std::size_t axis, double margin, const BoxDesc& whole) {
    const double near = kNear * (part.max[axis] - part.min[axis]);
    part.min[axis] = std::max(whole.min[axis], part.min[axis] - margin);
    part.max[axis] = std::min(whole.max[axis], part.max[axis] + margin);
    if (part.min[axis] - whole.min[axis] < near) part.min[axis] = whole.min[axis];
    if (whole.max[axis] - part.max[axis] < near) part.max[axis] = whole.max[axis];
}

// Takes in the obstacles that make the picture only a little smaller. `scale`: how large it is.
template <class Scale>
BoxDesc with_obstacles(const BoxDesc& part, const BoxDesc& whole, const Extents& extents, const Scale& scale) {
    BoxDesc all = part;
    for (const auto& [name, bounds] : extents.obstacles) {
        BoxDesc more = all;
        include(more, grown(common_part(bounds, whole), 0.01 * length(part.max - part.min)));
        more = common_part(more, whole);
        if (scale(more) * (1 + kNear) > scale(part)) all = more;
    }
    return all;
}

// 2D: the rectangle that the fluid fills, if that is much larger to see.
std::optional<BoxDesc> fluid_rectangle(const BoxDesc& whole, const Extents& extents) {
    const Vec3 size = extents.fluid.max - extents.fluid.min;
    BoxDesc part = common_part(extents.fluid, whole);
    for (const std::size_t axis : {0, 1}) add_room(part, axis, kMargin * std::max(size[0], size[1]), whole);
    part.min[2] = part.max[2] = 0;
    part = with_obstacles(part, whole, extents, pixels_per_metre);
    part.min[2] = part.max[2] = 0;
    if (pixels_per_metre(part) < kWorthIt * pixels_per_metre(whole)) return {};
    return part;
}

std::size_t axis_of(const Vec3& up) {
    return up[0] != 0 ? 0 : up[1] != 0 ? 1 : 2;
}

// 3D: the tank up to a little above the fluid, if that is much lower.
std::optional<BoxDesc> cut_above(const BoxDesc& whole, const Extents& extents, const Vec3& up) {
    const std::size_t axis = axis_of(up);
    const auto inverse_height = [axis](const BoxDesc& box) { return 1 / (box.max[axis] - box.min[axis]); };
    const BoxDesc& fluid = extents.fluid;
    BoxDesc part = whole;
    const double margin = 1.5 * kMargin * (fluid.max[axis] - fluid.min[axis]);
    if (up[axis] > 0) part.max[axis] = std::min(whole.max[axis], fluid.max[axis] + margin);
    if (up[axis] < 0) part.min[axis] = std::max(whole.min[axis], fluid.min[axis] - margin);
    part = with_obstacles(part, whole, extents, inverse_height);
    if (inverse_height(part) < kWorthIt * inverse_height(whole)) return {};
    return part;
}

// Without width or height where they have nothing in common.
Viewport overlap(const Viewport& part, const Viewport& of) {
    const double end_x = of.left + of.width, end_y = of.top + of.height;
    const double left = std::clamp(part.left, of.left, end_x), top = std::clamp(part.top, of.top, end_y);
    return {left, top, std::clamp(part.left + part.width, left, end_x) - left,
            std::clamp(part.top + part.height, top, end_y) - top};
}

}  // namespace

Stage make_stage(const SceneDesc& scene, const ViewOptions& view, const std::optional<Extents>& extents) {
    const BoxDesc whole = whole_of(scene, extents);
    Stage stage{whole, corners_of(whole), {}, view.zoom > 1, false};
    if (view.crop) {
        stage.bounds = *view.crop;
        if (scene.dimensions == 2) stage.bounds.min[2] = stage.bounds.max[2] = 0;
        stage.outline = corners_of(stage.bounds);
        stage.is_part = stage.hides_rest = true;
        return stage;
    }
    if (!view.whole && extents && !is_nowhere(extents->fluid)) {
        std::optional<BoxDesc> part;
        if (scene.dimensions == 2) part = fluid_rectangle(whole, *extents);
        if (scene.dimensions == 3 && can_be_cut(scene)) {
            const Vec3 up = up_axis(scene);
            const std::size_t axis = axis_of(up);
            part = cut_above(whole, *extents, up);
            if (part) stage.cutaway = Cutaway{axis, up[axis] > 0, (up[axis] > 0 ? part->max : part->min)[axis]};
        }
        if (part) {
            stage.bounds = *part;
            stage.outline = corners_of(*part);
            stage.is_part = true;
            return stage;
        }
    }
    // A lone sphere contains everything: its cube would waste a quarter of the picture.
    if (scene.objects.size() == 1 && scene.objects[0].role == proto::ObjectRole::container && !scene.objects[0].motion)
        if (const auto* sphere = std::get_if<proto::SphereDesc>(&scene.objects[0].shape))
            stage.outline = surface_of(*sphere, scene.dimensions);
    return stage;
}

Reach needed_reach(const SceneDesc& scene, const ViewOptions& view) {
    if (view.crop) return Reach::nothing;
    const bool is_cut_to_fluid = !view.whole && (scene.dimensions == 2 || can_be_cut(scene));
    return is_cut_to_fluid || !has_containers(scene) ? Reach::objects_and_fluid : Reach::objects;
}

proto::Status check_view(const WriterOptions& options) {
    const ViewOptions& view = options.picture.view;
    const SceneDesc& scene = options.scene;
    if (view.crop)
        for (int k = 0; k < scene.dimensions; ++k)
            if (!(view.crop->max[k] > view.crop->min[k]))
                return proto::Error{proto::ErrorCode::invalid_params, "the picture would show nothing", "--crop",
                                    scene.dimensions == 2 ? "x0,y0,x1,y1, ascending" : "x0,y0,z0,x1,y1,z1, ascending"};
    if (!view.position || scene.dimensions == 2) return proto::Done{};
    const Stage stage = make_stage(scene, view, options.extents);
    const BoxDesc& bounds = stage.bounds;
    const Vec3 backward = *view.position - view.target.value_or(0.5 * (bounds.min + bounds.max));
    const double slack = 1e-6 * length(bounds.max - bounds.min);
    if (!(length(backward) > slack))
        return proto::Error{proto::ErrorCode::invalid_params, "the eye is where it looks at", "--camera",
                            "give --camera and --target two places"};
    const Vec3 up = view.up.value_or(up_axis(scene));
    if (!(length(cross(up, backward)) > 1e-6 * length(up) * length(backward)))
        return proto::Error{proto::ErrorCode::invalid_params, "the eye looks along the direction upwards", "--up",
                            "give another direction"};
    for (const Vec3& point : stage.outline)
        if (!(dot(*view.position - point, normalized(backward)) > slack))
            return proto::Error{proto::ErrorCode::invalid_params, "a part of the scene is behind the eye", "--camera",
                                "move it away from the scene, which reaches from scene.domain's min to max at most"};
    return proto::Done{};
}

Camera make_camera(const SceneDesc& scene, const Stage& stage, const ViewOptions& view, const Viewport& viewport) {
    const std::vector<Vec3>& outline = stage.outline;
    const Vec3 up = up_axis(scene);
    const Vec3 middle = 0.5 * (stage.bounds.min + stage.bounds.max);
    const auto from = [&](const Vec3& backward, const Vec3& upwards) {
        return Camera::looking(outline, {}, backward, upwards, viewport);
    };
    const auto chosen = [&] {
        const Camera front = Camera::orthographic(outline, up, viewport);
        if (scene.dimensions == 2) return front;
        if (view.position)
            return Camera::looking(outline, view.position, *view.position - view.target.value_or(middle),
                                   view.up.value_or(up), viewport);
        switch (view.name) {
            case ViewName::front:
                return front;
            case ViewName::side:
                return from(front.right(), up);
            case ViewName::top:
                return from(up, -1 * front.backward());
            case ViewName::iso:
                return from(front.right() + up + front.backward(), up);
            case ViewName::standard:
                break;
        }
        return Camera::perspective(outline, up, viewport);
    };
    const Camera camera = chosen();
    if (view.zoom == 1) return camera;
    return view.target ? camera.zoomed(view.zoom, *view.target, viewport) : camera.zoomed(view.zoom, viewport);
}

std::optional<Viewport> clip_of(const Stage& stage, const ViewOptions& view, const Camera& camera,
                                const Viewport& viewport) {
    if (!stage.is_part) return {};
    if (view.zoom != 1 && !stage.hides_rest) return viewport;
    // Lines at the edge are as wide as elsewhere, and what the stage shows has room for particles that stand at its
    // edge; above there are words.
    constexpr double kLine = 2, kParticle = 10;  // [px]
    const double room = stage.hides_rest ? kLine : kParticle;
    const Viewport v = stage.hides_rest ? camera.covered(stage.outline) : viewport;
    const Viewport part{v.left - room, v.top - kLine, v.width + 2 * room, v.height + kLine + room};
    return view.zoom == 1 ? part : overlap(part, viewport);
}

}  // namespace headrace::client
