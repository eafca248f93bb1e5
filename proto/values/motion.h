// Where a moving object is: its prescribed motion as a function of the absolute simulated time, for the server, which
// moves walls by it, and for clients, which draw them.
//
// The motion is told relative to the object's place in the document: turned about the pivot, then displaced.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "proto/values/curves.h"

namespace headrace::scene {

// R, row by row.
using Rotation = std::array<double, 9>;
inline constexpr Rotation kUnturned{1, 0, 0, 0, 1, 0, 0, 0, 1};

// Turn by `angle` [rad] about the unit vector n (Rodrigues' formula).
Rotation rotation(double angle, const proto::Vec3& n);

// A point X of the object as the document has it is at pivot + translation + R (X - pivot).
struct Placement {
    proto::Vec3 pivot{};        // [m]
    proto::Vec3 translation{};  // [m]
    Rotation turn{kUnturned};

    bool operator==(const Placement&) const = default;
    bool is_turned() const { return turn != kUnturned; }
    bool is_finite() const;
    proto::Vec3 operator()(const proto::Vec3& X) const;
    proto::Vec3 turned(const proto::Vec3& direction) const;  // R direction
};

// Safe from any thread.
struct Motion {
    std::array<Curve, 3> displacement;  // [m]
    std::optional<Curve> angle;         // [rad] absent: it does not turn
    proto::Vec3 pivot{};                // [m]
    proto::Vec3 axis{0.0, 0.0, 1.0};    // unit vector

    // Errors: scene_invalid below `path` for bad expressions and tables, and for a pivot or an axis that is none.
    static proto::Result<Motion> make(const proto::MotionDesc& desc, int dimensions, double spacing,
                                      const std::string& path);

    Placement at(double t) const;
};

// The objects of a document, any of which may move.
class MovingObjects {
  public:
    // Errors: those of Motion::make, below objects[k].motion.
    static proto::Result<MovingObjects> make(const std::vector<proto::ObjectDesc>& objects, int dimensions,
                                             double spacing);

    // One per object, in their order. What an expression does not say at t (not a number) is taken as no motion.
    std::vector<Placement> at(double t) const;

  private:
    std::vector<std::optional<Motion>> motions_;
};

}  // namespace headrace::scene
