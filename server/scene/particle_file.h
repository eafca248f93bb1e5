// Particles from a file: where they stand at the start and how fast they are. One format per read_*.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"

namespace headrace::scene {

// Particles in the file's order.
struct ParticleSet {
    std::vector<proto::Vec3> x;  // [m]
    std::vector<proto::Vec3> v;  // [m/s] empty: the file has none
    std::vector<double> p;       // [Pa] empty: the file has none
};

// What a file holds. Columns by name as `headrace convert` writes them into CSV files, without the unit: "position_x",
// "velocity_y", "pressure". All of one length.
struct ParticleTable {
    std::map<std::string, std::vector<double>> columns;
    std::vector<std::string> names;  // all that there are, as the file calls them: to be told when none is of any use
};

// Whether a column is of any use here; others are skipped.
bool is_particle_column(std::string_view name);
inline constexpr std::int64_t kMostParticlesOfFile = 50'000'000;
inline constexpr const char* kTooManyHint = "the server takes 50,000,000 particles: thin them out";

// Readers. Their errors have a message that names the file and the line, column, property or array, a remedy and no
// path.
proto::Result<ParticleTable> read_csv(const std::filesystem::path& file);
proto::Result<ParticleTable> read_npz(const std::filesystem::path& file);
proto::Result<ParticleTable> read_ply(const std::filesystem::path& file);

// [m] How far from its true place a particle of a file may stand: files of frames hold single precision, so that each
// coordinate is off by up to 2^-24 of it. Twice that, for what has been rounded once more on its way.
double rounding_at(const proto::Vec3& x, int dimensions);

// By the ending .csv, .npz or .ply. `path` is that of the member that names the file. Positions must be there, and all
// numbers finite. Errors: file_error for what cannot be found or read, scene_invalid for what is in it.
proto::Result<ParticleSet> read_particle_file(const std::filesystem::path& data_folder, const std::string& name,
                                              int dimensions, const std::string& path);

// The files of a scene's fluids, by the fluid's number; absent: it has a shape. What rounding has put beyond the domain
// stands on its boundary.
using FluidFiles = std::map<std::size_t, ParticleSet>;
proto::Result<FluidFiles> read_fluid_files(const proto::SceneDesc& scene, const std::filesystem::path& data_folder);

}  // namespace headrace::scene
