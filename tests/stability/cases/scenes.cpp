#include "tests/stability/cases/scenes.h"

#include <cstdio>

namespace headrace::stability {

std::string short_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

proto::ScalarVec3 to_scalars(const proto::Vec3& u) {
    return {u[0], u[1], u[2]};
}

proto::SceneDesc make_scene(int dimensions, double spacing, double half_width) {
    proto::SceneDesc scene;
    scene.name = "stability";
    scene.dimensions = dimensions;
    scene.model = "wcsph";
    scene.spacing = spacing;
    for (int k = 0; k < dimensions; ++k) {
        scene.domain.min[k] = -half_width;
        scene.domain.max[k] = half_width;
    }
    scene.parameters["gravity"] = proto::Vec3{0.0, -kGravity, 0.0};
    return scene;
}

proto::FluidDesc make_block(const std::string& name, const proto::Vec3& min, const proto::Vec3& max,
                            const proto::Vec3& velocity) {
    proto::FluidDesc fluid;
    fluid.name = name;
    fluid.shape = proto::BoxDesc{min, max};
    fluid.velocity = to_scalars(velocity);
    return fluid;
}

proto::FluidDesc make_disc(const proto::Vec3& center, double radius, const proto::Vec3& velocity) {
    proto::FluidDesc fluid;
    fluid.name = "drop";
    fluid.shape = proto::SphereDesc{center, radius};
    fluid.velocity = to_scalars(velocity);
    return fluid;
}

proto::FluidDesc make_pool(const proto::Vec3& min, const proto::Vec3& max) {
    proto::FluidDesc fluid = make_block("pool", min, max);
    fluid.hydrostatic = true;
    return fluid;
}

proto::ObjectDesc make_container(const proto::Vec3& min, const proto::Vec3& max) {
    return {"tank", proto::ObjectRole::container, proto::BoxDesc{min, max}, {}, {}, {}};
}

proto::ObjectDesc make_obstacle(const std::string& name, const proto::ShapeDesc& shape) {
    return {name, proto::ObjectRole::obstacle, shape, {}, {}, {}};
}

proto::ObjectDesc make_floor() {
    return make_obstacle("floor", proto::PlaneDesc{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
}

}  // namespace headrace::stability
