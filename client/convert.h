// A recording into other programs' formats.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/writers/writer.h"
#include "proto/result.h"

namespace headrace::client {

struct ConvertOptions {
    std::filesystem::path recording;
    std::filesystem::path folder;
    std::vector<std::string> formats;
    PictureOptions picture;
    std::size_t every{1};                   // each so many-th frame of those in the range
    std::optional<double> from, to;         // [s] simulated, both included
    std::optional<proto::FieldSet> fields;  // of the formats that store fields; absent: all that were recorded
    std::optional<proto::BoxDesc> region;   // [m] only the particles inside, faces included
    int jobs{0};                            // frames in work at a time; 0: as many as the machine has cores
    bool probes{false};                     // a CSV file for each probe besides
};

struct Conversion {
    std::size_t frames{};
    std::vector<std::string> summaries;    // one per format, in the order asked for
    std::vector<std::string> probe_files;  // of --probes
};

// Errors: usage, for a format that does not exist.
proto::Status check_formats(const std::vector<std::string>& formats);
// Errors: usage, for a field that a format needs (pictures: `color_field` too) and the frames will not have.
proto::Status check_fields(const std::vector<std::string>& formats, proto::FieldSet fields, proto::Field color_field);

// Reads and writes frame by frame: memory does not grow with the recording, only with `jobs`, and the files do not
// depend on them. Errors: usage for a choice that leaves nothing, file_error, those of reader and writers: then
// the files of the frames before it are there and whole, and the hint says how many; none of others. On Ctrl-C the
// frames so far are converted and the files complete.
proto::Result<Conversion> convert(const ConvertOptions& options);

}  // namespace headrace::client
