// ParaView files: per frame <stem>_000123.vtp with the particles as vertices, <stem>_objects_000000.vtp whenever the
// collision objects change or move, and <stem>.pvd that gives both a simulated time (parts 0 and 1).
#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

#include "client/writers/exact_text.h"
#include "client/writers/file_output.h"
#include "client/writers/formats.h"
#include "client/writers/object_mesh.h"
#include "client/writers/scene_view.h"
#include "client/writers/vtp_file.h"

namespace headrace::client {

namespace {

using proto::FrameColumn;
using proto::FrameView;

std::string_view vtk_type(std::string_view dtype) {
    if (dtype == "<u4") return "UInt32";
    return dtype == "<f8" ? "Float64" : "Float32";
}

// The column bit by bit; 2D vectors get a third component 0, because VTK knows vectors of three only.
VtpArray make_array(const FrameColumn& column, std::size_t rows) {
    const proto::FieldInfo& info = proto::field_info(column.field);
    const std::size_t row_bytes = static_cast<std::size_t>(column.components) * proto::dtype_size(column.dtype);
    VtpArray array{std::string(info.name), vtk_type(column.dtype), info.is_vector ? 3 : column.components, {}};
    const std::size_t padded_bytes = static_cast<std::size_t>(array.components) * proto::dtype_size(column.dtype);
    array.bytes.resize(rows * padded_bytes);
    for (std::size_t row = 0; row < rows; ++row)
        std::memcpy(array.bytes.data() + row * padded_bytes, column.bytes.data() + row * row_bytes, row_bytes);
    return array;
}

bool same_objects(const std::vector<PlacedObject>& a, const std::vector<PlacedObject>& b) {
    return std::ranges::equal(a, b, [](const PlacedObject& one, const PlacedObject& other) {
        return one.desc.name == other.desc.name && one.desc.role == other.desc.role &&
               one.desc.shape == other.desc.shape && one.place == other.place;
    });
}

// `radius`: of a particle when drawn. [m]
VtpPiece make_particles(const FrameView& frame, const FrameColumn& position, double radius) {
    const std::size_t count = frame.info.particle_count;
    VtpPiece piece;
    piece.point_count = count;
    piece.points = make_array(position, count);
    piece.points.name = "Points";
    piece.verts.connectivity.resize(count);
    piece.verts.offsets.resize(count);
    std::iota(piece.verts.connectivity.begin(), piece.verts.connectivity.end(), 0);
    std::iota(piece.verts.offsets.begin(), piece.verts.offsets.end(), 1);
    for (const FrameColumn& column : frame.columns) {
        if (column.field == proto::Field::position) continue;
        piece.point_data.push_back(make_array(column, count));
        // Density is the better first sight than a particle number; velocity always exists as an arrow.
        const proto::FieldInfo& info = proto::field_info(column.field);
        if (!info.is_vector && (piece.active_scalars.empty() || column.field == proto::Field::density))
            piece.active_scalars = info.name;
        if (info.is_vector && (piece.active_vectors.empty() || column.field == proto::Field::velocity))
            piece.active_vectors = info.name;
    }
    piece.field_data = {make_vtp_array("TimeValue", std::vector<double>{frame.info.time}),
                        make_vtp_array("step", std::vector<double>{static_cast<double>(frame.info.step)}),
                        make_vtp_array("particle_radius", std::vector<double>{radius})};
    return piece;
}

class VtpWriter final : public Writer {
  public:
    explicit VtpWriter(const WriterOptions& options) : options_(options), radius_(particle_radius(options.scene)) {}
    VtpWriter(const VtpWriter&) = delete;
    VtpWriter& operator=(const VtpWriter&) = delete;

    // What was written so far can be opened even when the recording ends in an error.
    ~VtpWriter() override {
        if (!is_finished_ && frames_ > 0) static_cast<void>(write_collection().ok());
    }

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const FrameView& frame = task.frame;
        const FrameColumn* position = frame.find(proto::Field::position);
        if (position == nullptr)
            return proto::Error{proto::ErrorCode::invalid_params, "the frames hold no positions", "fields",
                                "record with the field `position`"};
        if (frame.info.particle_count > std::numeric_limits<std::int32_t>::max())
            return proto::Error{proto::ErrorCode::limit_exceeded, "a .vtp file holds 2^31 - 1 particles at most", "",
                                ""};

        const std::string name = numbered_name(options_.stem, task.number, frame_extension());
        if (auto done = write_vtp(options_.folder / name, make_particles(frame, *position, radius_)); !done)
            return done.error();
        return InOrder([this, info = frame.info, objects = task.objects, name] {
            if (auto done = write_objects(objects, info.dimensions); !done) return done;
            list(info.time, 0, name);
            if (!object_file_.empty()) list(info.time, 1, object_file_);
            ++frames_;
            return proto::Status(proto::Done{});
        });
    }

    proto::Status finish() override {
        is_finished_ = true;
        return write_collection();
    }

    std::string summary() const override { return "open " + collection_path().string() + " in ParaView"; }

    std::string_view frame_extension() const override { return "vtp"; }

  private:
    proto::Status write_objects(const std::vector<PlacedObject>& objects, int dimensions) {
        if (same_objects(objects, objects_)) return proto::Done{};
        const std::string name = numbered_name(options_.stem + "_objects", object_files_, "vtp");
        auto done = write_vtp(options_.folder / name, make_object_mesh(objects, dimensions));
        if (!done) return done;
        objects_ = objects;
        object_file_ = name;
        ++object_files_;
        return done;
    }

    void list(double time, int part, const std::string& file) {
        entries_ += "<DataSet timestep=\"";
        append_number(entries_, time);
        entries_ += "\" group=\"\" part=\"" + std::to_string(part) + "\" file=\"" + xml_escaped(file) + "\"/>\n";
    }

    proto::Status write_collection() const {
        const std::string head =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "<Collection>\n";
        return write_file(collection_path(),
                          {as_bytes(head), as_bytes(entries_), as_bytes("</Collection>\n</VTKFile>\n")});
    }

    std::filesystem::path collection_path() const { return options_.folder / (options_.stem + ".pvd"); }

    WriterOptions options_;
    double radius_;                      // [m] of a particle
    std::string entries_;                // of the collection, so far
    std::vector<PlacedObject> objects_;  // in object_file_
    std::string object_file_;            // empty: there were no objects yet
    std::size_t frames_{0}, object_files_{0};
    bool is_finished_{false};
};

}  // namespace

std::unique_ptr<Writer> make_vtp_writer(const WriterOptions& options) {
    return std::make_unique<VtpWriter>(options);
}

}  // namespace headrace::client
