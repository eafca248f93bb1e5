#include "client/writers/file_output.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace headrace::client {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

proto::Error file_error(const std::filesystem::path& file, int error_number) {
    const std::string reason = std::generic_category().message(error_number);
    return {proto::ErrorCode::file_error, "cannot write " + file.string() + ": " + reason, file.string(), ""};
}

}  // namespace

// The file under its temporary name.
struct GrowingFile::Impl {
    std::filesystem::path temporary;
    std::unique_ptr<std::FILE, CloseFile> out;
    int failure{0};  // the first one

    explicit Impl(const std::filesystem::path& file) : temporary(file) {
        temporary += ".part";
        out.reset(std::fopen(temporary.c_str(), "wb"));
        if (!out) failure = errno;
    }
    void append(const void* data, std::size_t size) {
        if (failure == 0 && std::fwrite(data, 1, size, out.get()) != size) failure = errno;
    }
    void commit(const std::filesystem::path& file) {
        // A full disk may show only when the last buffer is flushed.
        if (out && std::fclose(out.release()) != 0 && failure == 0) failure = errno;
        if (failure == 0 && std::rename(temporary.c_str(), file.c_str()) != 0) failure = errno;
        if (failure == 0) temporary.clear();
    }
    ~Impl() {
        if (temporary.empty()) return;
        out.reset();
        std::remove(temporary.c_str());
    }
};

GrowingFile::GrowingFile(std::filesystem::path file) : file_(std::move(file)), impl_(std::make_unique<Impl>(file_)) {}
GrowingFile::~GrowingFile() = default;

proto::Status GrowingFile::append(std::string_view text) {
    impl_->append(text.data(), text.size());
    if (impl_->failure != 0) return file_error(file_, impl_->failure);
    return proto::Done{};
}

proto::Status GrowingFile::commit() {
    impl_->commit(file_);
    if (impl_->failure != 0) return file_error(file_, impl_->failure);
    return proto::Done{};
}

proto::Status write_file(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> parts) {
    GrowingFile out(file);
    for (const std::span<const std::byte> part : parts)
        if (auto done = out.append({reinterpret_cast<const char*>(part.data()), part.size()}); !done) return done;
    return out.commit();
}

std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

std::string numbered_name(const std::string& stem, std::size_t number, std::string_view extension) {
    std::string digits = std::to_string(number);
    if (digits.size() < 6) digits.insert(0, 6 - digits.size(), '0');
    return stem + "_" + digits + "." + std::string(extension);
}

}  // namespace headrace::client
