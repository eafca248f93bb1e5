// Samples of probes as comma-separated values: one file per probe, time first, units in the header, nothing where there
// was no fluid to measure.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "proto/recording.h"
#include "proto/result.h"

namespace headrace::client {

// "time [s],pressure [Pa]"; a profile's columns tell their place: "vx_3 at 0.3 m [m/s]". Ends the line.
std::string csv_header(const std::vector<proto::ProbeColumn>& columns);
// Numbers that read back exactly. Ends the line.
std::string csv_row(const proto::ProbeRow& row);

struct ProbeFiles {
    std::filesystem::path folder;
    std::string stem;
    std::optional<double> from, to;  // [s] simulated, both included
};

// Writes <stem>_probe_<name>.csv for each probe of the recording; a probe that was replaced by another of its name gets
// <stem>_probe_<name>_2.csv as well. Returns the files' names. Errors: file_error, also when there are no samples.
proto::Result<std::vector<std::string>> write_probe_files(proto::RecordingReader& reader, const ProbeFiles& options);

}  // namespace headrace::client
