// Parts of which the scenes of the stability gate are made. SI units.
#pragma once

#include <string>

#include "proto/scene_desc.h"
#include "tests/stability/cases/scenario.h"

namespace headrace::stability {

inline constexpr double kGravity = 9.81;  // [m/s^2]

// An empty scene of the wcsph model with gravity along -y; the domain is a cube of this half width around 0.
proto::SceneDesc make_scene(int dimensions, double spacing, double half_width);

proto::FluidDesc make_block(const std::string& name, const proto::Vec3& min, const proto::Vec3& max,
                            const proto::Vec3& velocity = {});
proto::FluidDesc make_disc(const proto::Vec3& center, double radius, const proto::Vec3& velocity);
// Still water in its place: pressure of its own weight.
proto::FluidDesc make_pool(const proto::Vec3& min, const proto::Vec3& max);

proto::ObjectDesc make_container(const proto::Vec3& min, const proto::Vec3& max);
proto::ObjectDesc make_obstacle(const std::string& name, const proto::ShapeDesc& shape);
proto::ObjectDesc make_floor();  // y = 0

proto::ScalarVec3 to_scalars(const proto::Vec3& u);

// "0.5" rather than "0.500000".
std::string short_text(double value);

}  // namespace headrace::stability
