// What a frame is in POV-Ray's language: camera, light and materials, particles, objects. Particles are spheres of the
// radius of Staubach 2010, Eq. 3.5, coloured by the palette; containers are glass, obstacles solid, planes sheets.
#pragma once

#include <string>
#include <vector>

#include "client/writers/placed_object.h"
#include "client/writers/scene_view.h"
#include "client/writers/stage.h"

namespace headrace::client {

inline constexpr int kPovShades = 256;  // textures T[0] to T[255] are the palette; T[256] is that of no number

std::string pov_number(double value);

// All but particles and objects.
std::string pov_head(const WriterOptions& options, const Stage& stage, const ColorScale& colors);

void append_pov_particle(std::string& text, const Vec3& center, int shade);

// As `camera` sees them: glass before the fluid is clearer than glass behind it.
std::string pov_objects(const std::vector<PlacedObject>& objects, const proto::SceneDesc& scene, const Stage& stage,
                        const Camera& camera);

}  // namespace headrace::client
