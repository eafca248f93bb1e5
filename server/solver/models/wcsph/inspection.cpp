#include "server/solver/models/wcsph/inspection.h"

#include <algorithm>
#include <cmath>

namespace headrace::solver {
namespace {

Vec3 place_of(const VectorField& x, int dimensions, std::size_t i) {
    Vec3 place{};
    for (int k = 0; k < dimensions; ++k) place[k] = x[k][i];
    return place;
}

// The image of y nearest to x.
Vec3 nearest_image(const Domain& domain, int dimensions, const Vec3& x, Vec3 y) {
    for (int k = 0; k < dimensions; ++k) {
        if (!domain.periodic[k]) continue;
        const double length = domain.max[k] - domain.min[k];
        y[k] += length * std::round((x[k] - y[k]) / length);
    }
    return y;
}

// Terms of one particle, in the order of the report; 3D vectors, so that one code reports both dimensions.
struct TermSums {
    Vec3 gravity{}, body_force{}, pressure{}, wall_pressure{}, artificial_viscosity{}, viscosity{}, wall_viscosity{};
    Vec3 surface_tension{};
};

template <std::size_t D>
void add(Vec3& sum, const std::array<double, D>& a) {
    for (std::size_t k = 0; k < D; ++k) sum[k] += a[k];
}

// Surface tension looks at the neighbours' neighbours: particles and dummies within twice the support.
template <int D>
class TensionTerm {
  public:
    using Vector = std::array<double, D>;

    TensionTerm(const InspectionInput& in, Index i, const Vec3& x_i) : in_(in), rho_(in.view.particles.rho[i]) {
        centre_ = add_point(x_i, in.view.volume(i), std::nullopt);
        for (Index j = 0; j < in.view.particles.size(); ++j) {
            const Vec3 y = nearest_image(in.surroundings.domain, D, x_i, place_of(in.view.particles.x, D, j));
            if (j != i && is_within(x_i, y, 2.0 * in.support)) add_point(y, in.view.volume(j), std::nullopt);
        }
        for (Index w = 0; w < in.view.walls.size(); ++w) {
            const Vec3 y = nearest_image(in.surroundings.domain, D, x_i, place_of(in.view.walls.x, D, w));
            if (is_within(x_i, y, 2.0 * in.support)) add_point(y, in.view.walls.V[w], w);
        }
    }

    Vector acceleration() const { return in_.options.is_continuum ? continuum_acceleration() : thesis_acceleration(); }

  private:
    struct Point {
        Vec3 x{};
        double V{};
        std::optional<Index> wall;  // the dummy it is
    };

    static bool is_within(const Vec3& x, const Vec3& y, double reach) {
        double r2 = 0.0;
        for (int k = 0; k < D; ++k) r2 += (x[k] - y[k]) * (x[k] - y[k]);
        return r2 < reach * reach;
    }

    std::size_t add_point(const Vec3& x, double V, std::optional<Index> wall) {
        points_.push_back({x, V, wall});
        return points_.size() - 1;
    }

    // visit(point, pair) for all that the fluid particle at `from` sees, itself included.
    template <class Visit>
    void for_each_seen(const Point& from, Visit&& visit) const {
        for (const Point& to : points_) {
            if (!is_within(from.x, to.x, in_.support)) continue;
            if (in_.thin_walls != nullptr &&
                (to.wall ? !in_.thin_walls->sees(from.x, *to.wall) : in_.thin_walls->is_blocked(from.x, to.x)))
                continue;
            Vector x_ij;
            for (int k = 0; k < D; ++k) x_ij[k] = from.x[k] - to.x[k];
            visit(to, make_pair_of<D>(x_ij, to.V));
        }
    }

    Vector gradient_at(const Point& from) const {
        Vector n{};
        for_each_seen(from, [&](const Point&, const Pair<D, double>& pair) {
            add_to<D, double>(n, scaled<D, double>(pair.V_j * in_.sums.F(pair.r), pair.x_ij));
        });
        return n;
    }

    Symmetric<D> stress_at(const Point& from) const {
        double c = 0.0;
        for_each_seen(from, [&](const Point&, const Pair<D, double>& pair) { c += pair.V_j * in_.sums.W(pair.r); });
        return surface_stress<D>(gradient_at(from), c, in_.options.tension.flat.n);
    }

    Vector continuum_acceleration() const {
        const TensionOptions& tension = in_.options.tension;
        const TensionKernel<D> kernel(in_.support);
        const Symmetric<D> S_i = stress_at(points_[centre_]);
        Vector f{};
        for_each_seen(points_[centre_], [&](const Point& to, const Pair<D, double>& pair) {
            Symmetric<D> S = to.wall ? S_i : stress_at(to);
            for (int k = 0; k < Symmetric<D>::kSize; ++k) S.e[k] += S_i.e[k];
            add_to<D, double>(f, S * scaled<D, double>(pair.V_j * kernel.F(pair.r2), pair.x_ij));
        });
        return scaled<D, double>(2.0 * tension.sigma / (tension.flat.C * rho_), f);
    }

    Vector thesis_acceleration() const {
        const TensionOptions& tension = in_.options.tension;
        const Vector n = gradient_at(points_[centre_]);
        double laplacian_c = 0.0;
        for_each_seen(points_[centre_], [&](const Point&, const Pair<D, double>& pair) {
            laplacian_c += pair.V_j * (D * in_.sums.F(pair.r) + pair.r * in_.sums.dF_dr(pair.r));
        });
        const double factor =
            tension_factor(tension.sigma, laplacian_c, dot<D, double>(n, n), tension.threshold) / rho_;
        return scaled<D, double>(factor, n);
    }

    const InspectionInput& in_;
    double rho_;  // [kg/m^3]
    std::vector<Point> points_;
    std::size_t centre_{};
};

template <int D>
class Inspector {
  public:
    Inspector(const InspectionInput& in, Index i)
        : in_(in), i_(i), x_(place_of(in.view.particles.x, D, i)), terms_(in.view, in.options) {}

    ParticleInspection inspect() {
        const Particles& particles = in_.view.particles;
        report_.id = particles.id[i_];
        report_.x = x_;
        report_.v = place_of(particles.v, D, i_);
        report_.rho = particles.rho[i_];
        report_.p = particles.p[i_];
        report_.min_eigenvalue = static_cast<double>(in_.view.state.min_eigenvalue[i_]);
        report_.concentration = in_.view.volume(i_) * in_.sums.W(0.0);
        for (Index j = 0; j < particles.size(); ++j) look_at_fluid(j);
        for (Index w = 0; w < in_.view.walls.size(); ++w) look_at_wall(w);
        look_at_solids();
        std::stable_sort(report_.neighbours.begin(), report_.neighbours.end(),
                         [](const auto& one, const auto& other) { return one.distance < other.distance; });
        sums_.gravity = in_.gravity;
        if (D == 2) sums_.gravity[2] = 0.0;
        find_body_force();
        if (in_.options.tension.sigma > 0.0) add(sums_.surface_tension, TensionTerm<D>(in_, i_, x_).acceleration());
        report_terms();
        return std::move(report_);
    }

  private:
    std::optional<Pair<D, double>> pair_with(const Vec3& y, double V) const {
        std::array<double, D> x_ij;
        for (int k = 0; k < D; ++k) x_ij[k] = x_[k] - y[k];
        const Pair<D, double> pair = make_pair_of<D>(x_ij, V);
        if (pair.r >= in_.support) return std::nullopt;
        return pair;
    }

    void look_at_fluid(Index j) {
        if (j == i_) return;
        const Vec3 y = nearest_image(in_.surroundings.domain, D, x_, place_of(in_.view.particles.x, D, j));
        const auto pair = pair_with(y, in_.view.volume(j));
        if (!pair || (in_.thin_walls != nullptr && in_.thin_walls->is_blocked(x_, y))) return;
        note_neighbour(in_.view.particles.id[j], {}, *pair);
        const double F = in_.sums.F(pair->r);
        add(sums_.pressure, terms_.pressure(i_, j, *pair, F));
        terms_.accumulate_pressure(j, *pair, F, of_fluid_);
        if (in_.options.pressure.artificial_viscosity > 0.0) {
            const std::array<double, D> artificial = terms_.artificial_viscosity(i_, j, *pair, F);
            add(sums_.artificial_viscosity, artificial);
            // In the adjoint form the pass sums it with the pressure.
            if (in_.options.is_adjoint)
                add_to<D, double>(of_fluid_.pB_grad, scaled<D, double>(-in_.view.particles.rho[i_], artificial));
        }
        if (in_.options.viscosity.mu > 0.0) add(sums_.viscosity, terms_.viscosity(i_, j, *pair, F));
    }

    void look_at_wall(Index w) {
        const WallParticles& walls = in_.view.walls;
        const Vec3 y = nearest_image(in_.surroundings.domain, D, x_, place_of(walls.x, D, w));
        const auto pair = pair_with(y, walls.V[w]);
        if (!pair || (in_.thin_walls != nullptr && !in_.thin_walls->sees(x_, w))) return;
        note_neighbour(std::nullopt, in_.wall_names[walls.object[w]], *pair);
        const double F = in_.sums.F(pair->r);
        add(sums_.wall_pressure, terms_.wall_pressure(i_, w, *pair, F));
        if (in_.options.viscosity.mu > 0.0) add(sums_.wall_viscosity, terms_.wall_viscosity(i_, w, *pair, F));
    }

    // Walls without particles: a neighbour each, at its distance and with its weight.
    void look_at_solids() {
        const std::array<double, D> x = vector_at<D>(in_.view.particles.x, i_);
        if (!in_.view.solid.is_near(x)) return;
        WallShare<D> share;
        in_.view.solid.walls->find_share<D>(x, in_.options.viscosity.least_distance, share);
        for (int a = 0; a < share.count; ++a) {
            const WallPart<D>& part = share.part[a];
            report_.concentration += part.gamma;
            report_.neighbours.push_back(
                {std::nullopt, in_.wall_names[part.surface->object], std::max(part.distance, 0.0), part.gamma});
        }
        PressureSums<D, double> walls;
        add_solid_pressure<D>(in_.view.solid, in_.view.particles, i_, of_fluid_, terms_.own_pressure_of(i_, of_fluid_),
                              walls);
        add(sums_.wall_pressure, terms_.wall_pressure(i_, walls));
        if (in_.options.viscosity.mu > 0.0) {
            terms_.for_each_solid_viscosity(
                i_, [&](std::size_t, const std::array<double, D>& a) { add(sums_.wall_viscosity, a); });
        }
    }

    void note_neighbour(std::optional<Index> id, const std::string& object, const Pair<D, double>& pair) {
        const double weight = pair.V_j * in_.sums.W(pair.r);
        report_.concentration += weight;
        report_.neighbours.push_back({id, object, pair.r, weight});
    }

    void find_body_force() {
        if (in_.surroundings.body_force == nullptr) return;
        Particles alone;
        alone.dimensions = D;
        alone.resize(1);
        VectorField a;
        for (int k = 0; k < D; ++k) {
            alone.x[k][0] = x_[k];
            alone.v[k][0] = report_.v[k];
            a[k].assign(1, 0.0);
        }
        (*in_.surroundings.body_force)(in_.surroundings.time, alone, a);
        for (int k = 0; k < D; ++k) sums_.body_force[k] = a[k][0];
    }

    // Terms the scene does not have are left out.
    void report_terms() {
        const auto report = [&](const char* name, const Vec3& a, bool is_present) {
            if (!is_present) return;
            report_.terms.push_back({name, a});
            for (int k = 0; k < 3; ++k) report_.a[k] += a[k];
        };
        const bool has_walls = in_.view.walls.size() > 0 || in_.view.solid.walls != nullptr,
                   is_viscous = in_.options.viscosity.mu > 0.0;
        report("pressure", sums_.pressure, true);
        report("wall_pressure", sums_.wall_pressure, has_walls);
        report("artificial_viscosity", sums_.artificial_viscosity, in_.options.pressure.artificial_viscosity > 0.0);
        report("viscosity", sums_.viscosity, is_viscous);
        report("wall_viscosity", sums_.wall_viscosity, is_viscous && has_walls);
        report("surface_tension", sums_.surface_tension, in_.options.tension.sigma > 0.0);
        report("gravity", sums_.gravity, in_.gravity != Vec3{});
        report("body_force", sums_.body_force, in_.surroundings.body_force != nullptr);
    }

    const InspectionInput& in_;
    Index i_;
    Vec3 x_;
    PairTerms<D> terms_;
    TermSums sums_;
    PressureSums<D, double> of_fluid_;  // as the pressure pass sums them
    ParticleInspection report_;
};

}  // namespace

std::optional<ParticleInspection> inspect_particle(const InspectionInput& in, Index id) {
    const std::vector<Index>& ids = in.view.particles.id;
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found == ids.end()) return std::nullopt;
    const auto i = static_cast<Index>(found - ids.begin());
    return in.view.particles.dimensions == 2 ? Inspector<2>(in, i).inspect() : Inspector<3>(in, i).inspect();
}

}  // namespace headrace::solver
