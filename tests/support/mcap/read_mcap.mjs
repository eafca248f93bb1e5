// Reads a recording with the reference implementation of MCAP, by its index and as a stream, with every CRC checked,
// and prints what it found as one JSON object. Exit status 1 when either reader objects or the two disagree.
// Usage: node read_mcap.mjs FILE.mcap [--cut]     (--cut: a file without its end; read as a stream only)
import { open, readFile } from "node:fs/promises";
import { isDeepStrictEqual } from "node:util";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { crc32 } from "@foxglove/crc";
import { decompress } from "fzstd";

const decompressHandlers = {
  zstd: (packed, size) => decompress(packed, new Uint8Array(Number(size))),
};

function emptySummary() {
  return { channels: {}, metadata: {}, frames: 0, first_log_time: null, last_log_time: null };
}

// A frame's own CRC: of bytes 0..123 and 128..end (proto/README.md).
function frameCrcIsRight(data) {
  const joined = Buffer.concat([data.subarray(0, 124), data.subarray(128)]);
  return crc32(joined) === Buffer.from(data.buffer, data.byteOffset, data.length).readUInt32LE(124);
}

function takeMessage(summary, channel, message) {
  summary.channels[channel.topic] ??= { encoding: channel.messageEncoding, messages: 0 };
  summary.channels[channel.topic].messages += 1;
  if (channel.messageEncoding === "json") JSON.parse(new TextDecoder().decode(message.data));
  if (channel.topic !== "frames") return;
  if (!frameCrcIsRight(message.data)) throw new Error(`frame ${message.sequence}: its CRC is wrong`);
  summary.frames += 1;
  summary.first_log_time ??= message.logTime.toString();
  summary.last_log_time = message.logTime.toString();
}

function takeMetadata(summary, record) {
  summary.metadata[record.name] = Object.fromEntries(record.metadata);
}

async function readByIndex(file) {
  const handle = await open(file);
  try {
    const readable = new FileHandleReadable(handle);
    const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
    const summary = emptySummary();
    for await (const message of reader.readMessages({ validateCrcs: true }))
      takeMessage(summary, reader.channelsById.get(message.channelId), message);
    for await (const record of reader.readMetadata()) takeMetadata(summary, record);

    let messages = 0;
    for (const channel of Object.values(summary.channels)) messages += channel.messages;
    // The reference reader does not check this one: bytes from the summary's start to the CRC, magic (8) behind it.
    const { summaryStart, summaryCrc } = reader.footer;
    const bytes = await readFile(file);
    if (crc32(bytes.subarray(Number(summaryStart), bytes.length - 12)) !== summaryCrc)
      throw new Error("the CRC of the summary is wrong");
    const statistics = reader.statistics;
    if (Number(statistics.messageCount) !== messages) throw new Error("the statistics miscount the messages");
    if (statistics.chunkCount !== reader.chunkIndexes.length) throw new Error("the statistics miscount the chunks");
    return { summary, chunks: statistics.chunkCount, profile: reader.header.profile, library: reader.header.library };
  } finally {
    await handle.close();
  }
}

async function readAsStream(file, mayBeCut) {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  reader.append(await readFile(file));
  const summary = emptySummary();
  const channels = new Map();
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Metadata") takeMetadata(summary, record);
    if (record.type === "Message") takeMessage(summary, channels.get(record.channelId), record);
  }
  if (!reader.done() && !mayBeCut) throw new Error("the stream reader misses the end of the file");
  return summary;
}

const [file, option] = process.argv.slice(2);
if (!file) {
  console.error("usage: node read_mcap.mjs FILE.mcap [--cut]");
  process.exit(2);
}
const streamed = await readAsStream(file, option === "--cut");
if (option === "--cut") {
  console.log(JSON.stringify({ ...streamed, crc_checked: true }));
} else {
  const { summary, ...rest } = await readByIndex(file);
  // The indexed reader sorts by time, so only the key order may differ.
  if (!isDeepStrictEqual(summary, streamed)) throw new Error("index and stream disagree");
  console.log(JSON.stringify({ ...summary, ...rest, crc_checked: true }));
}
