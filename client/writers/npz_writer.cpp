// NumPy archives: one <stem>_000123.npz per frame with an array for each field, named after it: (n,) for scalars, (n,
// 2) or (n, 3) for vectors, in the stored type; besides the 0-d arrays `time` [s] and `step`. A file per frame and not
// one for all: particles may come and go, so frames need not stack; frames convert side by side in bounded memory; and
// one file is what `scene.load` takes. Format: numpy.lib.format, version 1.0, in an uncompressed zip archive.
#include <zip.h>

#include <bit>
#include <cstring>

#include "client/writers/file_output.h"
#include "client/writers/formats.h"

namespace headrace::client {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers go into the file as they lie in memory");

// "\x93NUMPY", version, length of the description, description; a multiple of 64 bytes.
std::string npy_header(std::string_view dtype, const std::string& shape) {
    std::string text = "{'descr': '" + std::string(dtype) + "', 'fortran_order': False, 'shape': " + shape + ", }";
    constexpr std::size_t kPrefix = 10, kAlignment = 64;
    while ((kPrefix + text.size() + 1) % kAlignment != 0) text += ' ';
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(text.size() & 0xFF);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

std::span<const std::byte> bytes_of(const auto& number) {
    return std::as_bytes(std::span(&number, 1));
}

// An archive in memory.
class Archive {
  public:
    Archive()
        : source_(zip_source_buffer_create(nullptr, 0, 0, nullptr)),
          archive_(source_ == nullptr ? nullptr : zip_open_from_source(source_, ZIP_TRUNCATE, nullptr)) {
        if (archive_ != nullptr) zip_source_keep(source_);  // the archive's own reference ends with it
    }
    ~Archive() {
        if (archive_ != nullptr) zip_discard(archive_);
        if (source_ != nullptr) zip_source_free(source_);
    }
    Archive(const Archive&) = delete;
    Archive& operator=(const Archive&) = delete;

    void add(const std::string& name, std::string_view dtype, const std::string& shape,
             std::span<const std::byte> values) {
        const std::string header = npy_header(dtype, shape);
        auto& member = members_.emplace_back(header.size() + values.size());
        std::memcpy(member.data(), header.data(), header.size());
        if (!values.empty()) std::memcpy(member.data() + header.size(), values.data(), values.size());
        if (archive_ == nullptr) return;
        zip_source_t* source = zip_source_buffer(archive_, member.data(), member.size(), 0);
        const zip_int64_t index = zip_file_add(archive_, (name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
        if (index < 0) {
            zip_source_free(source);
            failed_ = true;
            return;
        }
        const auto place = static_cast<zip_uint64_t>(index);
        zip_set_file_compression(archive_, place, ZIP_CM_STORE, 0);
        // The same recording gives the same bytes at any hour: 1980-01-01, the first day that zip knows.
        zip_file_set_dostime(archive_, place, 0, 1 << 5 | 1, 0);
    }

    // The whole archive; empty when it could not be made.
    std::vector<std::byte> finish() {
        if (archive_ == nullptr || failed_ || zip_close(archive_) != 0) return {};
        archive_ = nullptr;
        zip_stat_t stat;
        zip_stat_init(&stat);
        if (zip_source_stat(source_, &stat) != 0 || zip_source_open(source_) != 0) return {};
        std::vector<std::byte> bytes(stat.size);
        const zip_int64_t got = zip_source_read(source_, bytes.data(), bytes.size());
        zip_source_close(source_);
        return got == static_cast<zip_int64_t>(bytes.size()) ? bytes : std::vector<std::byte>{};
    }

  private:
    zip_source_t* source_;
    zip_t* archive_;
    bool failed_{false};
    std::vector<std::vector<std::byte>> members_;  // libzip reads them when it closes the archive
};

class NpzWriter final : public Writer {
  public:
    explicit NpzWriter(const WriterOptions& options) : options_(options) {}

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        const proto::FrameInfo& info = task.frame.info;
        Archive archive;
        archive.add("time", "<f8", "()", bytes_of(info.time));
        archive.add("step", "<u8", "()", bytes_of(info.step));
        for (const proto::FrameColumn& column : task.frame.columns) {
            const proto::FieldInfo& field = proto::field_info(column.field);
            const std::string count = std::to_string(info.particle_count);
            archive.add(
                std::string(field.name), column.dtype,
                field.is_vector ? "(" + count + ", " + std::to_string(column.components) + ")" : "(" + count + ",)",
                column.bytes);
        }
        const std::filesystem::path file =
            options_.folder / numbered_name(options_.stem, task.number, frame_extension());
        const std::vector<std::byte> bytes = archive.finish();
        if (bytes.empty())
            return proto::Error{proto::ErrorCode::file_error, "cannot make the zip archive", file.string(),
                                "is there memory for another copy of a frame?"};
        if (auto done = write_file(file, {bytes}); !done) return done.error();
        return InOrder([this] {
            ++frames_;
            return proto::Status(proto::Done{});
        });
    }

    proto::Status finish() override { return proto::Done{}; }

    std::string summary() const override {
        return std::to_string(frames_) + " files " + (options_.folder / (options_.stem + "_*.npz")).string() +
               ", for numpy.load";
    }

    std::string_view frame_extension() const override { return "npz"; }

  private:
    WriterOptions options_;
    std::size_t frames_{0};
};

}  // namespace

std::unique_ptr<Writer> make_npz_writer(const WriterOptions& options) {
    return std::make_unique<NpzWriter>(options);
}

}  // namespace headrace::client
