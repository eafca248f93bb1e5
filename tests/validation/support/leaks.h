// Particles that a run loses: gone, or behind the surface of a wall.
#pragma once

#include <cstddef>
#include <vector>

#include "proto/scene_desc.h"
#include "server/scene/run.h"

namespace headrace::validation {

// Depth of x behind the object's surface [m]; negative on the fluid's side. Static primitives only.
double depth_behind(const proto::ObjectDesc& object, const proto::Vec3& x, int dimensions);

class LeakCount {
  public:
    explicit LeakCount(const scene::Run& run) : particles_(run.particles().size()) {}
    void sample(const scene::Run& run);
    std::size_t most() const { return most_; }  // of all samples: missing + behind a surface

  private:
    std::size_t particles_;
    std::size_t most_{0};
};

}  // namespace headrace::validation
