// Progress of a build, and the wish to end it; shared between the builder and whoever waits.
#pragma once

#include <atomic>

namespace headrace::scene {

struct BuildControl {
    std::atomic<double> progress{0.0};  // 0..1
    std::atomic<bool> cancelled{false};
};

}  // namespace headrace::scene
