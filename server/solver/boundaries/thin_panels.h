// Thin panels: box obstacles thinner than twice the depth, which would be seen through, or whose dummies would mix the
// fluids of both sides.
//
// Each face is a window, and behind it lies a sheet: a lattice as deep as the support, going on beyond the opposite
// face and, sideways, beyond the rim. A straight line from the fluid enters the box by exactly one face, so a fluid
// particle sees a dummy where the line to it passes that dummy's window first, and another fluid particle where the
// line misses the box. What a particle sees therefore fills its support once, also around the rim.
#pragma once

#include <optional>
#include <vector>

#include "server/solver/boundaries/wall_sampling.h"

namespace headrace::solver {

struct ThinPanel {
    int dimensions{3};
    Vec3 low{};     // [m] faces in the body's frame; -infinity along endless axes
    Vec3 high{};    // [m]
    double edge{};  // [m] width of the rim that lines pass by

    struct Entry {
        double t{};  // along the line, 0 at its start to 1 at its end
        int face{};  // 2 axis + (1 on the high side)
    };
    // Where the line from -> to enters the box. A start inside the box counts as on the nearest face; a line that
    // touches an edge passes by.
    std::optional<Entry> enter(const Vec3& from, const Vec3& to) const;

    // Does the line pass through? Ends inside count as on the nearest face.
    bool blocks(const Vec3& a, const Vec3& b) const { return enter(a, push_out(b)).has_value(); }

    double distance(const Vec3& X) const;  // [m] to the box, 0 inside

  private:
    Vec3 push_out(const Vec3& X) const;
};

// Nothing for bodies that are not thin panels.
std::optional<ThinPanel> make_thin_panel(const Body& body, double depth);

// Appends the dummies of all sheets.
void sample_thin_panel(const Body& body, const SamplingSpace& space, Index object, std::vector<Dummy>& dummies);

}  // namespace headrace::solver
