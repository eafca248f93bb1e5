#include "server/solver/models/wcsph/wall_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/solver/forces/separation.h"
#include "server/solver/parallel.h"

namespace headrace::solver {

namespace {

// Where in the skin of a surface a particle is put: its own share of it for each of the surfaces that hold it, or all
// that are driven into a corner would coincide there for ever.
constexpr double kSurfaceSkin = 0.02;  // [spacings]
double skin_share(Index id, int turn) {
    return static_cast<double>(mix((std::uint64_t{id} << 2) | static_cast<std::uint64_t>(turn)) >> 11) * 0x1p-53;
}

std::vector<char> no_slip_of(std::span<const CollisionObject> objects, Slip by_model) {
    std::vector<char> no_slip;
    for (const CollisionObject& object : objects)
        no_slip.push_back((object.slip == Slip::by_model ? by_model : object.slip) == Slip::no_slip);
    return no_slip;
}

}  // namespace

WallField::WallField(int dimensions, double spacing, double support)
    : dimensions_(dimensions), spacing_(spacing), walls_(dimensions, spacing, support) {}

WallField::Change WallField::place(const Surroundings& surroundings, double t, bool anew, const WallOptions& options) {
    if (anew) place_integrals(surroundings, options);
    run_belts(surroundings, t);
    if (anew) {
        walls_.rebuild(surroundings.objects, surroundings.domain, t, choice_.is_integral);
    } else if (!walls_.move_to(t)) {
        return Change::none;
    }
    is_in_order_ = false;
    if (std::exchange(version_, walls_.version()) == walls_.version()) {
        evaluate_gravity(surroundings, t, options.gravity);
        return Change::moved;
    }
    const WallParticles& w = walls_.particles();
    const auto sticks = [&](const CollisionObject& object) {
        return (object.slip == Slip::by_model ? options.slip : object.slip) == Slip::no_slip;
    };
    state_.p.resize(w.size());
    state_.no_slip.clear();
    if (std::any_of(surroundings.objects.begin(), surroundings.objects.end(), sticks)) {
        state_.no_slip.resize(w.size());
        for (std::size_t k = 0; k < w.size(); ++k)
            state_.no_slip[k] = sticks(surroundings.objects[w.object[k]]) ? 1.0F : 0.0F;
    }
    evaluate_gravity(surroundings, t, options.gravity);
    return Change::others;
}

WallChoice WallField::choose(std::span<const CollisionObject> objects, const Domain& domain, int dimensions,
                             double support, const WallOptions& options) {
    if (options.integrals) return choose_integral_walls(objects, domain, dimensions, support);
    if (!options.by_default) return {std::vector<char>(objects.size(), 0), {}};
    return choose_walls_by_default(objects, domain, dimensions, support, no_slip_of(objects, options.slip));
}

void WallField::place_integrals(const Surroundings& surroundings, const WallOptions& options) {
    choice_ = choose(surroundings.objects, surroundings.domain, dimensions_, integrals_.support(), options);
    integrals_.clear();
    if (!options.integrals && !options.by_default) return;
    place_integral_walls(surroundings.objects, surroundings.domain, choice_.is_integral,
                         no_slip_of(surroundings.objects, options.slip), integrals_);
}

void WallField::run_belts(const Surroundings& surroundings, double t) {
    integrals_.for_each_surface([&](IntegralSurface& surface) {
        const CollisionObject& object = surroundings.objects[surface.object];
        if (object.motion) surface.v = object.motion(t).surface_velocity;
    });
}

bool WallField::put_in_order(const Domain& domain) {
    if (std::exchange(is_in_order_, true) || size() == 0) return false;
    WallParticles& w = walls_.particles();
    order_.build(w.x, w.id, dimensions_, spacing_, domain);
    const auto permute = [this](auto& values, auto& scratch) {
        if (!values.empty()) order_.permute(values, scratch);
    };
    std::vector<Index> id_scratch;
    std::vector<double> scratch;
    std::vector<float> narrow_scratch;
    for (std::vector<Index>* field : {&w.id, &w.object, &w.sheet}) permute(*field, id_scratch);
    for (VectorField* field : {&w.x, &w.v, &w.a, &state_.g})
        for (std::vector<double>& component : *field) permute(component, scratch);
    permute(w.V, scratch);
    for (std::vector<float>& component : w.n) permute(component, narrow_scratch);
    for (std::vector<float>* field : {&w.depth, &state_.no_slip, &state_.p}) permute(*field, narrow_scratch);
    order_.forget_moves();
    return true;
}

// What a fluid particle at the wall would feel, seen from the wall.
void WallField::evaluate_gravity(const Surroundings& surroundings, double t, const Vec3& gravity) {
    const WallParticles& w = walls_.particles();
    state_.g = {};
    if (surroundings.body_force == nullptr && w.a[0].empty()) return;
    for (int k = 0; k < dimensions_; ++k) state_.g[k].assign(w.size(), gravity[k]);
    if (surroundings.body_force != nullptr) {
        Particles there;
        there.dimensions = dimensions_;
        there.id = w.id;
        there.x = w.x;
        there.v = w.v;
        for (int k = 0; k < dimensions_; ++k) there.v[k].resize(w.size());
        (*surroundings.body_force)(t, there, state_.g);
    }
    if (w.a[0].empty()) return;
    for (int k = 0; k < dimensions_; ++k)
        for (std::size_t i = 0; i < w.size(); ++i) state_.g[k][i] -= w.a[k][i];
}

double WallField::max_speed() const {
    const WallParticles& w = walls_.particles();
    double v2_max = 0.0;
    for (std::size_t i = 0; i < w.v[0].size(); ++i) {  // none where all rest
        double v2 = 0.0;
        for (int k = 0; k < dimensions_; ++k) v2 += w.v[k][i] * w.v[k][i];
        v2_max = std::max(v2_max, v2);
    }
    integrals_.for_each_surface([&](const IntegralSurface& surface) {
        double v2 = 0.0;
        for (int k = 0; k < dimensions_; ++k) v2 += surface.v[k] * surface.v[k];
        v2_max = std::max(v2_max, v2);
    });
    return std::sqrt(v2_max);
}

OrderedPoints WallField::points() const {
    return {&order_, &walls_.particles().x, walls_.particles().V, walls_.particles().size()};
}

void WallField::stop_at(std::size_t object, const Vec3& n, const Vec3& x, Vec3& v) const {
    const Vec3 wall = walls_.velocity(object, x);
    double into = 0.0;
    for (int k = 0; k < dimensions_; ++k) into += (v[k] - wall[k]) * n[k];
    for (int k = 0; k < dimensions_; ++k) v[k] -= std::min(into, 0.0) * n[k];
}

// Looks around x, ever further, along the axes and the diagonals. Where solids lie on each other the nearest surface
// may be the seam between them: from one solid into the next and back, for ever.
bool WallField::find_free_place(Vec3& x) const {
    constexpr double kFirst = 0.0625, kLast = 8.0;  // [spacings]
    const int up = dimensions_ == 3 ? 1 : 0;
    for (double way = kFirst * spacing_; way <= kLast * spacing_; way *= 2.0) {
        for (int k = -up; k <= up; ++k) {
            for (int j = -1; j <= 1; ++j) {
                for (int i = -1; i <= 1; ++i) {
                    const Vec3 there{x[0] + i * way, x[1] + j * way, x[2] + k * way};
                    if (walls_.distance_to_any(there) <= 0.0) continue;
                    x = there;
                    return true;
                }
            }
        }
    }
    return false;
}

bool WallField::may_be_in_integrals(const Vec3& x) const {
    return dimensions_ == 2 ? integrals_.may_hold<2>({x[0], x[1]}) : integrals_.may_hold<3>({x[0], x[1], x[2]});
}

bool WallField::put_back(Index id, Vec3& x, Vec3& v, double dt) const {
    constexpr int kMostSurfaces = 4;  // a corner of three, and one more
    bool is_moved = false;
    if (walls_.has_thin()) {
        Vec3 before = x;
        for (int k = 0; k < dimensions_; ++k) before[k] -= dt * v[k];
        if (walls_.is_blocked(before, x)) {
            std::size_t object = 0;
            Vec3 n{};
            walls_.distance_to_any(before, &object, &n);
            x = before;
            stop_at(object, n, x, v);
            is_moved = true;
        }
    }
    const Vec3 inside = x;
    for (int turn = 0; turn <= kMostSurfaces; ++turn) {
        std::size_t object = 0;
        Vec3 n{};
        const double distance = walls_.distance_to_any(x, &object, &n);
        if (distance >= 0.0) break;
        if (turn == kMostSurfaces) {
            x = inside;
            find_free_place(x);
            for (int k = 0; k < dimensions_; ++k) v[k] = walls_.velocity(object, x)[k];
            break;
        }
        const double way = kSurfaceSkin * spacing_ * skin_share(id, turn) - distance;
        for (int k = 0; k < dimensions_; ++k) x[k] += way * n[k];
        stop_at(object, n, x, v);
        is_moved = true;
    }
    return is_moved;
}

std::uint64_t WallField::hold(Particles& particles, const PairNeighbours& neighbours, double dt) const {
    constexpr std::size_t kBlock = 256;
    if (is_empty()) return 0;
    const std::size_t clusters = (particles.size() + kClusterSize - 1) / kClusterSize;
    std::vector<std::uint64_t> counts((clusters + kBlock - 1) / kBlock);
    parallel_for(clusters, kBlock, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t c = first; c < last; ++c) {
            if (!neighbours.is_near_walls(c) && integrals_.is_empty()) continue;
            for (std::size_t i = c * kClusterSize; i < std::min((c + 1) * kClusterSize, particles.size()); ++i) {
                Vec3 x{}, v{};
                for (int k = 0; k < dimensions_; ++k) {
                    x[k] = particles.x[k][i];
                    v[k] = particles.v[k][i];
                }
                if (!neighbours.is_near_walls(c) && !may_be_in_integrals(x)) continue;
                if (!put_back(particles.id[i], x, v, dt)) continue;
                ++counts[first / kBlock];
                for (int k = 0; k < dimensions_; ++k) {
                    particles.x[k][i] = x[k];
                    particles.v[k][i] = v[k];
                }
            }
        }
    });
    std::uint64_t count = 0;
    for (const std::uint64_t part : counts) count += part;
    return count;
}

}  // namespace headrace::solver
