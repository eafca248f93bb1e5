// VTK XML PolyData files: appended raw data, UInt64 headers, little-endian.
// Format: VTK file formats, docs.vtk.org, section "XML File Formats".
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "proto/result.h"

namespace headrace::client {

struct VtpArray {
    std::string name;
    std::string_view type;  // "UInt32", "Int32", "Float32", "Float64", ...
    int components{1};
    std::vector<std::byte> bytes;
};

// Cells of one kind: point numbers one after the other, and where each cell ends in them.
struct VtpCells {
    std::vector<std::int32_t> connectivity;
    std::vector<std::int32_t> offsets;
};

struct VtpPiece {
    std::size_t point_count{};
    VtpArray points;  // three components
    VtpCells verts, lines, polys;
    std::vector<VtpArray> point_data;
    std::vector<VtpArray> cell_data;   // rows: verts, then lines, then polys
    std::vector<VtpArray> field_data;  // of the file as a whole
    std::string active_scalars, active_vectors;
    std::vector<std::string> names;  // field data "names", when not empty
};

VtpArray make_vtp_array(std::string name, const std::vector<double>& values, int components = 1);
VtpArray make_vtp_array(std::string name, const std::vector<std::int32_t>& values);

proto::Status write_vtp(const std::filesystem::path& file, const VtpPiece& piece);

// &, <, > and quotes as XML wants them in attributes.
std::string xml_escaped(std::string_view text);

}  // namespace headrace::client
