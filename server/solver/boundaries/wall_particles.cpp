#include "server/solver/boundaries/wall_particles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/boundaries/rigid_motion.h"
#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// Panels entered within this share of a line count as entered at once: the first in the scene has it.
constexpr double kAtOnce = 1e-11;

Vec3 position(const WallParticles& particles, std::size_t k) {
    Vec3 x{};
    for (int axis = 0; axis < particles.dimensions; ++axis) x[axis] = particles.x[axis][k];
    return x;
}

template <class T>
void set(std::array<std::vector<T>, 3>& field, int dimensions, std::size_t k, const Vec3& value) {
    for (int axis = 0; axis < dimensions; ++axis) field[axis][k] = static_cast<T>(value[axis]);
}

// b as the image nearest to a.
Vec3 image_near(const Domain& domain, int dimensions, const Vec3& a, Vec3 b) {
    for (int k = 0; k < dimensions; ++k) {
        if (!domain.periodic[k]) continue;
        const double period = domain.max[k] - domain.min[k];
        b[k] -= period * std::round((b[k] - a[k]) / period);
    }
    return b;
}

}  // namespace

Walls::Walls(int dimensions, double spacing, double depth) : dimensions_(dimensions), spacing_(spacing), depth_(depth) {
    particles_.dimensions = dimensions;
}

void Walls::rebuild(std::span<const CollisionObject> objects, const Domain& domain, double t,
                    std::span<const char> without_dummies) {
    space_ = make_sampling_space(dimensions_, spacing_, depth_, domain);
    objects_.clear();
    panels_.clear();
    panel_of_.assign(objects.size(), kNoPanel);
    dummies_.clear();
    for (std::size_t k = 0; k < objects.size(); ++k) {
        objects_.emplace_back(objects[k], space_, t);
        if (!without_dummies.empty() && without_dummies[k]) continue;
        const Body& body = objects_.back().body();
        SamplingSpace space = space_;
        space.is_bounded = !objects_.back().is_moving();
        if (const auto panel = make_thin_panel(body, depth_)) {
            panel_of_[k] = panels_.size();
            panels_.push_back({k, *panel});
            sample_thin_panel(body, space, static_cast<Index>(k), dummies_);
        } else {
            sample_walls(body, space, static_cast<Index>(k), dummies_);
        }
    }
    drop_hidden_for_good();
    list_changeable();
    place_.resize(dummies_.size());
    active_.assign(dummies_.size(), 1);
    for (std::size_t id = 0; id < dummies_.size(); ++id) {
        const WallObject& own = objects_[dummies_[id].object];
        place_[id] = own.place(dummies_[id]);
        own.bring_into_domain(place_[id]);
    }
    update_places();
    collect();
    if (!has_moving() && !has_thin()) forget_sampling();
}

void Walls::forget_sampling() {
    std::vector<Dummy>().swap(dummies_);
    std::vector<Vec3>().swap(place_);
    std::vector<char>().swap(active_);
}

bool Walls::move_to(double t) {
    WallObject::Change change;
    for (WallObject& object : objects_) {
        const WallObject::Change of_this = object.move_to(t);
        change.of_place |= of_this.of_place;
        change.of_motion |= of_this.of_motion;
    }
    if (change.of_place && update_places()) {
        collect();
    } else if (change.of_place || change.of_motion) {
        refresh_moving();
    }
    return change.of_place;
}

const ThinPanel* Walls::find_panel(std::size_t object) const {
    return panel_of_[object] == kNoPanel ? nullptr : &panels_[panel_of_[object]].shape;
}

// Does the dummy at x (in the domain) belong to its object there, as far as the moving objects tell, or those at rest?
bool Walls::is_active(const Dummy& dummy, const Vec3& x, bool among_moving) const {
    const WallObject& own = objects_[dummy.object];
    // Beyond a thin panel's opposite face any thick solid comes first; panels do not cut each other's sheets, since a
    // fluid particle sees those of the panel that the line to them enters first.
    const bool is_beyond = dummy.sheet != 0 && !own.holds(x);
    for (std::size_t k = 0; k < objects_.size(); ++k) {
        if (k == dummy.object || objects_[k].is_moving() != among_moving) continue;
        if (dummy.sheet != 0 && find_panel(k)) continue;
        if ((is_beyond || k < dummy.object) && objects_[k].holds(x)) return false;
    }
    if (dummy.sheet != 0 || !space_.domain.has_periodic_axis()) return true;
    // Where a container nearly fills the period, what is solid behind one wall may be fluid or the other wall's solid
    // a period away: it belongs to the nearest surface.
    return own.surface(x).distance <= 1e-9 * spacing_ - dummy.depth;
}

// What rests in the solid of an earlier object at rest, or out of the domain, never becomes active.
void Walls::drop_hidden_for_good() {
    std::vector<char> is_hidden(dummies_.size(), 0);
    parallel_for(dummies_.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t id = begin; id < end; ++id) {
            const WallObject& own = objects_[dummies_[id].object];
            if (own.is_moving()) continue;
            Vec3 x = own.place(dummies_[id]);
            is_hidden[id] = !own.bring_into_domain(x) || !is_active(dummies_[id], x, false);
        }
    });
    std::size_t kept = 0;
    for (std::size_t id = 0; id < dummies_.size(); ++id) {
        if (!is_hidden[id]) dummies_[kept++] = dummies_[id];
    }
    dummies_.resize(kept);
    dummies_.shrink_to_fit();
}

// Dummies that move, and those that a moving object can hide.
void Walls::list_changeable() {
    changeable_.clear();
    for (std::size_t id = 0; id < dummies_.size(); ++id) {
        const Dummy& dummy = dummies_[id];
        const std::size_t hiding = dummy.sheet != 0 ? objects_.size() : dummy.object + std::size_t{1};
        const bool is_changeable = std::any_of(objects_.begin(), objects_.begin() + static_cast<std::ptrdiff_t>(hiding),
                                               [](const WallObject& object) { return object.is_moving(); });
        if (is_changeable) changeable_.push_back(static_cast<Index>(id));
    }
}

// Finds out where the changeable dummies are now and which of them are active. True when any became so or ceased to.
bool Walls::update_places() {
    const auto update = [&](std::size_t begin, std::size_t end) {
        bool has_changed = false;
        for (std::size_t k = begin; k < end; ++k) {
            const Index id = changeable_[k];
            const Dummy& dummy = dummies_[id];
            const WallObject& own = objects_[dummy.object];
            Vec3 x = own.place(dummy);
            bool is_here = own.bring_into_domain(x) && is_active(dummy, x, true);
            if (is_here && own.is_moving()) is_here = is_active(dummy, x, false);
            has_changed |= is_here != (active_[id] != 0);
            place_[id] = x;
            active_[id] = is_here;
        }
        return has_changed;
    };
    return parallel_reduce(changeable_.size(), false, update, [](bool a, bool b) { return a || b; });
}

// Lists the active dummies in the order of their ids.
void Walls::collect() {
    ++version_;
    particles_.id.clear();
    for (std::size_t id = 0; id < dummies_.size(); ++id) {
        if (active_[id]) particles_.id.push_back(static_cast<Index>(id));
    }
    const std::size_t count = particles_.id.size();
    particles_.object.resize(count);
    particles_.sheet.resize(has_thin() ? count : 0);
    particles_.V.resize(count);
    particles_.depth.resize(count);
    const std::size_t moving = has_moving() ? count : 0;
    for (int axis = 0; axis < dimensions_; ++axis) {
        particles_.x[axis].resize(count);
        particles_.n[axis].resize(count);
        particles_.v[axis].resize(moving);
        particles_.a[axis].resize(moving);
    }
    parallel_for(count, kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t slot = begin; slot < end; ++slot) place(slot, dummies_[particles_.id[slot]]);
    });
}

void Walls::place(std::size_t slot, const Dummy& dummy) {
    const WallObject& own = objects_[dummy.object];
    particles_.object[slot] = dummy.object;
    if (!particles_.sheet.empty()) particles_.sheet[slot] = dummy.sheet;
    particles_.V[slot] = dummy.V;
    particles_.depth[slot] = static_cast<float>(dummy.depth);
    const Vec3 normal = own.turn(dummy.n);
    set(particles_.x, dimensions_, slot, place_[particles_.id[slot]]);
    set(particles_.n, dimensions_, slot, normal);
    if (particles_.v[0].empty()) return;
    const Vec3 image = own.place(dummy);
    set(particles_.v, dimensions_, slot, own.velocity(image, normal));
    set(particles_.a, dimensions_, slot, own.acceleration(image));
}

void Walls::refresh_moving() {
    parallel_for(particles_.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t slot = begin; slot < end; ++slot) {
            const Dummy& dummy = dummies_[particles_.id[slot]];
            if (objects_[dummy.object].is_moving()) place(slot, dummy);
        }
    });
}

bool Walls::has_moving() const {
    return std::any_of(objects_.begin(), objects_.end(), [](const WallObject& object) { return object.is_moving(); });
}

bool Walls::has_thin() const {
    return !panels_.empty();
}

double Walls::distance(std::size_t object, const Vec3& x, Vec3* normal) const {
    const SurfacePoint surface = objects_[object].surface(x);
    if (normal) *normal = surface.normal;
    return surface.distance;
}

double Walls::distance_to_any(const Vec3& x, std::size_t* object, Vec3* normal) const {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < objects_.size(); ++k) {
        const SurfacePoint surface = objects_[k].surface(x);
        if (!(surface.distance < smallest)) continue;
        smallest = surface.distance;
        if (object) *object = k;
        if (normal) *normal = surface.normal;
    }
    return smallest;
}

Vec3 Walls::velocity(std::size_t object, const Vec3& x) const {
    Vec3 image;
    const SurfacePoint surface = objects_[object].surface(x, &image);
    return objects_[object].velocity(image, surface.normal);
}

bool Walls::sees(const Vec3& x, std::size_t k) const {
    if (particles_.sheet.empty() || particles_.sheet[k] == 0) return true;
    const std::size_t object = particles_.object[k];
    const WallObject& own = objects_[object];
    const Dummy& dummy = dummies_[particles_.id[k]];

    // The line from x to the dummy must pass the sheet's own window ...
    const Vec3 x_k = position(particles_, k);
    const Vec3 to_x = rigid::minus(image_near(space_.domain, dimensions_, x_k, x), x_k);
    const Vec3 here = own.place(dummy);
    const auto entry = find_panel(object)->enter(own.to_body(rigid::plus(here, to_x)), own.to_body(here));
    if (!entry || static_cast<Index>(entry->face + 1) != dummy.sheet) return false;

    // ... before it enters any other panel.
    for (const Panel& other : panels_) {
        if (other.object == object) continue;
        const WallObject& wall = objects_[other.object];
        const Vec3 from = wall.nearest_image(x), to = rigid::minus(from, to_x);
        const auto before = other.shape.enter(wall.to_body(from), wall.to_body(to));
        if (!before) continue;
        if (before->t < entry->t - kAtOnce) return false;
        if (before->t < entry->t + kAtOnce && other.object < object) return false;
    }
    return true;
}

bool Walls::is_blocked(const Vec3& x_i, const Vec3& x_j) const {
    for (const Panel& panel : panels_) {
        const WallObject& wall = objects_[panel.object];
        const Vec3 from = wall.nearest_image(x_i);
        const Vec3 to = rigid::plus(from, rigid::minus(image_near(space_.domain, dimensions_, x_i, x_j), x_i));
        if (panel.shape.blocks(wall.to_body(from), wall.to_body(to))) return true;
    }
    return false;
}

// A dummy stands at most the depth from its window, what it may meet at most another depth from it.
bool Walls::is_near_thin(const Vec3& x, double reach) const {
    for (const Panel& panel : panels_) {
        const WallObject& wall = objects_[panel.object];
        if (panel.shape.distance(wall.to_body(wall.nearest_image(x))) < reach + 2.0 * depth_) return true;
    }
    return false;
}

}  // namespace headrace::solver
