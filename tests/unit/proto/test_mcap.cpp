#include <catch2/catch.hpp>

#include "proto/mcap.h"

using namespace headrace::proto::mcap;

namespace {

std::vector<unsigned> numbers(const Bytes& bytes) {
    std::vector<unsigned> out;
    for (std::byte b : bytes) out.push_back(std::to_integer<unsigned>(b));
    return out;
}

}  // namespace

TEST_CASE("Mcap.CrcIsTheOneOfZip") {
    Bytes text;
    put_bytes(text, "123456789");
    CHECK(crc32(text) == 0xCBF43926);  // the published check value of CRC-32/ISO-HDLC
    CHECK(crc32(ByteView(text).subspan(4), crc32(ByteView(text).first(4))) == 0xCBF43926);
    CHECK(crc32({}, 0x1234) == 0x1234);
}

TEST_CASE("Mcap.RecordsAreOpcodeLengthContent") {
    Bytes out;
    {
        const OpenRecord record(out, Op::metadata);
        put_string(out, "ab");
        put_map(out, {{"k", "v"}});
    }
    CHECK(numbers(out) == std::vector<unsigned>{0x0C, 20, 0, 0, 0, 0, 0, 0, 0,   2, 0, 0, 0, 'a', 'b',
                                                10,   0,  0, 0, 1, 0, 0, 0, 'k', 1, 0, 0, 0, 'v'});
}

TEST_CASE("Mcap.CursorNeverReadsBeyondTheEnd") {
    Bytes out;
    put_string(out, "text");
    put_map(out, {{"key", "value"}});
    for (std::size_t size = 0; size <= out.size(); ++size) {
        const Bytes cut(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size));  // a block of its own: see asan
        Cursor cursor(cut);
        const std::string text = cursor.string();
        const StringMap map = cursor.map();
        CHECK(cursor.ok() == (size == out.size()));
        if (cursor.ok()) CHECK((text == "text" && map == StringMap{{"key", "value"}}));
    }
}

TEST_CASE("Mcap.ChunkHeadsMustAgreeWithTheirLengths") {
    ChunkHead head;
    head.start_time = 5;
    head.end_time = 6;
    head.uncompressed_size = head.records_size = 100;
    head.compression = GENERATE("", "zstd");
    Bytes out;
    put_chunk_head(out, head);
    const ByteView content = ByteView(out).subspan(kRecordHead);
    const std::uint64_t length = head.size() + 100;
    REQUIRE(read_chunk_head(content, length));
    CHECK_FALSE(read_chunk_head(content, length + 1));
    CHECK_FALSE(read_chunk_head(content, length - 1));
    CHECK_FALSE(read_chunk_head(content, 3));
    CHECK_FALSE(read_chunk_head(content.first(20), length));
    Bytes other = out;
    other[kRecordHead] = std::byte{7};  // start after end
    CHECK_FALSE(read_chunk_head(ByteView(other).subspan(kRecordHead), length));
}

TEST_CASE("Mcap.ChunkIndexRoundTrip") {
    ChunkIndex index{1, 2, 3, 4, {{7, 8}, {9, 10}}, 11, "zstd", 12, 13};
    Bytes out;
    put_chunk_index(out, index);
    Cursor cursor(out);
    const auto record = next_record(cursor);
    REQUIRE((record && record->op == Op::chunk_index && cursor.done()));
    const auto back = read_chunk_index(record->content);
    REQUIRE(back);
    CHECK(back->start_time == 1);
    CHECK(back->end_time == 2);
    CHECK(back->offset == 3);
    CHECK(back->length == 4);
    CHECK(back->message_indexes == index.message_indexes);
    CHECK(back->message_index_length == 11);
    CHECK(back->compression == "zstd");
    CHECK(back->records_size == 12);
    CHECK(back->uncompressed_size == 13);
    CHECK_FALSE(read_chunk_index(record->content.first(60)));
}
