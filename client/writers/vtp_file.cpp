#include "client/writers/vtp_file.h"

#include <bit>
#include <cstring>

#include "client/writers/file_output.h"

namespace headrace::client {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

template <class T>
VtpArray as_array(std::string name, std::string_view type, const std::vector<T>& values, int components) {
    const auto bytes = std::as_bytes(std::span(values));
    return {std::move(name), type, components, {bytes.begin(), bytes.end()}};
}

// Collects the XML and the appended block together, so that each array's offset is where its bytes really go.
class Document {
  public:
    void line(const std::string& text) { xml_ += text + '\n'; }

    void array(const VtpArray& array, const std::string& extra = "") {
        line("<DataArray type=\"" + std::string(array.type) + "\" Name=\"" + xml_escaped(array.name) +
             "\" NumberOfComponents=\"" + std::to_string(array.components) + "\"" + extra +
             " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>");
        const std::uint64_t size = array.bytes.size();
        const std::size_t start = appended_.size();
        appended_.resize(start + sizeof size + size);
        std::memcpy(appended_.data() + start, &size, sizeof size);
        if (size != 0) std::memcpy(appended_.data() + start + sizeof size, array.bytes.data(), size);
    }

    void cells(const std::string& kind, const VtpCells& cells) {
        line("<" + kind + ">");
        array(as_array("connectivity", "Int32", cells.connectivity, 1));
        array(as_array("offsets", "Int32", cells.offsets, 1));
        line("</" + kind + ">");
    }

    // Strings travel as character numbers, each string ended by 0.
    void strings(const std::string& name, const std::vector<std::string>& texts) {
        std::string codes;
        for (const std::string& text : texts) {
            for (const char letter : text) codes += std::to_string(static_cast<unsigned char>(letter)) + ' ';
            codes += "0 ";
        }
        line("<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"" + std::to_string(texts.size()) +
             "\" format=\"ascii\">" + codes + "</Array>");
    }

    proto::Status write(const std::filesystem::path& file) {
        line("<AppendedData encoding=\"raw\">");
        xml_ += '_';
        return write_file(file, {as_bytes(xml_), appended_, as_bytes("\n</AppendedData>\n</VTKFile>\n")});
    }

  private:
    std::string xml_;
    std::vector<std::byte> appended_;
};

std::string attribute(const std::string& name, std::size_t value) {
    return " " + name + "=\"" + std::to_string(value) + "\"";
}

}  // namespace

VtpArray make_vtp_array(std::string name, const std::vector<double>& values, int components) {
    return as_array(std::move(name), "Float64", values, components);
}

VtpArray make_vtp_array(std::string name, const std::vector<std::int32_t>& values) {
    return as_array(std::move(name), "Int32", values, 1);
}

proto::Status write_vtp(const std::filesystem::path& file, const VtpPiece& piece) {
    Document document;
    document.line("<?xml version=\"1.0\"?>");
    document.line("<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">");
    document.line("<PolyData>");

    document.line("<FieldData>");
    for (const VtpArray& array : piece.field_data) document.array(array, attribute("NumberOfTuples", 1));
    if (!piece.names.empty()) document.strings("names", piece.names);
    document.line("</FieldData>");

    document.line("<Piece" + attribute("NumberOfPoints", piece.point_count) +
                  attribute("NumberOfVerts", piece.verts.offsets.size()) +
                  attribute("NumberOfLines", piece.lines.offsets.size()) + attribute("NumberOfStrips", 0) +
                  attribute("NumberOfPolys", piece.polys.offsets.size()) + ">");
    std::string active;
    if (!piece.active_scalars.empty()) active += " Scalars=\"" + xml_escaped(piece.active_scalars) + "\"";
    if (!piece.active_vectors.empty()) active += " Vectors=\"" + xml_escaped(piece.active_vectors) + "\"";
    document.line("<PointData" + active + ">");
    for (const VtpArray& array : piece.point_data) document.array(array);
    document.line("</PointData>");
    document.line("<CellData>");
    for (const VtpArray& array : piece.cell_data) document.array(array);
    document.line("</CellData>");
    document.line("<Points>");
    document.array(piece.points);
    document.line("</Points>");
    document.cells("Verts", piece.verts);
    document.cells("Lines", piece.lines);
    document.cells("Polys", piece.polys);
    document.line("</Piece>");
    document.line("</PolyData>");
    return document.write(file);
}

std::string xml_escaped(std::string_view text) {
    std::string escaped;
    for (const char letter : text) {
        switch (letter) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += letter;
        }
    }
    return escaped;
}

}  // namespace headrace::client
