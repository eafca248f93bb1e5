"""Recordings: MCAP files as `proto/README.md`, "Recordings", has them, read without a server."""

from __future__ import annotations

import json
import mmap
import os
import zlib
from typing import Any, Iterator, Mapping, Sequence, overload

import numpy as np

from . import _mcap as mcap
from ._json import Reply
from .errors import FileError, ParseError
from .frame import Frame
from .probe_series import Floats, ProbeSeries

_FRAMES, _EVENTS, _COMMANDS, _PROBES = 1, 2, 3, 4  # channels
_SEQ_AT = 40  # in a frame's header: its number within the stream


class Recording(Sequence[Frame]):
    """A recording: a sequence of frames, and what happened and was measured meanwhile.

    Frames are read when they are asked for. Of a file without compression they are views into the file, of which only
    what is looked at is read. A file that was cut off, is damaged or still growing is read as far as it is whole.

    Parameters
    ----------
    path : path

    Attributes
    ----------
    times : ndarray, shape (n,)
        Simulated time of each frame [s].
    is_complete : bool
        False: the file was cut off, is damaged at its end, or still growing.
    damaged_bytes : int
        Bytes that were passed over.
    gaps : int
        How often frames are missing between two that are there: lost on their way to the file, or torn out by damage.
    session, program, strategy : str
        Of the server that ran the simulation.

    Raises
    ------
    FileError
        The file cannot be read, or is compressed and the package zstandard is not installed.
    ParseError
        It is no recording; or a part of it is damaged, which is told when that is read.

    Examples
    --------
    >>> recording = Recording("dam.mcap")
    >>> recording[-1].position
    >>> recording.at(1.5).time
    >>> recording.probes["tip"].values
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        try:
            with open(self.path, "rb") as file:
                empty = os.fstat(file.fileno()).st_size == 0  # cannot be mapped
                content: mmap.mmap | bytes = b"" if empty else mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        except OSError as error:
            raise FileError(f"{self.path}: {error.strerror}", path=self.path) from error
        self._view = memoryview(content)
        if self._view[: len(mcap.MAGIC)] != mcap.MAGIC:
            raise ParseError(f"{self.path} is no recording", path=self.path, hint="recordings are MCAP files")
        self.damaged_bytes = self.gaps = 0
        summary = mcap.summary_of(self._view)
        places = None if summary is None else self._indexed(summary)
        self.is_complete = places is not None
        if places is None:
            places = list(self._scanned())
        self._places = {channel: [place for place in places if place.channel == channel]
                        for channel in (_FRAMES, _EVENTS, _COMMANDS, _PROBES)}
        self.times: Floats = np.array([place.log_time for place in self._places[_FRAMES]], dtype=np.float64) * 1e-9
        start = self._start_metadata()
        self._scene_text, self._objects_text = start.get("scene_json", "null"), start.get("objects_json", "[]")
        self.session, self.program = start.get("session", ""), start.get("program", "")
        self.strategy = start.get("strategy", "")

    # ---- frames ----

    def __len__(self) -> int:
        """n, the number of frames."""
        return len(self._places[_FRAMES])

    @overload
    def __getitem__(self, index: int) -> Frame: ...
    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        places = self._places[_FRAMES][index]
        return [self._frame(each) for each in places] if isinstance(places, list) else self._frame(places)

    def at(self, time: float) -> Frame:
        """The frame whose simulated time is nearest to `time` [s]; the first such one.

        Raises
        ------
        IndexError
            The recording has no frames.
        """
        if len(self) == 0:
            raise IndexError(f"{self.path} has no frames")
        return self[int(np.argmin(np.abs(self.times - time)))]

    def _frame(self, place: mcap.ChunkPlace) -> Frame:
        try:
            return Frame(self._message(place).data)
        except ParseError as error:
            if error.path:
                raise
            raise self._damage(place.offset, error.message) from None

    # ---- the rest ----

    @property
    def scene(self) -> Any:
        """The scene document, as loaded."""
        return json.loads(self._scene_text)

    @property
    def objects(self) -> list[Reply]:
        """The objects when the recording began."""
        return [Reply(each) for each in json.loads(self._objects_text)]

    @property
    def events(self) -> list[Reply]:
        """What happened: `proto/README.md`, "Events"."""
        return [Reply(each) for each in self._texts(_EVENTS)]

    @property
    def commands(self) -> list[Reply]:
        """The commands that were applied: ``method``, ``params``, ``step`` before which, ``time`` [s]."""
        return [Reply(each) for each in self._texts(_COMMANDS)]

    @property
    def probes(self) -> Mapping[str, ProbeSeries]:
        """The samples of each probe, by its name."""
        columns: dict[str, list[dict[str, Any]]] = {}
        rows: dict[str, list[list[float | None]]] = {}
        for instant in self._texts(_PROBES):
            for sample in instant["samples"]:
                name, values = sample["probe"], sample["values"]
                told = sample.get("columns") or columns.get(name, [])
                if len(told) != len(values):  # the chunk that told them is lost
                    told = [{"name": f"value_{k}", "unit": "?"} for k in range(len(values))]
                if name in columns and len(columns[name]) != len(told):
                    rows[name] = []  # another probe under the same name
                columns[name] = told
                rows.setdefault(name, []).append([instant["time"], *values])
        time = {"name": "time", "unit": "s"}
        return {name: ProbeSeries(name, [time, *columns[name]], rows[name]) for name in columns}

    def __repr__(self) -> str:
        span = f", t {self.times[0]:g} to {self.times[-1]:g} s" if len(self) else ""
        gaps = f", {self.gaps} gap{'s' if self.gaps > 1 else ''}" if self.gaps else ""
        return f"<Recording {self.path}: {len(self):,} frames{span}{gaps}{'' if self.is_complete else ', incomplete'}>"

    # ---- the file ----

    def _texts(self, channel: int) -> Iterator[Any]:
        for place in self._places[channel]:
            try:
                yield json.loads(bytes(self._message(place).data))
            except ValueError:
                raise self._damage(place.offset, "a message is no JSON") from None

    def _message(self, place: mcap.ChunkPlace) -> mcap.Message:
        """The one message of a chunk."""
        try:
            record = mcap.record_at(self._view, place.offset)
            if record.kind != mcap.CHUNK:
                raise mcap.Malformed("no chunk begins here")
            return self._unpacked(mcap.parse_chunk(record.content))
        except mcap.Malformed as wrong:
            raise self._damage(place.offset, str(wrong)) from None

    def _unpacked(self, chunk: mcap.Chunk) -> mcap.Message:
        content = memoryview(_decompressed(chunk, self.path)) if chunk.compression else chunk.packed
        if zlib.crc32(content) != chunk.crc:
            raise mcap.Malformed("the chunk's CRC does not match: it is damaged")
        for record in mcap.records(content):
            if record.kind == mcap.MESSAGE:
                return mcap.parse_message(record.content)
        raise mcap.Malformed("the chunk holds no message")

    def _damage(self, offset: int, what: str) -> ParseError:
        return ParseError(f"{self.path}, byte {offset}: {what}", path=self.path)

    def _indexed(self, summary: memoryview) -> list[mcap.ChunkPlace] | None:
        """From the summary, whose CRC is right. None: it does not agree with what its writer counted at the end."""
        places: list[mcap.ChunkPlace] = []
        end: dict[str, str] = {}
        try:
            for record in mcap.records(summary):
                if record.kind == mcap.CHUNK_INDEX:
                    places.append(mcap.parse_chunk_index(record.content))
                elif record.kind == mcap.METADATA_INDEX:
                    found = mcap.record_at(self._view, mcap.Cursor(record.content).number("Q"))
                    name, values = mcap.parse_metadata(found.content)
                    end = values if name == "headrace.end" else end
        except mcap.Malformed as wrong:
            raise self._damage(len(self._view), f"the summary contradicts itself: {wrong}") from None
        frames = sum(place.channel == _FRAMES for place in places)
        if end.get("frames") != str(frames) or not end.get("gaps", "").isdecimal():
            return None
        self.gaps = int(end["gaps"])
        return places

    def _scanned(self) -> Iterator[mcap.ChunkPlace]:
        """By reading the file through; what makes no sense is passed over up to the next chunk."""
        offset = len(mcap.MAGIC)
        last_seq: int | None = None  # of the frames
        while offset < len(self._view):
            try:
                record = mcap.record_at(self._view, offset)
                if record.kind == mcap.DATA_END and len(record.content) == 4:
                    self.damaged_bytes += len(self._view) - offset - record.size  # a summary that is not whole
                    return
                if record.kind not in (mcap.HEADER, mcap.METADATA, mcap.CHUNK, mcap.MESSAGE_INDEX):
                    raise mcap.Malformed("no record of a recording")
                chunk = mcap.parse_chunk(record.content) if record.kind == mcap.CHUNK else None
            except mcap.Malformed:
                resumed = self._next_chunk(offset + 1)
                self.damaged_bytes += resumed - offset
                offset = resumed
                continue
            if chunk is not None:
                try:
                    message = self._unpacked(chunk)
                    if message.channel == _FRAMES:
                        seq = int.from_bytes(message.data[_SEQ_AT : _SEQ_AT + 8], "little")
                        self.gaps += last_seq is not None and seq != last_seq + 1
                        last_seq = seq
                    yield mcap.ChunkPlace(offset, message.channel, message.log_time)
                except mcap.Malformed:
                    self.damaged_bytes += record.size
            offset += record.size

    def _next_chunk(self, offset: int) -> int:
        """Where the next thing shaped like a chunk begins; the file's end when there is none."""
        kind = bytes([mcap.CHUNK])
        while offset < len(self._view):
            window = bytes(self._view[offset : offset + (1 << 20)])
            at = window.find(kind)
            while at >= 0:
                try:
                    mcap.parse_chunk(mcap.record_at(self._view, offset + at).content)
                    return offset + at
                except mcap.Malformed:
                    at = window.find(kind, at + 1)
            offset += len(window)
        return len(self._view)

    def _start_metadata(self) -> dict[str, str]:
        """It stands right behind the header."""
        try:
            header = mcap.record_at(self._view, len(mcap.MAGIC))
            if header.kind == mcap.HEADER and mcap.Cursor(header.content).text() != "headrace":
                raise ParseError(f"{self.path} is an MCAP file of another program", path=self.path)
            metadata = mcap.record_at(self._view, len(mcap.MAGIC) + header.size)
            if metadata.kind != mcap.METADATA:
                return {}
            return mcap.parse_metadata(metadata.content)[1]
        except mcap.Malformed:
            return {}


def _decompressed(chunk: mcap.Chunk, path: str) -> bytes:
    try:
        import zstandard
    except ImportError:
        raise FileError(f"{path} is compressed, and the package zstandard is not installed", path=path,
                        hint="pip install 'headrace[zstd]', on Debian python3-zstandard") from None
    try:
        # The size that the chunk claims is not believed beforehand: memory grows with what really comes out.
        unpacked: bytes = zstandard.ZstdDecompressor().decompressobj().decompress(bytes(chunk.packed))
    except zstandard.ZstdError:
        raise mcap.Malformed("the chunk cannot be decompressed") from None
    if len(unpacked) != chunk.uncompressed_size:
        raise mcap.Malformed("the chunk has another size than it says")
    return unpacked
