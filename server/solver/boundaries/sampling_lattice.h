// Parts that the sampling of all primitives shares: lattices along one axis, and the list of dummies.
#pragma once

#include <array>
#include <vector>

#include "server/solver/boundaries/wall_sampling.h"

namespace headrace::solver {

// A cell of a lattice along one axis.
struct Slot {
    double x{};       // [m] its middle
    double width{};   // [m]
    bool is_solid{};  // in the solid layer as far as this axis tells
};

struct Bounds {
    double low{};   // [m]
    double high{};  // [m]
};

// The whole number of steps that fits the length best, at least one; 1 where the step is 0.
double whole_number(double length, double step);

// Appends the cells at origin + (i + 1/2) step, 0 <= i < count, whose middle lies within the bounds.
void append_slots(double origin, double step, double count, const Bounds& bounds, bool is_solid,
                  std::vector<Slot>& slots);

// Between two faces and, of a container, beyond them. Solid: a container's cells beyond, an obstacle's outer ones.
std::vector<Slot> slots_across(double min, double max, bool is_container, const SamplingSpace& space,
                               const Bounds& bounds);

// One period of the domain; not solid.
std::vector<Slot> slots_along_period(const SamplingSpace& space, int axis);

// Appends unless the volume is 0 or the place out of bounds. The normal is that of the nearest surface.
void append_dummy(const Body& body, const SamplingSpace& space, const Vec3& X, double V, Index object,
                  std::vector<Dummy>& dummies);

// The same with a normal and a thin panel's face.
void append_dummy(const SamplingSpace& space, const Dummy& dummy, std::vector<Dummy>& dummies);

// Throws std::length_error where `count` cells are more than any scene may have.
void check_wall_count(double count);

// How many triples of cells have at least one solid cell.
double count_solid(const std::array<std::vector<Slot>, 3>& axes);

// visit(a, b, c) for each of these triples, x fastest. Throws std::length_error where they are too many.
template <class Visit>
void for_each_solid(const std::array<std::vector<Slot>, 3>& axes, Visit&& visit) {
    check_wall_count(count_solid(axes));
    std::vector<Slot> solid;
    for (const Slot& a : axes[0]) {
        if (a.is_solid) solid.push_back(a);
    }
    for (const Slot& c : axes[2]) {
        for (const Slot& b : axes[1]) {
            for (const Slot& a : b.is_solid || c.is_solid ? axes[0] : solid) visit(a, b, c);
        }
    }
}

}  // namespace headrace::solver
