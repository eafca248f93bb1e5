#include "server/scene/particle_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "proto/fields.h"
#include "proto/path_below.h"

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;
namespace fs = std::filesystem;

namespace {

constexpr const char* kFolderHint = "give a path below the server's data folder (headraced --data)";

// "velocity_x"
std::string component_name(proto::Field field, int axis) {
    return std::string(proto::field_info(field).name) + "_" + "xyz"[axis];
}

Error in_file(const std::string& name, const std::string& message, std::string hint = {}) {
    return {ErrorCode::scene_invalid, name + ", " + message, "", std::move(hint)};
}

// All components or none; a flat scene has no third one, or one that is 0 throughout.
Result<std::vector<proto::Vec3>> take_vectors(const ParticleTable& table, proto::Field field, int dimensions,
                                              const std::string& name) {
    std::vector<proto::Vec3> vectors;
    int found = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto column = table.columns.find(component_name(field, axis));
        if (column == table.columns.end()) continue;
        vectors.resize(column->second.size());
        if (axis >= dimensions) {
            const auto wrong =
                std::find_if(column->second.begin(), column->second.end(), [](double x) { return x != 0; });
            if (wrong == column->second.end()) continue;
            return in_file(name,
                           column->first + " of particle " + std::to_string(wrong - column->second.begin()) +
                               " is not 0 in a scene of 2 dimensions",
                           "make scene.dimensions 3, or leave the component out");
        }
        ++found;
        for (std::size_t k = 0; k < vectors.size(); ++k) vectors[k][axis] = column->second[k];
    }
    if (found == 0) return std::vector<proto::Vec3>{};
    for (int axis = 0; axis < dimensions; ++axis)
        if (!table.columns.contains(component_name(field, axis)))
            return in_file(name, "there is no " + component_name(field, axis),
                           "vectors need as many components as the scene has dimensions");
    return vectors;
}

Result<ParticleTable> read_table(const fs::path& file, const std::string& name) {
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        return Error{ErrorCode::file_error, "there is no file " + name + " below the server's data folder", "",
                     kFolderHint};
    if (!std::ifstream(file))
        return Error{ErrorCode::file_error, "cannot read " + name + ": " + std::strerror(errno), "",
                     "the server needs the right to read it"};
    const std::string ending = file.extension();
    if (ending == ".csv") return read_csv(file);
    if (ending == ".npz") return read_npz(file);
    if (ending == ".ply") return read_ply(file);
    return Error{ErrorCode::file_error, "particles are read from .npz, .csv and .ply files, not from " + name, "",
                 "headrace convert --format npz makes such files of a recording"};
}

// How a format calls what holds the positions.
struct Wording {
    std::string_view ending, kind, kinds, positions, hint;
};
constexpr Wording kWordings[] = {
    {".csv", "column", "columns", "position_x",
     "positions are the columns position_x, position_y and, in 3D, position_z, with commas between them"},
    {".npz", "array", "arrays", "position", "positions are an array `position` of shape (n, 2) or (n, 3)"},
    {".ply", "property", "properties", "x", "positions are the vertices' properties x, y and z"}};

// Why there are no positions. What the file holds instead is told: a name is misspelt more often than left out.
Error no_positions(const ParticleTable& table, const std::string& name) {
    if (table.columns.contains("position_x")) return in_file(name, "there is no particle", "write one row at least");
    const Wording& wording = *std::find_if(std::begin(kWordings), std::end(kWordings),
                                           [&](const Wording& w) { return name.ends_with(w.ending); });
    constexpr std::size_t kMostNames = 12;
    std::string found;
    for (std::size_t k = 0; k < std::min(table.names.size(), kMostNames); ++k)
        found += (k == 0 ? "" : ", ") + table.names[k].substr(0, 40);
    if (table.names.size() > kMostNames) found += ", ...";
    std::string message(wording.kind);
    message.append(" ").append(wording.positions).append(" is missing; there are ");
    message.append(found.empty() ? "no " : "the ").append(wording.kinds);
    if (!found.empty()) message += " " + found;
    return in_file(name, message, std::string(wording.hint));
}

Result<ParticleSet> make_set(const ParticleTable& table, int dimensions, const std::string& name) {
    for (const auto& [column, values] : table.columns)
        for (std::size_t k = 0; k < values.size(); ++k)
            if (!std::isfinite(values[k]))
                return in_file(name, column + " of particle " + std::to_string(k) + " is not finite",
                               "leave that particle out, or give it a number");
    ParticleSet set;
    auto x = take_vectors(table, proto::Field::position, dimensions, name);
    if (!x) return x.error();
    set.x = *std::move(x);
    if (set.x.empty()) return no_positions(table, name);
    auto v = take_vectors(table, proto::Field::velocity, dimensions, name);
    if (!v) return v.error();
    set.v = *std::move(v);
    if (const auto p = table.columns.find("pressure"); p != table.columns.end()) set.p = p->second;
    return set;
}

// No model takes a particle outside the domain. Whether a periodic axis is meant does not matter: both ends are one
// place.
void return_to_domain(const proto::SceneDesc& scene, std::vector<proto::Vec3>& particles) {
    for (proto::Vec3& x : particles) {
        const double rounding = rounding_at(x, scene.dimensions);
        for (int k = 0; k < scene.dimensions; ++k) {
            if (x[k] < scene.domain.min[k] && x[k] >= scene.domain.min[k] - rounding) x[k] = scene.domain.min[k];
            if (x[k] > scene.domain.max[k] && x[k] <= scene.domain.max[k] + rounding) x[k] = scene.domain.max[k];
        }
    }
}

}  // namespace

double rounding_at(const proto::Vec3& x, int dimensions) {
    return 0x1.0p-23 * std::hypot(x[0], x[1], dimensions == 3 ? x[2] : 0.0);
}

bool is_particle_column(std::string_view name) {
    if (name == proto::field_info(proto::Field::pressure).name) return true;
    for (const proto::Field field : {proto::Field::position, proto::Field::velocity})
        for (int axis = 0; axis < 3; ++axis)
            if (name == component_name(field, axis)) return true;
    return false;
}

Result<ParticleSet> read_particle_file(const fs::path& data_folder, const std::string& name, int dimensions,
                                       const std::string& path) {
    auto file = proto::path_below(data_folder, name, path, kFolderHint);
    if (!file) return file.error();
    auto table = read_table(*file, name);
    auto set = table ? make_set(*table, dimensions, name) : Result<ParticleSet>(table.error());
    if (set) return set;
    Error error = set.error();
    error.path = path;
    return error;
}

Result<FluidFiles> read_fluid_files(const proto::SceneDesc& scene, const fs::path& data_folder) {
    FluidFiles files;
    std::int64_t count = 0;
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        if (!scene.fluids[k].particles) continue;
        const std::string path = "scene.fluids[" + std::to_string(k) + "].particles.file";
        auto set = read_particle_file(data_folder, scene.fluids[k].particles->file, scene.dimensions, path);
        if (!set) return set.error();
        count += static_cast<std::int64_t>(set->x.size());
        if (count > kMostParticlesOfFile)
            return Error{ErrorCode::limit_exceeded, "the files hold more than 50,000,000 particles", path,
                         kTooManyHint};
        return_to_domain(scene, set->x);
        files.emplace(k, *std::move(set));
    }
    return files;
}

}  // namespace headrace::scene
