#include "client/probe_csv.h"

#include <charconv>
#include <utility>

#include "client/text.h"
#include "client/writers/file_output.h"

namespace headrace::client {

namespace {

void append_number(std::string& text, double value) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, end.ptr);
}

struct File {
    std::string name;
    std::vector<proto::ProbeColumn> columns;
    std::string text;
};

// The file that takes a sample: another one when the columns have changed.
File& file_for(std::vector<File>& files, const proto::ProbeSample& sample, const std::string& stem) {
    if (!files.empty() && files.back().columns == sample.columns) return files.back();
    std::string name = stem + "_probe_" + sample.probe;
    if (!files.empty()) name += "_" + std::to_string(files.size() + 1);
    std::vector<proto::ProbeColumn> columns{{"time", "s", {}}};
    columns.insert(columns.end(), sample.columns.begin(), sample.columns.end());
    files.push_back({name + ".csv", sample.columns, csv_header(columns)});
    return files.back();
}

}  // namespace

std::string csv_header(const std::vector<proto::ProbeColumn>& columns) {
    std::string line;
    for (const proto::ProbeColumn& column : columns) {
        if (!line.empty()) line += ',';
        line += column.name;
        if (column.position) line += " at " + number(*column.position) + " m";
        if (column.unit != "1") line += " [" + column.unit + "]";
    }
    return line + '\n';
}

std::string csv_row(const proto::ProbeRow& row) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (k > 0) line += ',';
        if (row[k]) append_number(line, *row[k]);
    }
    return line + '\n';
}

proto::Result<std::vector<std::string>> write_probe_files(proto::RecordingReader& reader, const ProbeFiles& options) {
    std::map<std::string, std::vector<File>> files;  // by probe
    constexpr double kSlack = 1e-9;                  // [s] times are sums of rounded time steps
    const proto::Status read = reader.read_probes([&](const proto::ProbeSamples& instant) {
        if (options.from && instant.time < *options.from - kSlack) return;
        if (options.to && instant.time > *options.to + kSlack) return;
        for (const proto::ProbeSample& sample : instant.samples) {
            proto::ProbeRow row{instant.time};
            row.insert(row.end(), sample.values.begin(), sample.values.end());
            file_for(files[sample.probe], sample, options.stem).text += csv_row(row);
        }
    });
    if (!read) return read.error();
    std::error_code failure;
    if (!files.empty()) std::filesystem::create_directories(options.folder, failure);
    if (failure)
        return proto::Error{proto::ErrorCode::file_error, "cannot make the folder: " + failure.message(),
                            options.folder.string(), ""};
    std::vector<std::string> names;
    for (const auto& [probe, parts] : files)
        for (const File& file : parts) {
            if (auto written = write_file(options.folder / file.name, {as_bytes(file.text)}); !written)
                return written.error();
            names.push_back((options.folder / file.name).string());
        }
    if (names.empty())
        return proto::Error{proto::ErrorCode::file_error, "no samples of probes in the range asked for", "--probes",
                            "only scenes with probes, or runs after probes.add, have them"};
    return names;
}

}  // namespace headrace::client
