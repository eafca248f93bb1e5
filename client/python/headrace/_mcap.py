"""The part of the MCAP container format (https://mcap.dev/spec) that recordings use, for reading.

Integers are little-endian; a record is its kind (1 byte), the length of its content (8), the content. Bytes are not
trusted: whatever does not fit raises `Malformed`.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from typing import Iterator

MAGIC = b"\x89MCAP0\r\n"
RECORD_HEAD = 9  # kind and length
FOOTER_BYTES = RECORD_HEAD + 20

HEADER, FOOTER, MESSAGE, CHUNK, MESSAGE_INDEX = 0x01, 0x02, 0x05, 0x06, 0x07
CHUNK_INDEX, METADATA, METADATA_INDEX, DATA_END = 0x08, 0x0C, 0x0D, 0x0F
COMPRESSIONS = ("", "zstd")


class Malformed(Exception):
    """The bytes are no record of that kind."""


class Cursor:
    """Reads one number, text or map after the other."""

    def __init__(self, view: memoryview) -> None:
        self.rest = view

    def number(self, kind: str) -> int:
        return int(struct.unpack("<" + kind, self.bytes(struct.calcsize("<" + kind)))[0])

    def bytes(self, count: int) -> memoryview:
        if count > len(self.rest):
            raise Malformed("it ends too early")
        taken, self.rest = self.rest[:count], self.rest[count:]
        return taken

    def text(self) -> str:
        try:
            return str(self.bytes(self.number("I")), "utf-8")
        except UnicodeDecodeError:
            raise Malformed("a text is not UTF-8") from None

    def map(self) -> dict[str, str]:
        inner = Cursor(self.bytes(self.number("I")))
        found = {}
        while len(inner.rest) > 0:
            key = inner.text()
            found[key] = inner.text()
        return found


@dataclass(frozen=True)
class Record:
    kind: int
    content: memoryview

    @property
    def size(self) -> int:
        """Of the whole record [bytes]."""
        return RECORD_HEAD + len(self.content)


def record_at(view: memoryview, offset: int) -> Record:
    cursor = Cursor(view[offset:])
    kind = cursor.number("B")
    return Record(kind, cursor.bytes(cursor.number("Q")))


def records(view: memoryview) -> Iterator[Record]:
    """The records that fill `view`."""
    offset = 0
    while offset < len(view):
        record = record_at(view, offset)
        yield record
        offset += record.size


@dataclass(frozen=True)
class Chunk:
    start_time: int  # [ns]
    uncompressed_size: int
    crc: int
    compression: str
    packed: memoryview


def parse_chunk(content: memoryview) -> Chunk:
    """Lengths, sizes and times must agree with one another: other bytes do so by chance once in 2^90."""
    cursor = Cursor(content)
    start, end, size, crc = (cursor.number(kind) for kind in "QQQI")
    length = cursor.number("I")
    compression = bytes(cursor.bytes(length)).decode("ascii", "replace") if length <= 4 else "?"
    packed_size = cursor.number("Q")
    if (compression not in COMPRESSIONS or packed_size != len(cursor.rest) or start > end
            or (not compression and packed_size != size)):
        raise Malformed("the chunk's head is damaged")
    return Chunk(start, size, crc, compression, cursor.rest)


@dataclass(frozen=True)
class Message:
    channel: int
    log_time: int  # [ns]
    data: memoryview


def parse_message(content: memoryview) -> Message:
    cursor = Cursor(content)
    channel, _, log_time, _ = (cursor.number(kind) for kind in "HIQQ")
    return Message(channel, log_time, cursor.rest)


@dataclass(frozen=True)
class ChunkPlace:
    """Where a chunk with one message is."""

    offset: int
    channel: int
    log_time: int  # [ns]


def parse_chunk_index(content: memoryview) -> ChunkPlace:
    cursor = Cursor(content)
    start, _, offset, _ = (cursor.number("Q") for _ in range(4))
    channels = Cursor(cursor.bytes(cursor.number("I")))
    return ChunkPlace(offset, channels.number("H"), start)


def parse_metadata(content: memoryview) -> tuple[str, dict[str, str]]:
    cursor = Cursor(content)
    name = cursor.text()
    return name, cursor.map()


def summary_of(view: memoryview) -> memoryview | None:
    """The summary section, when footer and CRC are right."""
    footer_at = len(view) - len(MAGIC) - FOOTER_BYTES
    if footer_at < len(MAGIC) or view[-len(MAGIC):] != MAGIC:
        return None
    try:
        footer = record_at(view, footer_at)
    except Malformed:
        return None
    if footer.kind != FOOTER or len(footer.content) != 20:
        return None
    start, _, crc = struct.unpack("<QQI", footer.content)
    if not len(MAGIC) <= start <= footer_at or crc != zlib.crc32(view[start:len(view) - len(MAGIC) - 4]):
        return None
    return view[start:footer_at]
