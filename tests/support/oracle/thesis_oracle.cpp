#include "tests/support/oracle/thesis_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace headrace::oracle {

namespace {

constexpr double kPi = std::numbers::pi;

Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 operator*(double s, const Vec3& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double norm(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

// Eq. 2.38-2.41
std::optional<Contact> find_sphere_contact(const solver::Sphere& sphere, solver::Role role, const Vec3& x) {
    const Vec3 from_centre = x - sphere.center;
    const double distance = norm(from_centre);
    const double F = distance * distance - sphere.radius * sphere.radius;
    const bool is_hit = role == solver::Role::container ? F > 0.0 : F < 0.0;
    if (!is_hit || distance == 0.0) return std::nullopt;  // at the centre there is no normal

    Contact contact;
    contact.cp = sphere.center + (sphere.radius / distance) * from_centre;
    contact.d = std::abs(distance - sphere.radius);
    contact.n = ((F > 0.0 ? -1.0 : 1.0) / distance) * from_centre;
    return contact;
}

// Eq. 2.42-2.47, for axis-aligned boxes
std::optional<Contact> find_container_contact(const solver::Box& box, const Vec3& x, int dimensions) {
    const Vec3 x_local = x - box.center;
    Vec3 cp_local = x_local;
    double F = -std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < dimensions; ++axis) {
        const double ext = box.half_extent[axis];
        F = std::max(F, std::abs(x_local[axis]) - ext);
        cp_local[axis] = std::min(ext, std::max(-ext, x_local[axis]));
    }
    if (F <= 0.0) return std::nullopt;

    Contact contact;
    contact.cp = box.center + cp_local;
    contact.d = norm(cp_local - x_local);
    contact.n = (1.0 / contact.d) * (cp_local - x_local);
    return contact;
}

Contact contact_on_face(const solver::Box& box, const Vec3& x, int axis, double side) {
    Contact contact;
    contact.cp = x;
    contact.cp[axis] = box.center[axis] + side * box.half_extent[axis];
    contact.d = std::abs(contact.cp[axis] - x[axis]);
    contact.n[axis] = side;
    return contact;
}

bool is_inside(const solver::Box& box, const Vec3& x, int dimensions) {
    for (int axis = 0; axis < dimensions; ++axis)
        if (std::abs(x[axis] - box.center[axis]) >= box.half_extent[axis]) return false;
    return true;
}

// The face nearest to a point inside the box.
Contact nearest_face_contact(const solver::Box& box, const Vec3& x, int dimensions) {
    std::optional<Contact> nearest;
    for (int axis = 0; axis < dimensions; ++axis) {
        const double side = x[axis] < box.center[axis] ? -1.0 : 1.0;
        const Contact contact = contact_on_face(box, x, axis, side);
        if (!nearest || contact.d < nearest->d) nearest = contact;
    }
    return *nearest;
}

// The path from + s (to - from), 0 <= s <= 1, is inside the slab of an axis between s_in and s_out; it is inside the
// box from the largest s_in to the smallest s_out. The axis entered last is that of the face.
std::optional<Contact> find_obstacle_contact(const solver::Box& box, const Vec3& from, const Vec3& to, int dimensions) {
    if (is_inside(box, from, dimensions)) {
        if (!is_inside(box, to, dimensions)) return std::nullopt;
        return nearest_face_contact(box, to, dimensions);
    }
    double s_enter = -std::numeric_limits<double>::infinity();
    double s_leave = std::numeric_limits<double>::infinity();
    int entered_axis = 0;
    for (int axis = 0; axis < dimensions; ++axis) {
        const double ext = box.half_extent[axis];
        const double start = from[axis] - box.center[axis];
        const double way = to[axis] - from[axis];
        if (way == 0.0) {
            if (std::abs(start) >= ext) return std::nullopt;
            continue;
        }
        const double side = way > 0.0 ? -1.0 : 1.0;
        const double s_in = (side * ext - start) / way;
        if (s_in > s_enter) {
            s_enter = s_in;
            entered_axis = axis;
        }
        s_leave = std::min(s_leave, (-side * ext - start) / way);
    }
    if (s_enter >= s_leave || s_enter >= 1.0 || s_leave <= 0.0) return std::nullopt;
    return contact_on_face(box, to, entered_axis, to[entered_axis] > from[entered_axis] ? -1.0 : 1.0);
}

// Section 3.3.5: boxes, then spheres. Among the boxes containers come first: an obstacle judges the path inside them.
int order_of(const solver::CollisionObject& object) {
    if (std::holds_alternative<solver::Sphere>(object.shape)) return 2;
    return object.role == solver::Role::container ? 0 : 1;
}

}  // namespace

Kernels::Kernels(int dimensions, double h) : dimensions_(dimensions), h_(h) {
    if (dimensions == 3) {
        poly6_ = 315.0 / (64.0 * kPi * std::pow(h, 9));            // C.1
        poly6_gradient_ = -945.0 / (32.0 * kPi * std::pow(h, 9));  // C.2, also of C.3
        spiky_gradient_ = -45.0 / (kPi * std::pow(h, 6));          // C.5
        viscosity_laplacian_ = 45.0 / (kPi * std::pow(h, 6));      // C.9
    } else {
        poly6_ = 4.0 / (kPi * std::pow(h, 8));
        poly6_gradient_ = -24.0 / (kPi * std::pow(h, 8));
        spiky_gradient_ = -30.0 / (kPi * std::pow(h, 5));
        viscosity_laplacian_ = 40.0 / (kPi * std::pow(h, 5));
    }
}

double Kernels::poly6(double r) const {
    const double q = h_ * h_ - r * r;
    return poly6_ * q * q * q;
}

double Kernels::poly6_gradient(double r) const {
    const double q = h_ * h_ - r * r;
    return poly6_gradient_ * q * q;
}

// W = c q^3 with q = h^2 - r^2: W'' + (dimensions - 1)/r W' = -6 c q (dimensions q - 4 r^2)
double Kernels::poly6_laplacian(double r) const {
    const double q = h_ * h_ - r * r;
    return -6.0 * poly6_ * q * (dimensions_ * q - 4.0 * r * r);
}

double Kernels::spiky_gradient(double r) const {
    return spiky_gradient_ * (h_ - r) * (h_ - r);
}

double Kernels::viscosity_laplacian(double r) const {
    return viscosity_laplacian_ * (h_ - r);
}

std::optional<Contact> find_contact(const solver::CollisionObject& object, const Vec3& from, const Vec3& to,
                                    int dimensions) {
    if (const auto* sphere = std::get_if<solver::Sphere>(&object.shape))
        return find_sphere_contact(*sphere, object.role, to);
    const solver::Box& box = std::get<solver::Box>(object.shape);
    if (object.role == solver::Role::container) return find_container_contact(box, to, dimensions);
    return find_obstacle_contact(box, from, to, dimensions);
}

ThesisOracle::ThesisOracle(int dimensions, const ThesisParameters& parameters,
                           std::vector<solver::CollisionObject> objects)
    : dimensions_(dimensions),
      parameters_(parameters),
      kernels_(dimensions, parameters.h),
      objects_(std::move(objects)) {
    std::stable_sort(objects_.begin(), objects_.end(),
                     [](const auto& a, const auto& b) { return order_of(a) < order_of(b); });
}

void ThesisOracle::add_particle(const Vec3& x, const Vec3& v) {
    Particle particle;
    particle.x = x;
    particle.v = v;
    particles_.push_back(particle);
}

void ThesisOracle::initialise() {
    compute_density();
    compute_pressure();
    compute_acceleration();
    for (Particle& i : particles_) i.v_half = i.v - (0.5 * parameters_.dt) * i.a;  // Eq. 2.35
}

void ThesisOracle::step() {
    compute_density();
    compute_pressure();
    compute_acceleration();
    const double dt = parameters_.dt;
    for (Particle& i : particles_) {
        const Vec3 x_before = i.x;
        const Vec3 v_half_before = i.v_half;
        i.v_half = i.v_half + dt * i.a;  // Eq. 2.33
        i.x = i.x + dt * i.v_half;       // Eq. 2.34
        collide(i, x_before);
        i.v = 0.5 * (v_half_before + i.v_half);  // Eq. 2.36
    }
}

// Eq. 2.17
void ThesisOracle::compute_density() {
    for (Particle& i : particles_) {
        i.rho = 0.0;
        for (const Particle& j : particles_) {
            const double r = norm(i.x - j.x);
            if (r < parameters_.h) i.rho += parameters_.m * kernels_.poly6(r);
        }
    }
}

// Eq. 2.19
void ThesisOracle::compute_pressure() {
    for (Particle& i : particles_) i.p = parameters_.k * (i.rho - parameters_.rho0);
}

// Eq. 2.16 and 2.32; gravity enters as the acceleration g (Eq. 2.26)
void ThesisOracle::compute_acceleration() {
    for (std::size_t i = 0; i < particles_.size(); ++i)
        particles_[i].a = (1.0 / particles_[i].rho) * compute_force(i) + parameters_.g;
}

Vec3 ThesisOracle::compute_force(std::size_t index) const {
    const Particle& i = particles_[index];
    const double m = parameters_.m;
    Vec3 f_pressure{}, f_viscosity{}, f_surface{};
    Vec3 normal{};
    double laplacian_c = 0.0;
    for (std::size_t other = 0; other < particles_.size(); ++other) {
        const Particle& j = particles_[other];
        const Vec3 x_ij = i.x - j.x;
        const double r = norm(x_ij);
        if (r >= parameters_.h) continue;

        normal = normal + (m / j.rho * kernels_.poly6_gradient(r)) * x_ij;  // Eq. 2.28
        laplacian_c += m / j.rho * kernels_.poly6_laplacian(r);             // of Eq. 2.27
        if (other == index) continue;

        f_viscosity =
            f_viscosity + (parameters_.mu * m / j.rho * kernels_.viscosity_laplacian(r)) * (j.v - i.v);  // 2.25
        if (r == 0.0) continue;  // superposed particles have no direction to repel each other in
        const Vec3 gradient = (kernels_.spiky_gradient(r) / r) * x_ij;
        const double weight = parameters_.pressure_form == PressureForm::averaged
                                  ? 0.5 * (i.p + j.p) * m / j.rho                                 // 2.22
                                  : i.rho * (i.p / (i.rho * i.rho) + j.p / (j.rho * j.rho)) * m;  // 2.21
        f_pressure = f_pressure - weight * gradient;
    }
    const double length = norm(normal);
    if (length >= parameters_.l) f_surface = (-parameters_.sigma * laplacian_c / length) * normal;  // Eq. 2.30, 2.31
    return f_pressure + f_viscosity + f_surface;
}

// Differs from the thesis, which has a single obstacle: what an obstacle pushes out of a container is put back, so the
// containers act once more after it.
void ThesisOracle::collide(Particle& particle, const Vec3& from) const {
    bool is_moved_by_obstacle = false;
    for (const solver::CollisionObject& object : objects_)
        if (respond(particle, object, from) && object.role == solver::Role::obstacle) is_moved_by_obstacle = true;
    if (!is_moved_by_obstacle) return;
    for (const solver::CollisionObject& object : objects_)
        if (object.role == solver::Role::container) respond(particle, object, from);
}

bool ThesisOracle::respond(Particle& particle, const solver::CollisionObject& object, const Vec3& from) const {
    const std::optional<Contact> contact = find_contact(object, from, particle.x, dimensions_);
    if (!contact) return false;
    particle.x = contact->cp;  // Eq. 2.48
    const double speed = norm(particle.v_half);
    if (speed == 0.0) return true;
    const double reflected = 1.0 + parameters_.c_R * contact->d / (parameters_.dt * speed);
    particle.v_half = particle.v_half - (reflected * dot(particle.v_half, contact->n)) * contact->n;  // Eq. 2.51
    return true;
}

}  // namespace headrace::oracle
