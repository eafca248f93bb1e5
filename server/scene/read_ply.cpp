// Point clouds: the element `vertex` with x, y, z and the properties that `headrace convert --format ply` writes; text
// and binary of both byte orders. Elements behind the vertices are not looked at. Format: G. Turk, The PLY Polygon File
// Format, 1994.
#include <bit>
#include <fstream>
#include <optional>
#include <sstream>

#include "server/scene/file_bytes.h"
#include "server/scene/particle_file.h"

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;

namespace {

constexpr const char* kHint = "headrace convert --format ply, and most programs, write what can be read";
constexpr const char* kCompleteHint = "is the file complete?";

struct Property {
    NumberType type{};
    std::string name;
};

enum class Coding { unknown, text, little_endian, big_endian };

struct Header {
    Coding coding{};
    std::int64_t vertices{-1};  // -1: no such element
    std::vector<Property> properties;
    std::size_t lines{0};
};

std::optional<NumberType> number_type(const std::string& word) {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"char", NumberType::i1},   {"int8", NumberType::i1},    {"uchar", NumberType::u1},
        {"uint8", NumberType::u1},  {"short", NumberType::i2},   {"int16", NumberType::i2},
        {"ushort", NumberType::u2}, {"uint16", NumberType::u2},  {"int", NumberType::i4},
        {"int32", NumberType::i4},  {"uint", NumberType::u4},    {"uint32", NumberType::u4},
        {"float", NumberType::f4},  {"float32", NumberType::f4}, {"double", NumberType::f8},
        {"float64", NumberType::f8}};
    for (const auto& [name, type] : kTypes)
        if (name == word) return type;
    return std::nullopt;
}

std::string column_name(const std::string& property) {
    return property == "x" || property == "y" || property == "z" ? "position_" + property : property;
}

// One line of the header; a message when it cannot be taken.
std::optional<std::string> take_line(const std::string& line, std::string& element, Header& header) {
    std::istringstream words(line);
    std::string key, first, second;
    words >> key >> first >> second;
    if (key == "format") {
        header.coding = first == "ascii"                  ? Coding::text
                        : first == "binary_little_endian" ? Coding::little_endian
                        : first == "binary_big_endian"    ? Coding::big_endian
                                                          : Coding::unknown;
        if (header.coding == Coding::unknown) return "the format " + first + " is not read here";
    } else if (key == "element") {
        if (first != "vertex" && header.vertices < 0) return "the vertices must come first";
        element = first;
        if (first == "vertex" && (!(std::istringstream(second) >> header.vertices) || header.vertices < 0 ||
                                  header.vertices > kMostParticlesOfFile))
            return "the number of vertices is \"" + second + "\", not one from 0 to 50,000,000";
    } else if (key == "property" && element == "vertex") {
        const auto type = number_type(first);
        if (!type) return "a property of type " + first + " is not read here";
        header.properties.push_back({*type, second});
    }
    return std::nullopt;
}

}  // namespace

Result<ParticleTable> read_ply(const std::filesystem::path& file) {
    const std::string name = file.filename();
    std::ifstream in(file, std::ios::binary);
    Header header;
    const auto wrong = [&](const std::string& message, std::string hint = kHint) {
        return Error{ErrorCode::scene_invalid, name + ", " + message, "", std::move(hint)};
    };
    const auto wrong_line = [&](const std::string& message) {
        return wrong("line " + std::to_string(header.lines) + ": " + message);
    };

    std::string line, element;
    for (;;) {
        if (!std::getline(in, line) || line.size() > 1000) return wrong("there is no end of the header", kCompleteHint);
        ++header.lines;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (header.lines == 1 && line != "ply") return wrong_line("a PLY file begins with `ply`");
        if (line == "end_header") break;
        if (const auto problem = take_line(line, element, header)) return wrong_line(*problem);
    }
    if (header.vertices < 0) return wrong("there is no element `vertex`");
    if (header.coding == Coding::unknown) return wrong("there is no line `format`");
    const bool is_text = header.coding == Coding::text;
    const std::endian order = header.coding == Coding::big_endian ? std::endian::big : std::endian::little;

    const auto rows = static_cast<std::size_t>(header.vertices);
    ParticleTable table;
    std::vector<std::vector<double>*> columns;
    std::size_t row_bytes = 0;
    for (const Property& property : header.properties) {
        row_bytes += size_of(property.type);
        columns.push_back(nullptr);
        table.names.push_back(property.name);
        const std::string column = column_name(property.name);
        if (!is_particle_column(column)) continue;
        const auto [place, is_new] = table.columns.try_emplace(column);
        if (!is_new) return wrong("there are two properties " + property.name, "leave one of them out");
        columns.back() = &place->second;
    }
    std::string bytes(row_bytes, '\0');
    for (std::size_t row = 0; row < rows; ++row) {
        const auto cut_off = [&] {
            return wrong("the file is cut off at vertex " + std::to_string(row) + " of " + std::to_string(rows),
                         kCompleteHint);
        };
        if (!is_text && !in.read(bytes.data(), static_cast<std::streamsize>(row_bytes))) return cut_off();
        std::size_t place = 0;
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const Property& property = header.properties[k];
            double value = 0.0;
            if (is_text && !(in >> value)) {
                if (in.eof()) return cut_off();
                return wrong("vertex " + std::to_string(row) + ": " + property.name + " is not a number",
                             "numbers have a point, and blanks between them");
            }
            if (!is_text) value = read_number(property.type, order, bytes.data() + place);
            place += size_of(property.type);
            if (columns[k] != nullptr) columns[k]->push_back(value);
        }
    }
    return table;
}

}  // namespace headrace::scene
