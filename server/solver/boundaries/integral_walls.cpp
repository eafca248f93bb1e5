#include "server/solver/boundaries/integral_walls.h"

#include <cmath>

#include "server/solver/boundaries/share_sum.h"

namespace headrace::solver {

IntegralWalls::IntegralWalls(const SectionKernel& kernel, double layer)
    : dimensions_(kernel.dimensions),
      support_(kernel.support),
      kernel_(kernel),
      layers_(make_wall_layers(layer, kernel.support)),
      plane_(make_plane_profile(kernel, layers_)),
      edge_(make_section_table(kernel, kernel.dimensions - 2, layer)),
      corner_(make_section_table(kernel, 0, layer)) {}

void IntegralWalls::clear() {
    has_faces_ = false;
    room_ = {};
    inner_low_ = {kNowhere, kNowhere, kNowhere};
    inner_high_ = {-kNowhere, -kNowhere, -kNowhere};
    boxes_.clear();
    spheres_.clear();
    period_ = {};
}

void IntegralWalls::add_face(int axis, int side, double at, const IntegralSurface& surface) {
    IntegralFace& face = room_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
    const bool is_narrower = side == 0 ? at > face.at : at < face.at;
    if (face.exists && !is_narrower) return;
    face = {true, at, surface};
    has_faces_ = true;
    if (side == 0) {
        inner_low_[static_cast<std::size_t>(axis)] = at + support_;
    } else {
        inner_high_[static_cast<std::size_t>(axis)] = at - support_;
    }
}

void IntegralWalls::add_sphere(const Vec3& center, double radius, bool is_container, const IntegralSurface& surface) {
    spheres_.push_back(
        {center, radius, is_container, make_sphere_profile(kernel_, layers_, radius, is_container), surface});
}

Vec3 IntegralWalls::nearest_image(Vec3 x, const Vec3& center) const {
    for (std::size_t k = 0; k < 3; ++k) {
        if (period_[k] > 0.0) x[k] -= period_[k] * std::round((x[k] - center[k]) / period_[k]);
    }
    return x;
}

namespace {

template <int D>
Vec3 in_space(const std::array<double, D>& x) {
    Vec3 place{};
    for (int k = 0; k < D; ++k) place[k] = x[k];
    return place;
}

}  // namespace

template <int D>
bool IntegralWalls::is_near(const std::array<double, D>& x) const {
    for (int k = 0; k < D; ++k) {
        if (x[k] < inner_low_[k] || x[k] > inner_high_[k]) return true;
    }
    return has_obstacles() && is_near_obstacle<D>(x);
}

template <int D>
bool IntegralWalls::find_lonely_face(const std::array<double, D>& x, LonelyFace& face) const {
    int count = 0;
    for (int k = 0; k < D; ++k) {
        const auto& [low, high] = room_[k];
        if (x[k] < inner_low_[k]) {
            ++count;
            face = {k, 1.0, x[k] - low.at, &low.surface};
        }
        if (x[k] > inner_high_[k]) {
            ++count;
            face = {k, -1.0, high.at - x[k], &high.surface};
        }
    }
    return count == 1 && !(has_obstacles() && is_near_obstacle<D>(x));
}

template <int D>
bool IntegralWalls::is_near_obstacle(const std::array<double, D>& x) const {
    const Vec3 place = in_space<D>(x);
    for (const IntegralBox& box : boxes_) {
        const Vec3 middle{0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1]),
                          0.5 * (box.low[2] + box.high[2])};
        if (look_at<D>(box, nearest_image(place, middle)).distance < support_) return true;
    }
    for (const IntegralSphere& sphere : spheres_) {
        const Vec3 seen = nearest_image(place, sphere.center);
        double r2 = 0.0;
        for (int k = 0; k < D; ++k) r2 += (seen[k] - sphere.center[k]) * (seen[k] - sphere.center[k]);
        const double bound = sphere.is_container ? sphere.radius - support_ : sphere.radius + support_;
        if (sphere.is_container ? bound < 0.0 || r2 > bound * bound : r2 < bound * bound) return true;
    }
    return false;
}

template <int D>
void IntegralWalls::find_share(const std::array<double, D>& x, double least_distance, WallShare<D>& share) const {
    share.count = 0;
    share.grad = share.shifted = {};
    share.M = {};
    const Vec3 place = in_space<D>(x);
    ShareSum<D> sum(*this, least_distance, share);
    if (has_faces_) sum.add_room(place);
    for (const IntegralBox& box : boxes_) {
        const Vec3 middle{0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1]),
                          0.5 * (box.low[2] + box.high[2])};
        sum.add_box(box, nearest_image(place, middle));
    }
    for (const IntegralSphere& sphere : spheres_) sum.add_sphere(sphere, nearest_image(place, sphere.center));
}

template bool IntegralWalls::is_near<2>(const std::array<double, 2>&) const;
template bool IntegralWalls::is_near_obstacle<2>(const std::array<double, 2>&) const;
template bool IntegralWalls::find_lonely_face<2>(const std::array<double, 2>&, LonelyFace&) const;
template bool IntegralWalls::is_near<3>(const std::array<double, 3>&) const;
template bool IntegralWalls::is_near_obstacle<3>(const std::array<double, 3>&) const;
template bool IntegralWalls::find_lonely_face<3>(const std::array<double, 3>&, LonelyFace&) const;
template void IntegralWalls::find_share<2>(const std::array<double, 2>&, double, WallShare<2>&) const;
template void IntegralWalls::find_share<3>(const std::array<double, 3>&, double, WallShare<3>&) const;

}  // namespace headrace::solver
