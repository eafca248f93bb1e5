// Point clouds for Blender, MeshLab and CloudCompare: one binary little-endian <stem>_000123.ply per frame. Positions
// are the properties x, y, z (2D: z is 0, since readers want three); all other fields keep their name, vectors with _x,
// _y, _z behind it. Format: G. Turk, The PLY Polygon File Format, 1994.
#include <cstring>

#include "client/writers/exact_text.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"

namespace headrace::client {

namespace {

std::string_view ply_type(std::string_view dtype) {
    if (dtype == "<u4") return "uint";
    return dtype == "<f8" ? "double" : "float";
}

// Components in the file: three of the position, those there are of the others.
int stored_components(const proto::FrameColumn& column) {
    return column.field == proto::Field::position ? 3 : column.components;
}

std::string make_header(const proto::FrameView& frame) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment time ";
    append_number(text, frame.info.time);
    text += " s\ncomment step ";
    append_number(text, frame.info.step);
    text += "\nelement vertex ";
    append_number(text, frame.info.particle_count);
    text += '\n';
    for (const proto::FrameColumn& column : frame.columns)
        for (int component = 0; component < stored_components(column); ++component) {
            const proto::FieldInfo& info = proto::field_info(column.field);
            text.append("property ").append(ply_type(column.dtype)).append(" ");
            if (column.field != proto::Field::position) text += info.name;
            if (info.is_vector && column.field != proto::Field::position) text += '_';
            if (info.is_vector) text += "xyz"[component];
            text += '\n';
        }
    return text + "end_header\n";
}

class PlyWriter final : public Writer {
  public:
    explicit PlyWriter(const WriterOptions& options) : options_(options) {}

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameView& frame = task.frame;
        std::size_t vertex_bytes = 0;
        for (const proto::FrameColumn& column : frame.columns)
            vertex_bytes += stored_components(column) * proto::dtype_size(column.dtype);

        std::vector<std::byte> vertices(frame.info.particle_count * vertex_bytes);  // zeros
        std::byte* first = vertices.data();
        for (const proto::FrameColumn& column : frame.columns) {
            const std::size_t value_bytes = proto::dtype_size(column.dtype),
                              row_bytes = column.components * value_bytes;
            for (std::size_t row = 0; row < frame.info.particle_count; ++row)
                std::memcpy(first + row * vertex_bytes, column.bytes.data() + row * row_bytes, row_bytes);
            first += stored_components(column) * value_bytes;
        }
        const std::string name = numbered_name(options_.stem, task.number, frame_extension());
        if (auto done = write_file(options_.folder / name, {as_bytes(make_header(frame)), vertices}); !done)
            return done.error();
        return InOrder([this] {
            ++frames_;
            return proto::Status(proto::Done{});
        });
    }

    proto::Status finish() override { return proto::Done{}; }

    std::string summary() const override {
        return std::to_string(frames_) + " files " + (options_.folder / (options_.stem + "_*.ply")).string() +
               ", point clouds for Blender, MeshLab and the like";
    }

    std::string_view frame_extension() const override { return "ply"; }

  private:
    WriterOptions options_;
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_ply_writer(const WriterOptions& options) {
    return std::make_unique<PlyWriter>(options);
}

}  // namespace headrace::client
