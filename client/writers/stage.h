// How much of a scene the pictures of a recording show, and from where: fixed for a recording, so that a film stands
// still and its pictures compare.
#pragma once

#include <optional>
#include <vector>

#include "client/writers/camera.h"
#include "client/writers/writer.h"

namespace headrace::client {

// Where boxes are cut open: at one height.
struct Cutaway {
    std::size_t axis{};  // upwards or downwards
    bool is_max{};       // what is cut off: the part above `at` along the axis, or the one below
    double at{};         // [m]
};

struct Stage {
    proto::BoxDesc bounds;           // [m] what fills the picture; 2D: without depth
    std::vector<Vec3> outline;       // points around it: corners of boxes, surfaces of spheres
    std::optional<Cutaway> cutaway;  // 3D: box containers end here, since the fluid stays below
    bool is_part{false};             // there is more beside it, which ends at the viewport's edge
    bool hides_rest{false};          // what is beside it is not shown at all: a crop
};

// What the options ask for; otherwise the part that the fluid fills over the recording, where it leaves much of the
// scene empty: in 2D its rectangle, in 3D tanks are cut open above it.
Stage make_stage(const proto::SceneDesc& scene, const ViewOptions& view = {},
                 const std::optional<Extents>& extents = {});

// What make_stage has to know of the frames for these options.
enum class Reach { nothing, objects, objects_and_fluid };
Reach needed_reach(const proto::SceneDesc& scene, const ViewOptions& view);

// Errors: invalid_params for an eye that cannot see all of the stage, or does not know where up is, for a crop that
// holds nothing.
proto::Status check_view(const WriterOptions& options);

// Precondition: check_view. Sees all of the stage, from where the options say, and zoomed in as they say.
Camera make_camera(const proto::SceneDesc& scene, const Stage& stage, const ViewOptions& view,
                   const Viewport& viewport);

// What may be drawn on: all of the picture, or only what the stage shows.
std::optional<Viewport> clip_of(const Stage& stage, const ViewOptions& view, const Camera& camera,
                                const Viewport& viewport);

}  // namespace headrace::client
