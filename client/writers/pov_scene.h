// What a frame is in POV-Ray's language but for its objects: camera, light and materials, particles. Particles are
// spheres of the radius of Staubach 2010, Eq. 3.5, coloured by the palette.
#pragma once

#include <string>

#include "client/writers/scene_view.h"
#include "client/writers/stage.h"

namespace headrace::client {

inline constexpr int kPovShades = 256;  // textures T[0] to T[255] are the palette; T[256] is that of no number

// Sees what the pictures see, with a margin. Its picture is 1 high, from -0.5 at the top to 0.5; (0, 0) is the middle.
Camera make_pov_camera(const WriterOptions& options, const Stage& stage);

// All but particles and objects.
std::string pov_head(const WriterOptions& options, const Stage& stage, const Camera& camera, const ColorScale& colors);

void append_pov_particle(std::string& text, const Vec3& center, int shade);

}  // namespace headrace::client
