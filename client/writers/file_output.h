// Whole files: they appear under their name complete or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "proto/result.h"

namespace headrace::client {

// Writes `parts` one after the other to a temporary name beside `file`, then renames it. Errors: file_error.
proto::Status write_file(const std::filesystem::path& file, std::initializer_list<std::span<const std::byte>> parts);

// A file that grows while a recording is converted. Owner: one thread.
class GrowingFile {
  public:
    explicit GrowingFile(std::filesystem::path file);
    ~GrowingFile();  // without commit() nothing is left

    // Errors of both: file_error, as of write_file.
    proto::Status append(std::string_view text);
    proto::Status commit();  // it appears under its name

    const std::filesystem::path& path() const { return file_; }

  private:
    struct Impl;
    std::filesystem::path file_;
    std::unique_ptr<Impl> impl_;
};

std::span<const std::byte> as_bytes(std::string_view text);

// "wave", 12, "vtp" -> "wave_000012.vtp"
std::string numbered_name(const std::string& stem, std::size_t number, std::string_view extension);

}  // namespace headrace::client
