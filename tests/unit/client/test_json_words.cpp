#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "client/json_words.h"

using namespace headrace;
using namespace headrace::client;

TEST_CASE("JsonWords.AreJsonOrTheNameOfAFile") {
    CHECK((*json_word(R"({"a": 1})", "--motion"))["a"] == 1);
    CHECK((*json_word(" [1, 2]", "--motion"))[1] == 2);

    const auto file = std::filesystem::temp_directory_path() / "headrace_json_words_test.json";
    std::ofstream(file) << R"({"a": 2})";
    CHECK((*json_word(file.string(), "--motion"))["a"] == 2);
    std::ofstream(file) << "{1}";
    CHECK(json_word(file.string(), "--motion").error().path.starts_with(file.string()));
    std::filesystem::remove(file);

    const auto missing = json_word(file.string(), "--motion");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == proto::ErrorCode::file_error);
    CHECK(missing.error().hint.find("--motion") != std::string::npos);
    CHECK(json_word(std::filesystem::temp_directory_path().string(), "--motion").error().message == "is a folder");
    const auto broken = json_word("{", "--motion");
    REQUIRE_FALSE(broken);
    CHECK(broken.error().code == proto::ErrorCode::parse_error);
    CHECK(broken.error().path.starts_with("--motion"));
}

TEST_CASE("JsonWords.AProbeHasANameAndAKind") {
    CHECK(parse_probe(R"(tip={"front": {}})")->name == "tip");
    CHECK(parse_probe(R"(tip={"kind": {"front": {}}, "interval": 0.5})")->interval == 0.5);
    for (const char* word : {"tip", "=1", ""}) {
        const auto refused = parse_probe(word);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == proto::ErrorCode::usage);
        CHECK(refused.error().path == "--probe");
    }
    CHECK(parse_probe(R"(tip={"frnt": {}})").error().path.starts_with("--probe tip"));
    CHECK(parse_probe("tip={").error().path.starts_with("--probe tip"));
}
