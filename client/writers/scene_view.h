// What a picture needs to know of a scene: where up is, what there is to see, how large particles are and which range
// of colours makes sense. All of it is fixed for a recording, so that its pictures compare.
#pragma once

#include <vector>

#include "client/writers/palette.h"
#include "client/writers/writer.h"

namespace headrace::client {

// Ends of the colour bar in the field's unit; values beyond them take the end's colour.
struct ColorScale {
    proto::Field field{proto::Field::velocity};
    double min{0}, max{1};
    Palette palette{Palette::viridis};
};

// The coordinate axis that is nearest to against gravity; y when there is none.
Vec3 up_axis(const proto::SceneDesc& scene);

// Containers, with the fluids and the obstacles inside them; the fluids and obstacles alone where nothing contains
// them.
proto::BoxDesc visible_bounds(const proto::SceneDesc& scene);

// [m] Radius of the sphere (2D: disc) that holds a particle's mass at rest density: Staubach 2010, Eq. 3.5.
double particle_radius(const proto::SceneDesc& scene);

// The ends asked for; a missing one is guessed: speeds up to free fall from the fluid's top to the lowest point,
// sqrt(2 g H); pressures up to rest_density g H; densities 0.9 to 1.5 rest densities; accelerations up to 3 g.
ColorScale make_color_scale(const proto::SceneDesc& scene, const PictureOptions& options);

// The values that colours stand for, one per particle: magnitudes of vectors. Precondition: frame.find(field).
std::vector<float> color_values(const proto::FrameView& frame, proto::Field field);

// Positions, third component 0 in 2D. Precondition: frame.find(Field::position).
std::vector<Vec3> particle_positions(const proto::FrameView& frame);

}  // namespace headrace::client
