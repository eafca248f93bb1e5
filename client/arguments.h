// Words of the command line as values. Errors are `usage`, with the word in the path and the form wanted in the hint.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/messages.h"
#include "proto/result.h"

namespace headrace::client {

proto::Error usage_error(std::string message, std::string path, std::string hint = {});

std::vector<std::string> split(std::string_view text, char separator);

// A whole word as a finite number: "0.5", "-9.8e3".
std::optional<double> parse_number(std::string_view word);
// "2", "2s": simulated seconds.
std::optional<double> parse_seconds(std::string_view word);
proto::Result<std::vector<double>> parse_numbers(std::string_view word, std::string_view option);
// Two or three numbers: "0,-9.8" or "0,-9.8,0".
proto::Result<proto::Vec3> parse_vector(std::string_view word, std::string_view option);

// "true", "false", a number, two or three numbers with commas, anything else as it stands.
proto::ParameterValue parse_parameter_value(std::string_view word);
// "name=value"
proto::Result<proto::Parameters> parse_assignments(const std::vector<std::string>& words);

// "at-rest", "2" (t = 2 s), "+2" (2 s from now), "step=400" (absolute), "steps=400" (from now), "gauge>0.3" and
// "tank.fx<-10" (a probe's value).
proto::Result<proto::RunUntil> parse_until(std::string_view word);

// "velocity,density"
proto::Result<proto::FieldSet> parse_fields(std::string_view word);
// What colours show: a field's name, or what people call it: "speed", "rho". Of a vector its length is shown.
proto::Result<proto::Field> parse_color_field(std::string_view word);
proto::Result<proto::Precision> parse_precision(std::string_view word);
// "a:b", either may be missing.
proto::Result<std::pair<std::optional<double>, std::optional<double>>> parse_range(std::string_view word);
// "1280x720"
proto::Result<std::pair<int, int>> parse_size(std::string_view word);

// "panel@at-rest", "panel@1.5": an object that leaves during `headrace run`.
struct Removal {
    std::string object;
    proto::RunUntil when;
};
proto::Result<Removal> parse_removal(std::string_view word);

// "x0,y0,x1,y1" in 2D, "x0,y0,z0,x1,y1,z1" in 3D.
proto::Result<proto::BoxDesc> parse_box(std::string_view word, const std::string& option = "--box");
// "x,y,r" in 2D, "x,y,z,r" in 3D.
proto::Result<proto::SphereDesc> parse_sphere(std::string_view word);
// "x0,y0,z0,x1,y1,z1,r"
proto::Result<proto::CylinderDesc> parse_cylinder(std::string_view word);
// A point and the normal: "x,y,nx,ny" in 2D, "x,y,z,nx,ny,nz" in 3D.
proto::Result<proto::PlaneDesc> parse_plane(std::string_view word);

}  // namespace headrace::client
