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

proto::Status write_file(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> parts) {
    std::filesystem::path temporary = file;
    temporary += ".part";

    std::unique_ptr<std::FILE, CloseFile> out(std::fopen(temporary.c_str(), "wb"));
    if (!out) return file_error(file, errno);
    int failure = 0;
    for (const std::span<const std::byte> part : parts)
        if (failure == 0 && std::fwrite(part.data(), 1, part.size(), out.get()) != part.size()) failure = errno;
    // A full disk may show only when the last buffer is flushed.
    if (std::fclose(out.release()) != 0 && failure == 0) failure = errno;
    if (failure == 0 && std::rename(temporary.c_str(), file.c_str()) != 0) failure = errno;
    if (failure != 0) {
        std::remove(temporary.c_str());
        return file_error(file, failure);
    }
    return proto::Done{};
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
