// Frames made by hand for the writers' tests.
#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "proto/frame.h"
#include "proto/scene_desc.h"

namespace headrace::tests {

// Owns the bytes that a FrameView looks at.
class SyntheticFrame {
  public:
    SyntheticFrame(int dimensions, std::uint64_t particles, double time, std::uint64_t step = 0) {
        view_.info.dimensions = dimensions;
        view_.info.particle_count = particles;
        view_.info.time = time;
        view_.info.step = step;
    }

    // Values row by row.
    template <class T>
    SyntheticFrame& column(proto::Field field, std::string_view dtype, int components, const std::vector<T>& values) {
        auto bytes = std::make_unique<std::vector<std::byte>>(values.size() * sizeof(T));
        std::memcpy(bytes->data(), values.data(), bytes->size());
        view_.columns.push_back({field, dtype, components, *bytes});
        owned_.push_back(std::move(bytes));
        return *this;
    }

    const proto::FrameView& view() const { return view_; }

  private:
    proto::FrameView view_;
    std::vector<std::unique_ptr<std::vector<std::byte>>> owned_;
};

// A folder that ends with the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "headrace-writers-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A tank of 1 m x 0.8 m x 0.4 m with a column of water behind a panel, y up.
inline proto::SceneDesc tank_scene() {
    proto::SceneDesc scene;
    scene.name = "tank";
    scene.spacing = 0.02;
    scene.domain = {{-0.1, -0.1, -0.1}, {1.1, 0.9, 0.5}};
    scene.parameters = {{"gravity", proto::Vec3{0, -9.82, 0}}, {"rest_density", 1000.0}};
    scene.fluids = {{"column", proto::BoxDesc{{0, 0, 0}, {0.3, 0.5, 0.4}}, {}}};
    scene.objects = {{"walls", proto::ObjectRole::container, proto::BoxDesc{{0, 0, 0}, {1, 0.8, 0.4}}},
                     {"panel", proto::ObjectRole::obstacle, proto::BoxDesc{{0.3, -0.05, -0.05}, {0.32, 0.85, 0.45}}}};
    return scene;
}

}  // namespace headrace::tests
