// Chunks read back from a recording: bounds, decompression and CRC in one place.
#pragma once

#include <cstdint>
#include <memory>

#include "proto/mcap.h"
#include "proto/recording_file.h"
#include "proto/result.h"

namespace headrace::proto::recording {

// Owner: one reader. Holds the memory of one chunk.
class ChunkLoader {
  public:
    explicit ChunkLoader(const File& file);
    ~ChunkLoader();

    // The uncompressed records of the chunk record at `offset`, `length` bytes with its head; valid until the next
    // call. Errors: file_error; parse_error when it is no chunk, does not decompress or has a bad CRC.
    // Precondition: offset + length <= file size.
    Result<mcap::ByteView> load(std::uint64_t offset, std::uint64_t length);

  private:
    struct Decompressor;
    bool decompress(mcap::ByteView packed, std::uint64_t size);

    const File& file_;
    mcap::Bytes record_, unpacked_;
    std::unique_ptr<Decompressor> decompressor_;
};

Error damage(const File& file, std::uint64_t offset, const std::string& what);

}  // namespace headrace::proto::recording
