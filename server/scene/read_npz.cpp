// NumPy archives, packed or not: the arrays `position` (n, 2) or (n, 3), `velocity` of the same shape, `pressure` (n,).
// Others are not looked at. Format: numpy.lib.format, versions 1.0 to 3.0.
#include <zip.h>

#include <array>
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

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in the file");

struct CloseArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

struct Array {
    NumberType type{};
    bool is_fortran{false};  // columns one after the other
    std::vector<std::size_t> shape;
    std::size_t values_at{};  // where its numbers begin
};

std::optional<NumberType> number_type(const std::string& descr) {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"|i1", NumberType::i1}, {"|u1", NumberType::u1}, {"<i2", NumberType::i2}, {"<u2", NumberType::u2},
        {"<i4", NumberType::i4}, {"<u4", NumberType::u4}, {"<i8", NumberType::i8}, {"<u8", NumberType::u8},
        {"<f4", NumberType::f4}, {"<f8", NumberType::f8}};
    for (const auto& [name, type] : kTypes)
        if (name == descr) return type;
    return std::nullopt;
}

// The description in front of an array; the error says what is wrong with it.
Result<Array> parse_header(const std::string& bytes) {
    const auto wrong = [](std::string message, std::string hint = {}) {
        return Error{ErrorCode::scene_invalid, std::move(message), "", std::move(hint)};
    };
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
    if (!std::regex_search(text, found, descr)) return wrong("is not an array of plain numbers");
    const auto type = number_type(found[1]);
    if (!type)
        return wrong("has the type " + found[1].str(), "save it as float32 or float64, in the byte order of PCs");
    array.type = *type;
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

// A member of the archive, unpacked; nothing when it is not there.
Result<std::optional<std::string>> read_member(zip_t* archive, const std::string& name) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(archive, name.c_str(), 0, &stat) != 0) return std::optional<std::string>{};
    constexpr zip_uint64_t kMostBytes = kMostParticlesOfFile * 3 * 8 + 4096;
    if (stat.size > kMostBytes)
        return Error{ErrorCode::scene_invalid, "has too many particles", "", "the server takes 50,000,000"};
    const std::unique_ptr<zip_file_t, CloseArchive> file(zip_fopen(archive, name.c_str(), 0));
    std::string bytes(stat.size, '\0');
    const zip_int64_t got = file ? zip_fread(file.get(), bytes.data(), bytes.size()) : -1;
    char next = 0;  // reading on to the end is what checks the member's CRC
    if (got != static_cast<zip_int64_t>(bytes.size()) || zip_fread(file.get(), &next, 1) != 0)
        return Error{ErrorCode::scene_invalid, "cannot be unpacked", "", "is the file complete?"};
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
                     std::string("does not have the shape ") + (is_vector ? "(n, 2) or (n, 3)" : "(n,)"), "", ""};
    const std::size_t rows = shape[0], components = is_vector ? shape[1] : 1;
    const char* values = (*bytes)->data() + array->values_at;
    for (std::size_t axis = 0; axis < components; ++axis) {
        std::vector<double>& column = table[is_vector ? field + "_" + "xyz"[axis] : field];
        column.resize(rows);
        for (std::size_t row = 0; row < rows; ++row) {
            const std::size_t place = array->is_fortran ? axis * rows + row : row * components + axis;
            column[row] = read_number(array->type, values + place * size_of(array->type));
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
        return Error{ErrorCode::scene_invalid, name + " is not a zip archive", "",
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
    for (const auto& [column, values] : table)
        if (values.size() != table.begin()->second.size())
            return Error{ErrorCode::scene_invalid,
                         name + ", array of " + column + " has " + std::to_string(values.size()) + " rows where " +
                             table.begin()->first + " has " + std::to_string(table.begin()->second.size()),
                         "", ""};
    return table;
}

}  // namespace headrace::scene
