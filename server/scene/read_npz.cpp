// NumPy archives, packed or not: the arrays `position` (n, 2) or (n, 3), `velocity` of the same shape, `pressure` (n,).
// Others are not looked at. Format: numpy.lib.format, versions 1.0 to 3.0.
#include <zip.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <regex>

#include "server/scene/file_bytes.h"
#include "server/scene/particle_file.h"

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;

namespace {

constexpr const char* kCompleteHint = "is the file complete? numpy.savez and headrace convert make such files";

struct CloseArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

struct Array {
    NumberType type{};
    std::endian order{};
    bool is_fortran{false};  // columns one after the other
    std::vector<std::size_t> shape;
    std::size_t values_at{};  // where its numbers begin
};

// "<f4": byte order, then what the number is.
std::optional<NumberType> number_type(const std::string& descr) {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"i1", NumberType::i1}, {"u1", NumberType::u1}, {"i2", NumberType::i2}, {"u2", NumberType::u2},
        {"i4", NumberType::i4}, {"u4", NumberType::u4}, {"i8", NumberType::i8}, {"u8", NumberType::u8},
        {"f4", NumberType::f4}, {"f8", NumberType::f8}};
    if (descr.empty() || std::string_view("|<>").find(descr[0]) == std::string_view::npos) return std::nullopt;
    for (const auto& [name, type] : kTypes)
        if (name == descr.substr(1)) return type;
    return std::nullopt;
}

// The description in front of an array; the error says what is wrong with it.
Result<Array> parse_header(const std::string& bytes) {
    const auto wrong = [](std::string message, std::string hint = kCompleteHint) {
        return Error{ErrorCode::scene_invalid, std::move(message), "", std::move(hint)};
    };
    constexpr const char* kTypeHint = "save it as float32 or float64: array.astype(numpy.float32)";
    if (bytes.size() < 12 || !bytes.starts_with("\x93NUMPY")) return wrong("is not a NumPy array");
    const auto byte = [&](std::size_t k) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[k])); };
    const std::size_t length_bytes = byte(6) == 1 ? 2 : 4;
    std::size_t length = 0;
    for (std::size_t k = length_bytes; k-- > 0;) length = length << 8 | byte(8 + k);
    Array array;
    array.values_at = 8 + length_bytes + length;
    if (array.values_at > bytes.size() || length > 4096) return wrong("has a damaged description");

    const std::string text = bytes.substr(8 + length_bytes, length);
    static const std::regex descr("'descr': *'([^']*)'"), order("'fortran_order': *(True|False)"),
        shape(R"('shape': *\(([0-9, ]*)\))");
    std::smatch found;
    if (!std::regex_search(text, found, descr)) return wrong("is not an array of plain numbers", kTypeHint);
    const auto type = number_type(found[1]);
    if (!type) return wrong("has the type " + found[1].str() + ", which is not read here", kTypeHint);
    array.type = *type;
    array.order = found[1].str()[0] == '>' ? std::endian::big : std::endian::little;
    if (!std::regex_search(text, found, order)) return wrong("has a damaged description");
    array.is_fortran = found[1] == "True";
    if (!std::regex_search(text, found, shape)) return wrong("has a damaged description");
    const std::string numbers = found[1];
    static const std::regex number("[0-9]{1,18}");
    std::size_t count = 1;
    for (std::sregex_iterator next(numbers.begin(), numbers.end(), number), end; next != end; ++next) {
        array.shape.push_back(std::stoull(next->str()));
        // Not more than there are bytes, so that the product does not overflow.
        if (array.shape.back() > bytes.size()) return wrong("is cut off");
        count *= array.shape.back();
        if (count > bytes.size()) return wrong("is cut off");
    }
    if (bytes.size() - array.values_at < count * size_of(array.type)) return wrong("is cut off");
    return array;
}

// A member of the archive, unpacked; nothing when it is not there. Memory grows with what is really there, not with the
// size that the archive claims.
Result<std::optional<std::string>> read_member(zip_t* archive, const std::string& name) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(archive, name.c_str(), 0, &stat) != 0) return std::optional<std::string>{};
    constexpr zip_uint64_t kMostBytes = kMostParticlesOfFile * 3 * 8 + 4096, kBlock = 1 << 20;
    if (stat.size > kMostBytes) return Error{ErrorCode::scene_invalid, "has too many particles", "", kTooManyHint};
    const std::unique_ptr<zip_file_t, CloseArchive> file(zip_fopen(archive, name.c_str(), 0));
    std::string bytes;
    zip_int64_t got = file ? 1 : -1;
    while (got > 0 && bytes.size() <= stat.size) {  // reading on to the end is what checks the member's CRC
        const std::size_t so_far = bytes.size();
        bytes.resize(so_far + kBlock);
        got = zip_fread(file.get(), bytes.data() + so_far, kBlock);
        bytes.resize(so_far + static_cast<std::size_t>(std::max<zip_int64_t>(got, 0)));
    }
    if (got != 0 || bytes.size() != stat.size)
        return Error{ErrorCode::scene_invalid, "cannot be unpacked", "", kCompleteHint};
    return std::optional(std::move(bytes));
}

// The columns of one array into the table.
Result<bool> take_array(zip_t* archive, const std::string& field, bool is_vector, ParticleTable& table) {
    auto bytes = read_member(archive, field + ".npy");
    if (!bytes) return bytes.error();
    if (!*bytes) return false;
    auto array = parse_header(**bytes);
    if (!array) return array.error();
    const std::vector<std::size_t>& shape = array->shape;
    const bool fits = is_vector ? shape.size() == 2 && (shape[1] == 2 || shape[1] == 3) : shape.size() == 1;
    if (!fits)
        return Error{ErrorCode::scene_invalid,
                     std::string("does not have the shape ") + (is_vector ? "(n, 2) or (n, 3)" : "(n,)"), "",
                     "n is the number of particles, the other a component of each: array.reshape, or array.T"};
    const std::size_t rows = shape[0], components = is_vector ? shape[1] : 1;
    if (rows > static_cast<std::size_t>(kMostParticlesOfFile))
        return Error{ErrorCode::scene_invalid, "has too many particles", "", kTooManyHint};
    const char* values = (*bytes)->data() + array->values_at;
    for (std::size_t axis = 0; axis < components; ++axis) {
        std::vector<double>& column = table.columns[is_vector ? field + "_" + "xyz"[axis] : field];
        column.resize(rows);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t place = array->is_fortran ? axis * rows + row : row * components + axis;
            column[row] = read_number(array->type, array->order, values + place * size_of(array->type));
        }
    }
    return true;
}

}  // namespace

Result<ParticleTable> read_npz(const std::filesystem::path& file) {
    const std::string name = file.filename();
    int failure = 0;
    const std::unique_ptr<zip_t, CloseArchive> archive(zip_open(file.c_str(), ZIP_RDONLY, &failure));
    if (!archive)
        return Error{ErrorCode::scene_invalid, name + " is not a zip archive, or not all of one", "",
                     "numpy.savez and headrace convert --format npz make .npz files"};
    ParticleTable table;
    for (const auto& [field, is_vector] : {std::pair("position", true), {"velocity", true}, {"pressure", false}}) {
        auto taken = take_array(archive.get(), field, is_vector, table);
        if (!taken) {
            Error error = taken.error();
            error.message = name + ", array " + field + " " + error.message;
            return error;
        }
    }
    for (zip_int64_t k = 0; k < zip_get_num_entries(archive.get(), 0); ++k) {
        const char* member = zip_get_name(archive.get(), static_cast<zip_uint64_t>(k), 0);
        std::string array = member != nullptr ? member : "";
        if (array.ends_with(".npy")) array.resize(array.size() - 4);
        table.names.push_back(std::move(array));
    }
    for (const auto& [column, values] : table.columns) {
        const auto& [first, first_values] = *table.columns.begin();
        if (values.size() != first_values.size())
            return Error{ErrorCode::scene_invalid,
                         name + ", array of " + column + " has " + std::to_string(values.size()) + " rows where " +
                             first + " has " + std::to_string(first_values.size()),
                         "", "a row for each particle in all of them"};
    }
    return table;
}

}  // namespace headrace::scene
