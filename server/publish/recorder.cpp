#include "server/publish/recorder.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "proto/messages_json.h"
#include "proto/path_below.h"
#include "proto/version.h"
#include "server/publish/encode.h"
#include "server/publish/report.h"

namespace headrace::publish {

using proto::Error;
using proto::ErrorCode;
namespace fs = std::filesystem;

namespace {

std::string hex(std::uint64_t number) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
    return text;
}

}  // namespace

// Files only below the data folder, links resolved.
proto::Result<fs::path> Recorder::resolve(const std::string& file) const {
    const fs::path relative(file);
    const char* const hint = "give a path below the server's data folder (headraced --data) that ends in .mcap";
    if (relative.extension() != ".mcap")
        return Error{ErrorCode::file_error, "a recording's name ends in .mcap", "params.file", hint};
    auto path = proto::path_below(data_folder_, file, "params.file", hint);
    if (!path) return path;
    std::error_code error;
    if (!fs::is_directory(path->parent_path(), error))
        return Error{ErrorCode::file_error, "no folder " + relative.parent_path().string(), "params.file",
                     "make the folder on the server's machine first"};
    return path;
}

proto::Result<proto::RecordStartReply> Recorder::start(const proto::RecordStart& request) {
    if (recordings_.size() >= kMost)
        return Error{ErrorCode::limit_exceeded, "there are " + std::to_string(kMost) + " recordings already", "",
                     "record.stop some first"};
    const auto now = board_.read();
    if (!now->scene) return Error{ErrorCode::wrong_state, "no scene is loaded", "", "load a scene first (scene.load)"};
    proto::Result<fs::path> path = resolve(request.file);
    if (!path) return path.error();

    const proto::RecordingMetadata metadata{proto::scene_text(*now->scene), proto::objects_text(*now->objects),
                                            hex(session_), std::string("headraced ") + proto::kProgramVersion,
                                            now->status.strategy.value_or("")};
    auto writer = proto::RecordingWriter::create(*path, metadata, {request.compression, request.overwrite});
    if (!writer) return writer.error();

    Recording recording;
    recording.file = request.file;
    recording.fields = request.fields.empty() ? now->scene->output.fields : request.fields;
    recording.writer = std::move(*writer);
    recording.generation = hub_.generation();
    recording.first_event = events_.last_seq();
    Demand demand;
    demand.fields = recording.fields;
    demand.precision = request.precision;
    demand.trigger = request.every_steps ? Trigger::every_steps : Trigger::interval;
    demand.every_steps = request.every_steps.value_or(1);
    demand.interval = request.interval.value_or(now->scene->output.interval);
    demand.credits = 4;  // enough to write one while the next is computed
    // The samples of the present state, and all that come.
    const server::ProbeBoard::Instant present = probes_.begin_queue();
    recording.first_instant = present.number;
    recording.demand = hub_.add(demand);
    if (present.number > 0 && present.generation == recording.generation && present.samples.time >= now->status.time)
        if (const proto::Status written = recording.writer->write_probes(present.samples); !written) {
            hub_.remove(recording.demand);
            if (recordings_.empty()) probes_.end_queue();
            return written.error();
        }

    const std::string id = "rec/" + std::to_string(++started_);
    recordings_.emplace(id, std::move(recording));
    report("record.started", id, "recording to " + request.file);
    return proto::RecordStartReply{id, request.file, now->status.step, now->status.time};
}

proto::Result<proto::RecordStopReply> Recorder::stop(const std::optional<std::string>& recording) {
    if (!recording && recordings_.size() > 1) {
        std::string known;
        for (const auto& [id, entry] : recordings_) known += (known.empty() ? "" : ", ") + id;
        return Error{ErrorCode::invalid_params, "there are several recordings", "params.recording",
                     "name one: " + known};
    }
    const auto place = recording ? recordings_.find(*recording) : recordings_.begin();
    if (place == recordings_.end())
        return Error{ErrorCode::recording_not_found,
                     recording ? "no recording \"" + *recording + "\"" : "nothing is being recorded",
                     "params.recording", "start one with record.start"};
    return finish(place, "as asked");
}

void Recorder::stop_all(const std::string& why) {
    take_probes();
    while (!recordings_.empty()) finish(recordings_.begin(), why);
}

proto::RecordStopReply Recorder::finish(Place place, const std::string& why) {
    auto& [id, recording] = *place;
    hub_.remove(recording.demand);
    const proto::Status finished = recording.writer->finish();
    const auto now = board_.read();
    proto::RecordStopReply reply{id,
                                 recording.file,
                                 recording.writer->frames(),
                                 recording.writer->gaps(),
                                 static_cast<std::int64_t>(recording.writer->bytes()),
                                 now->status.step,
                                 now->status.time};
    if (finished)
        report("record.stopped", id, std::to_string(reply.frames) + " frames in " + recording.file + ", ended " + why);
    else
        report("record.failed", id, finished.error().message + "; complete frames stay readable");
    forget(place);
    return reply;
}

Recorder::Place Recorder::find(DemandId demand) {
    return std::find_if(recordings_.begin(), recordings_.end(),
                        [&](const auto& entry) { return entry.second.demand == demand; });
}

bool Recorder::deliver(const CaptureFor& capture) {
    Place place = find(capture.demand);
    if (place == recordings_.end()) return false;
    if (capture.capture->generation != place->second.generation) {
        take_probes();  // what was sampled before the end; it may end by that
        place = find(capture.demand);
        if (place != recordings_.end()) finish(place, "because another scene was loaded");
        return true;
    }
    auto& [id, recording] = *place;
    const zmq::message_t frame = encode_capture(*capture.capture, recording.fields, id, session_, ++recording.seq);
    const proto::Status written =
        recording.writer->write_frame({static_cast<const std::byte*>(frame.data()), frame.size()});
    hub_.release(recording.demand);
    if (!written) fail(place, written.error());
    return true;
}

bool Recorder::fail(DemandId demand, const std::string& why) {
    const Place place = find(demand);
    if (place == recordings_.end()) return false;
    fail(place, {ErrorCode::internal_error, why, "", "what was recorded before stays readable"});
    return true;
}

void Recorder::take_probes() {
    for (const server::ProbeBoard::Instant& instant : probes_.take()) {
        for (auto place = recordings_.begin(); place != recordings_.end();) {
            const auto current = place++;
            Recording& recording = current->second;
            if (instant.number <= recording.first_instant || instant.generation != recording.generation) continue;
            if (const proto::Status written = recording.writer->write_probes(instant.samples); !written)
                fail(current, written.error());
        }
    }
}

void Recorder::write_event(const proto::Event& event) {
    for (auto place = recordings_.begin(); place != recordings_.end();) {
        const auto current = place++;
        if (event.seq <= current->second.first_event) continue;
        if (const proto::Status written = current->second.writer->write_event(event); !written)
            fail(current, written.error());
    }
}

void Recorder::write_command(const std::string& json, double time) {
    for (auto place = recordings_.begin(); place != recordings_.end();) {
        const auto current = place++;
        if (const proto::Status written = current->second.writer->write_command(json, time); !written)
            fail(current, written.error());
    }
}

void Recorder::fail(Place place, const Error& error) {
    hub_.remove(place->second.demand);
    report("record.failed", place->first, error.message + "; " + error.hint);
    forget(place);
}

void Recorder::forget(Place place) {
    recordings_.erase(place);
    if (recordings_.empty()) probes_.end_queue();
}

void Recorder::report(const std::string& type, const std::string& recording, const std::string& message) const {
    publish::report(events_, board_, type, message, {{"recording", recording}});
}

}  // namespace headrace::publish
