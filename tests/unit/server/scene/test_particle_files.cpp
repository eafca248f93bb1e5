// Particles from files: what the readers take, and that each thing wrong with a file is told with its name, its place
// and what to do.
#include <zip.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include "server/scene/particle_file.h"
#include "server/scene/run.h"

using namespace headrace;
namespace fs = std::filesystem;

namespace {

// A folder of its own that goes away with it.
struct Folder {
    fs::path path;
    Folder() {
        std::string name = (fs::temp_directory_path() / "headrace_particles_XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path = name;
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path / name, std::ios::binary) << bytes;
    }
    proto::Result<scene::ParticleSet> read(const std::string& name, int dimensions = 2) const {
        return scene::read_particle_file(path, name, dimensions, "scene.fluids[0].particles.file");
    }
};

// The error's message; it names the file and the member, and there is a remedy.
std::string refusal(const proto::Result<scene::ParticleSet>& got, const std::string& name) {
    if (got.ok()) return "taken";
    CHECK(got.error().code == proto::ErrorCode::scene_invalid);
    CHECK(got.error().path == "scene.fluids[0].particles.file");
    CHECK(got.error().message.find(name) != std::string::npos);
    CHECK_FALSE(got.error().hint.empty());
    return got.error().message;
}

// What is wrong with the file `name` of these bytes.
std::string refused(const std::string& name, const std::string& bytes, int dimensions = 2) {
    const Folder folder;
    folder.write(name, bytes);
    const std::string message = refusal(folder.read(name, dimensions), name);
    INFO(message);
    return message;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Numbers as they lie in a file of one byte order.
template <class Number>
std::string packed(const std::vector<double>& values, std::endian order = std::endian::little) {
    std::string bytes;
    for (const double value : values) {
        const auto number = static_cast<Number>(value);
        std::string one(sizeof number, '\0');
        std::memcpy(one.data(), &number, sizeof number);
        bytes += order == std::endian::native ? one : std::string(one.rbegin(), one.rend());
    }
    return bytes;
}

// A .npy file, described in format version 1.0.
std::string npy(const std::string& descr, const std::string& shape, const std::string& values,
                bool is_fortran = false) {
    std::string text =
        "{'descr': " + descr + ", 'fortran_order': " + (is_fortran ? "True" : "False") + ", 'shape': " + shape + ", }";
    while ((10 + text.size() + 1) % 64 != 0) text += ' ';
    text += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(text.size() & 0xFF);
    bytes += static_cast<char>(text.size() >> 8);
    return bytes + text + values;
}

// An archive of members name -> bytes.
std::string npz(const std::vector<std::pair<std::string, std::string>>& members, zip_int32_t packing = ZIP_CM_STORE) {
    const Folder folder;
    const fs::path file = folder.path / "archive";
    zip_t* archive = zip_open(file.c_str(), ZIP_CREATE, nullptr);
    REQUIRE(archive != nullptr);
    for (const auto& [name, bytes] : members) {
        zip_source_t* source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
        const zip_int64_t index = zip_file_add(archive, name.c_str(), source, 0);
        REQUIRE(index >= 0);
        REQUIRE(zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), packing, 9) == 0);
    }
    REQUIRE(zip_close(archive) == 0);
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string npz_of_positions(const std::string& array) {
    return npz({{"position.npy", array}});
}

const std::vector<double> kPlaces{1, 2, 3, 4, 5, 6};  // (1, 2), (3, 4), (5, 6)

std::vector<proto::Vec3> read_places(const std::string& name, const std::string& bytes) {
    const Folder folder;
    folder.write(name, bytes);
    const auto set = folder.read(name);
    if (!set) FAIL(set.error().message);
    return set->x;
}

const std::vector<proto::Vec3> kThree{{1, 2, 0}, {3, 4, 0}, {5, 6, 0}};

std::string ply(const std::string& format, const std::string& values, const std::string& type = "float",
                const std::string& count = "3") {
    return "ply\nformat " + format + " 1.0\ncomment made here\nelement vertex " + count + "\nproperty " + type +
           " x\nproperty " + type + " y\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n" + values;
}

}  // namespace

TEST_CASE("ParticleFile.NpzIsReadInAnyTypeOrderAndPacking") {
    const auto of = [](const std::string& descr, const std::string& values) {
        return read_places("p.npz", npz_of_positions(npy(descr, "(3, 2)", values)));
    };
    CHECK(of("'<f4'", packed<float>(kPlaces)) == kThree);
    CHECK(of("'<f8'", packed<double>(kPlaces)) == kThree);
    CHECK(of("'>f4'", packed<float>(kPlaces, std::endian::big)) == kThree);
    CHECK(of("'>f8'", packed<double>(kPlaces, std::endian::big)) == kThree);
    CHECK(of("'|i1'", packed<std::int8_t>(kPlaces)) == kThree);
    CHECK(of("'|u1'", packed<std::uint8_t>(kPlaces)) == kThree);
    CHECK(of("'<i2'", packed<std::int16_t>(kPlaces)) == kThree);
    CHECK(of("'>u2'", packed<std::uint16_t>(kPlaces, std::endian::big)) == kThree);
    CHECK(of("'<i4'", packed<std::int32_t>(kPlaces)) == kThree);
    CHECK(of("'>i8'", packed<std::int64_t>(kPlaces, std::endian::big)) == kThree);
    const std::string columns = packed<float>({1, 3, 5, 2, 4, 6});
    CHECK(read_places("p.npz", npz_of_positions(npy("'<f4'", "(3, 2)", columns, true))) == kThree);
    CHECK(read_places("p.npz", npz({{"position.npy", npy("'<f4'", "(3, 2)", packed<float>(kPlaces))}},
                                   ZIP_CM_DEFLATE)) == kThree);
    // Version 2.0 has four bytes of length.
    std::string second = npy("'<f4'", "(3, 2)", packed<float>(kPlaces));
    second[6] = 2;
    second.insert(10, 2, '\0');
    CHECK(read_places("p.npz", npz_of_positions(second)) == kThree);
}

TEST_CASE("ParticleFile.NpzWithoutPositionsTellsWhatIsThere") {
    const std::string message = refused("p.npz", npz({{"positions.npy", npy("'<f4'", "(3, 2)", packed<float>(kPlaces))},
                                                      {"time.npy", npy("'<f8'", "()", packed<double>({0.5}))}}));
    CHECK(has(message, "array position is missing; there are the arrays positions, time"));
    std::vector<std::pair<std::string, std::string>> many;
    for (int k = 0; k < 40; ++k) many.emplace_back("a" + std::to_string(k) + ".npy", "");
    CHECK(has(refused("p.npz", npz(many)), "a11, ..."));
}

TEST_CASE("ParticleFile.NpzArraysThatCannotBeTakenAreNamed") {
    const std::string values = packed<float>(kPlaces);
    const auto of = [&](const std::string& array) { return refused("p.npz", npz_of_positions(array)); };
    CHECK(has(of(npy("'<f2'", "(3, 2)", values)), "array position has the type <f2"));
    CHECK(has(of(npy("'<c8'", "(3, 2)", values)), "has the type <c8"));
    CHECK(has(of(npy("'|O'", "(3, 2)", values)), "has the type |O"));
    CHECK(has(of(npy("[('x', '<f4'), ('y', '<f4')]", "(3,)", values)), "is not an array of plain numbers"));
    CHECK(has(of(npy("'<f4'", "(6,)", values)), "does not have the shape (n, 2) or (n, 3)"));
    CHECK(has(of(npy("'<f4'", "(2, 3, 1)", values)), "does not have the shape"));
    CHECK(has(of(npy("'<f4'", "(6, 1)", values)), "does not have the shape"));
    CHECK(has(of(npy("'<f4'", "(0, 2)", "")), "there is no particle"));
    CHECK(has(of("no array at all"), "is not a NumPy array"));
    CHECK(has(of(""), "is not a NumPy array"));
    CHECK(has(of(npy("'<f4'", "(3, 2)", values).substr(0, 40)), "has a damaged description"));
    CHECK(has(of(npy("'<f4'", "(3, 2)", values.substr(0, 20))), "is cut off"));
    CHECK(has(refused("p.npz", npz({{"position.npy", npy("'<f4'", "(3, 2)", values)},
                                    {"velocity.npy", npy("'<f4'", "(2, 2)", values)}})),
              "array of velocity_x has 2 rows where position_x has 3"));
    CHECK(has(refused("p.npz", npz({{"position.npy", npy("'<f4'", "(3, 2)", values)},
                                    {"pressure.npy", npy("'<f4'", "(3, 1)", values)}})),
              "array pressure does not have the shape (n,)"));
    CHECK(has(refused("p.npz", npz_of_positions(npy("'<f4'", "(3, 2)", values)), 3), "there is no position_z"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(
        has(of(npy("'<f4'", "(3, 2)", packed<float>({1, 2, 3, nan, 5, 6}))), "position_y of particle 1 is not finite"));
    CHECK(has(of(npy("'<f4'", "(3, 2)", packed<float>({1, 2, 3, 4, -INFINITY, 6}))), "position_x of particle 2"));
}

// Sizes that no file has must neither overflow nor be allocated.
TEST_CASE("ParticleFile.HugeCountsAreRefused") {
    const std::string values = packed<float>(kPlaces);
    for (const char* shape :
         {"(4000000000, 2)", "(9223372036854775807, 2)", "(2, 9223372036854775807)", "(99999999999999999999999, 2)"})
        CHECK(has(refused("p.npz", npz_of_positions(npy("'<f4'", shape, values))), "is cut off"));
    CHECK(has(refused("p.ply", ply("ascii", "", "float", "99999999999")), "number of vertices is \"99999999999\""));
    CHECK(has(refused("p.ply", ply("ascii", "", "float", "99999999999999999999999")), "number of vertices"));
    CHECK(has(refused("p.ply", ply("ascii", "", "float", "-1")), "number of vertices is \"-1\""));
    CHECK(
        has(refused("p.ply", ply("binary_little_endian", "", "float", "50000000")), "cut off at vertex 0 of 50000000"));
    CHECK(has(refused("p.ply", ply("ascii", "1 2", "float", "50000000")), "cut off at vertex 1 of 50000000"));
}

// 104,000,000 bytes of zeros that pack into 100 kB are more particles than a server takes.
TEST_CASE("ParticleFile.PackedNpzCannotUnpackWithoutEnd") {
    const std::string zeros(std::size_t{104'000'000}, '\0');
    const std::string bomb = npz({{"position.npy", npy("'|i1'", "(52000000, 2)", zeros)}}, ZIP_CM_DEFLATE);
    CHECK(bomb.size() < 1'000'000);
    CHECK(has(refused("p.npz", bomb), "array position has too many particles"));

    // A member that claims more, or less, than it unpacks to: the sizes in the archive's directory are changed.
    const std::string array = npy("'<f4'", "(3, 2)", packed<float>(kPlaces));
    const std::string honest = npz({{"position.npy", array}}, ZIP_CM_DEFLATE);
    const std::size_t entry = honest.find("PK\x01\x02");
    REQUIRE(entry != std::string::npos);
    for (const std::uint32_t claimed : {1'000'000'000u, 100u, 4'000'000'000u}) {
        std::string lying = honest;
        std::memcpy(lying.data() + entry + 24, &claimed, sizeof claimed);  // uncompressed size
        const std::string message = refused("p.npz", lying);
        CHECK((has(message, "cannot be unpacked") || has(message, "too many particles")));
    }
    // One bit of the packed numbers: the CRC, or the unpacking, finds it.
    std::string damaged = honest;
    damaged[entry - 8] = static_cast<char>(damaged[entry - 8] ^ 0x10);
    CHECK(has(refused("p.npz", damaged), "array position cannot be unpacked"));
}

TEST_CASE("ParticleFile.CutNpzIsNoArchive") {
    const std::string whole = npz_of_positions(npy("'<f4'", "(3, 2)", packed<float>(kPlaces)));
    for (std::size_t length = 0; length < whole.size(); length += 7)
        CHECK(has(refused("p.npz", whole.substr(0, length)), "is not a zip archive, or not all of one"));
}

TEST_CASE("ParticleFile.CsvIsReadAsPeopleWriteIt") {
    CHECK(read_places("p.csv", "position_x [m],position_y [m]\n1,2\n3,4\n5,6\n") == kThree);
    CHECK(read_places("p.csv", "\"position_x\", position_y ,id\r\n1,2,0\r\n3,4,1\r\n\r\n5,6e0,2") == kThree);
    CHECK(read_places("p.csv", "\xEF\xBB\xBFposition_x,position_y\n1,2\n3,4\n5,6\n") == kThree);
}

TEST_CASE("ParticleFile.CsvErrorsNameLineAndColumn") {
    const auto of = [](const std::string& text) { return refused("p.csv", text); };
    CHECK(has(of(""), "line 1: there is no line of titles"));
    CHECK(has(of("position_x;position_y\n1;2\n"),
              "column position_x is missing; there are the columns position_x;position_y"));
    CHECK(has(of("x,y\n1,2\n"), "column position_x is missing; there are the columns x, y"));
    CHECK(has(of("position_x,position_y\n"), "there is no particle"));
    CHECK(has(of("position_x,id\n1,2\n"), "there is no position_y"));
    CHECK(has(of("position_x,position_y,position_x\n1,2,3\n"), "line 1: there are two columns position_x"));
    CHECK(has(of("position_x,position_y\n1,2\n3\n"), "line 3: 1 columns where line 1 has 2"));
    CHECK(has(of("position_x,position_y\n1,2\n3,4,5\n"), "line 3: 3 columns where line 1 has 2"));
    CHECK(has(of("position_x,position_y\n1,\n"), "line 2: column 2 (position_y) is \"\", not a number"));
    CHECK(has(of("position_x,position_y\n1,2 m\n"), "is \"2 m\", not a number"));
    CHECK(has(of("position_x,position_y\n1,1e999\n"), "is \"1e999\", not a number"));
    CHECK(has(of("position_x,position_y\n1,nan\n"), "position_y of particle 0 is not finite"));
    CHECK(has(of("position_x,position_y,velocity_x\n1,2,3\n"), "there is no velocity_y"));
    CHECK(has(of("position_x,position_y,position_z\n1,2,0\n1,2,3\n"), "position_z of particle 1 is not 0"));
}

TEST_CASE("ParticleFile.PlyIsReadAsTextAndInBothByteOrders") {
    CHECK(read_places("p.ply", ply("ascii", "1 2\n3 4\n5 6\n")) == kThree);
    CHECK(read_places("p.ply", ply("binary_little_endian", packed<float>(kPlaces))) == kThree);
    CHECK(read_places("p.ply", ply("binary_big_endian", packed<float>(kPlaces, std::endian::big))) == kThree);
    CHECK(read_places("p.ply", ply("binary_big_endian", packed<double>(kPlaces, std::endian::big), "double")) ==
          kThree);
    CHECK(read_places("p.ply", ply("binary_big_endian", packed<std::int16_t>(kPlaces, std::endian::big), "short")) ==
          kThree);
    CHECK(read_places("p.ply",
                      "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty int x\r\nproperty int y\r\n"
                      "property uchar red\r\nend_header\r\n1 2 9\r\n3 4 9\r\n5 6 9\r\n") == kThree);
}

TEST_CASE("ParticleFile.PlyErrorsNameLineOrVertex") {
    const auto of = [](const std::string& text) { return refused("p.ply", text); };
    const std::string binary = ply("binary_little_endian", packed<float>(kPlaces));
    CHECK(has(of(binary.substr(0, binary.size() - 1)), "the file is cut off at vertex 2 of 3"));
    CHECK(has(of(binary.substr(0, 60)), "there is no end of the header"));
    CHECK(has(of(""), "there is no end of the header"));
    CHECK(has(of(std::string(5'000, 'x')), "there is no end of the header"));
    CHECK(has(of("solid\n"), "line 1: a PLY file begins with `ply`"));
    CHECK(has(of(ply("ascii", "1 2\n3 4\n5\n")), "the file is cut off at vertex 2 of 3"));
    CHECK(has(of(ply("ascii", "1 2\n3 four\n")), "vertex 1: y is not a number"));
    CHECK(has(of(ply("ascii", "1 2\n3 nan\n5 6\n")), "vertex 1: y is not a number"));
    CHECK(has(of(ply("binary_middle_endian", "")), "line 2: the format binary_middle_endian is not read here"));
    CHECK(has(of(ply("ascii", "", "quad")), "line 5: a property of type quad is not read here"));
    CHECK(has(of("ply\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n12345678"),
              "there is no line `format`"));
    CHECK(has(of("ply\nformat ascii 1.0\nelement face 1\nelement vertex 1\nend_header\n"),
              "the vertices must come first"));
    CHECK(has(of("ply\nformat ascii 1.0\nend_header\n"), "there is no element `vertex`"));
    CHECK(has(of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float x\nend_header\n1 2\n"),
              "there are two properties x"));
    CHECK(has(of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float a\nproperty float y\nend_header\n1 2\n"),
              "there is no position_x"));
    CHECK(has(of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float a\nproperty float b\nend_header\n1 2\n"),
              "property x is missing; there are the properties a, b"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(has(of(ply("binary_little_endian", packed<float>({1, 2, nan, 4, 5, 6}))),
              "position_x of particle 1 is not finite"));
}

TEST_CASE("ParticleFile.IsFoundBelowTheDataFolderOnly") {
    const Folder folder;
    for (const char* name : {"missing.npz", "../p.npz", "/etc/hostname", "p.txt"}) {
        folder.write("p.txt", "");
        const auto got = folder.read(name);
        REQUIRE_FALSE(got.ok());
        CHECK(got.error().code == proto::ErrorCode::file_error);
        CHECK_FALSE(got.error().hint.empty());
    }
}

namespace {

// Water in a tank from 0.1 to 0.8 m whose particles come from the file.
proto::SceneDesc pond(const std::string& model) {
    proto::SceneDesc scene;
    scene.name = "pond";
    scene.dimensions = 2;
    scene.model = model;
    scene.spacing = 0.1;
    scene.domain = {{-1, -1, 0}, {2, 2, 0}};
    scene.fluids.resize(1);
    scene.fluids[0].name = "water";
    scene.fluids[0].particles = proto::ParticleFileDesc{"p.csv"};
    scene.objects.push_back({"tank", proto::ObjectRole::container, proto::BoxDesc{{0.1, 0.1, 0}, {0.8, 0.8, 0}}});
    return scene;
}

}  // namespace

// 0.8 in single precision is 0.800000012, and 0.6 is 0.600000024: what a frame holds of a particle on a wall may lie
// beyond it.
TEST_CASE("ParticleFile.RoundingPutsNoParticleBeyondAWall") {
    const Folder folder;
    const auto build = [&](proto::SceneDesc scene, double x, double y) {
        char text[100];
        std::snprintf(text, sizeof text, "position_x,position_y\n0.45,0.45\n%.17g,%.17g\n", x, y);
        folder.write("p.csv", text);
        return scene::Run::build(scene, nullptr, folder.path);
    };
    const double single = static_cast<double>(0.8f);
    REQUIRE(single > 0.8);
    const double ulp = static_cast<double>(std::nextafter(0.8f, 1.0f)) - single;
    for (const char* model : {"thesis", "wcsph"}) {
        for (const auto& [x, y] : {std::pair(single, 0.45),
                                   {0.45, single},
                                   {single, single},
                                   {0.8 + ulp, 0.45},
                                   {0.1 - ulp / 16.0, 0.45}}) {  // at 0.1 a unit is an eighth of that at 0.8
            CAPTURE(model, x, y);
            const auto run = build(pond(model), x, y);
            if (!run) FAIL(run.error().message);
            for (int k = 0; k < 5; ++k) CHECK_FALSE((*run)->step().fault.has_value());
        }
        const auto far = build(pond(model), 0.801, 0.45);
        REQUIRE_FALSE(far.ok());
        CHECK(far.error().path == "scene.fluids[0].particles");
        CHECK(far.error().message == "reaches out of container \"tank\" with particle 1 at (0.801, 0.45) m");
        CHECK(has(far.error().hint, "leave the particle out of the file, or enlarge the container"));
    }

    // Obstacles and the domain itself.
    proto::SceneDesc scene = pond("wcsph");
    scene.objects.push_back({"box", proto::ObjectRole::obstacle, proto::BoxDesc{{0.6, 0.1, 0}, {0.8, 0.2, 0}}});
    CHECK(static_cast<double>(0.6f) > 0.6);
    CHECK(build(scene, static_cast<double>(0.6f), 0.15).ok());
    CHECK(has(build(scene, 0.61, 0.15).error().message, "overlaps obstacle \"box\" with particle 1"));
    scene = pond("thesis");
    scene.objects.clear();
    scene.domain = {{0.1, 0.1, 0}, {0.8, 0.8, 0}};
    const auto run = build(scene, single, 0.45);
    REQUIRE(run.ok());
    CHECK(std::count((*run)->particles().x[0].begin(), (*run)->particles().x[0].end(), 0.8) == 1);
    CHECK(has(build(scene, 0.8 + 4 * ulp, 0.45).error().message, "reaches out of the domain"));
}
