#include "client/convert.h"

#include <algorithm>
#include <memory>
#include <thread>

#include "client/arguments.h"
#include "client/frame_files.h"
#include "client/frame_selection.h"
#include "client/interrupt.h"
#include "client/object_timeline.h"
#include "client/ordered_work.h"
#include "client/probe_csv.h"
#include "client/progress.h"
#include "client/text.h"
#include "client/writers/boxes.h"
#include "client/writers/stage.h"
#include "proto/messages_json.h"
#include "proto/recording.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace {

std::vector<std::size_t> choose_frames(const proto::RecordingReader& reader, const ConvertOptions& options) {
    std::vector<std::size_t> chosen;
    std::size_t in_range = 0;
    constexpr double kSlack = 1e-9;  // [s] times are sums of rounded time steps, and are stored in ns
    for (std::size_t k = 0; k < reader.frame_count(); ++k) {
        const double time = reader.frame_time(k);
        if (options.from && time < *options.from - kSlack) continue;
        if (options.to && time > *options.to + kSlack) continue;
        if (in_range++ % options.every == 0) chosen.push_back(k);
    }
    return chosen;
}

proto::Error no_frames(const proto::RecordingReader& reader, const ConvertOptions& options) {
    const proto::RecordingSummary& summary = reader.summary();
    if (summary.frames == 0)
        return {proto::ErrorCode::file_error, "the recording holds no frame", options.recording.string(), ""};
    return {proto::ErrorCode::file_error, "no frame in the range asked for", options.recording.string(),
            "its frames are from t " + number(summary.first_time) + " s to " + number(summary.last_time) + " s"};
}

const FormatInfo* find_format(std::string_view name) {
    static const std::vector<FormatInfo> known = writer_formats();
    const auto found = std::find_if(known.begin(), known.end(), [&](const FormatInfo& f) { return f.name == name; });
    return found == known.end() ? nullptr : &*found;
}

std::string list_fields(proto::FieldSet fields) {
    std::string text;
    for (const proto::FieldInfo& info : proto::kFields)
        if (fields.contains(info.field)) text += (text.empty() ? "" : ", ") + std::string(info.name);
    return text;
}

// The first field of `wanted` that is not in `present`.
const proto::FieldInfo* find_missing(proto::FieldSet wanted, proto::FieldSet present) {
    for (const proto::FieldInfo& info : proto::kFields)
        if (wanted.contains(info.field) && !present.contains(info.field)) return &info;
    return nullptr;
}

proto::FieldSet needed_fields(const FormatInfo& format, proto::Field color_field) {
    return format.is_picture ? format.needs | proto::FieldSet{color_field} : format.needs;
}

// A writer and the columns that it is given.
struct Output {
    std::unique_ptr<Writer> writer;
    proto::FieldSet fields;
};

// Whether the recording holds what is asked for.
proto::Status check_recorded(const ConvertOptions& options, proto::FieldSet recorded) {
    const std::string hint = "the recording holds " + list_fields(recorded);
    if (options.fields)
        if (const proto::FieldInfo* missing = find_missing(*options.fields, recorded))
            return usage_error("there is no field " + std::string(missing->name), "--fields", hint);
    if (options.region && !recorded.contains(proto::Field::position))
        return usage_error("a region needs the field position", "--region", hint);
    for (const std::string& name : options.formats)
        if (const proto::FieldInfo* missing =
                find_missing(needed_fields(*find_format(name), options.picture.color_field), recorded))
            return usage_error(name + " files need the field " + std::string(missing->name), "--format", hint);
    return proto::Done{};
}

proto::Result<std::vector<Output>> make_outputs(const ConvertOptions& options, const proto::SceneDesc& scene,
                                                std::size_t frames, const std::optional<Extents>& extents) {
    WriterOptions writer_options;
    writer_options.folder = options.folder;
    writer_options.stem = options.recording.stem().string();
    writer_options.scene = scene;
    writer_options.expected_frames = frames;
    writer_options.picture = options.picture;
    writer_options.extents = extents;
    std::vector<Output> outputs;
    for (const std::string& name : options.formats) {
        auto writer = make_writer(name, writer_options);
        if (!writer) return writer.error();
        proto::FieldSet fields;
        for (const proto::FieldInfo& info : proto::kFields) fields.insert(info.field);
        const FormatInfo& format = *find_format(name);
        if (options.fields && !format.is_picture) fields = *options.fields | format.needs;
        outputs.push_back({*std::move(writer), fields});
    }
    return outputs;
}

// One after the other until there is a particle in the region.
proto::Status check_region(proto::RecordingReader& reader, const std::vector<std::size_t>& frames,
                           const ConvertOptions& options) {
    std::vector<std::byte> bytes;
    for (const std::size_t index : frames) {
        auto frame = reader.read_frame(index);
        if (!frame) return frame.error();
        if (select_region(*frame, *options.region, bytes).info.particle_count > 0) return proto::Done{};
    }
    return usage_error("no particle is ever inside", "--region", "the domain's corners are in the scene: scene.domain");
}

// The objects, if a format shows them: a recording whose motions cannot be evaluated still is one of particles.
proto::Result<ObjectTimeline> make_timeline(const proto::RecordingReader& reader, const ConvertOptions& options,
                                            const proto::SceneDesc& scene) {
    if (std::ranges::none_of(options.formats, [](const auto& name) { return find_format(name)->shows_objects; }))
        return ObjectTimeline();
    auto objects = proto::parse_objects(reader.summary().metadata.objects_json);
    if (!objects) return objects.error();
    return ObjectTimeline::make(*std::move(objects), reader.events(), scene);
}

// What pictures of these frames have to show, as far as that is asked for. Of long recordings some frames, evenly
// spread, tell it; they are unpacked only where particles or the step matter.
proto::Result<std::optional<Extents>> find_extents(proto::RecordingReader& reader,
                                                   const std::vector<std::size_t>& frames,
                                                   const ConvertOptions& options, const proto::SceneDesc& scene,
                                                   const ObjectTimeline& timeline) {
    const bool has_pictures =
        std::ranges::any_of(options.formats, [](const auto& name) { return find_format(name)->is_picture; });
    const Reach reach = has_pictures ? needed_reach(scene, options.picture.view) : Reach::nothing;
    if (reach == Reach::nothing) return std::optional<Extents>();
    constexpr std::size_t kFrames = 48;
    const std::size_t count = std::min(frames.size(), kFrames);
    Extents extents;
    std::vector<std::byte> bytes;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t place = count == 1 ? 0 : k * (frames.size() - 1) / (count - 1);
        std::uint64_t step = 0;
        double time = reader.frame_time(frames[place]);
        if (reach == Reach::objects_and_fluid || timeline.has_changes()) {
            auto frame = reader.read_frame(frames[place]);
            if (!frame) return frame.error();
            step = frame->info.step, time = frame->info.time;
            if (options.region) frame = select_region(*frame, *options.region, bytes);
            if (reach == Reach::objects_and_fluid) include(extents.fluid, bounds_without_spray(*frame));
        }
        for (const PlacedObject& object : timeline.at(step, time))
            if (!object.is_plane())
                include(object.is_container() ? extents.containers
                                              : extents.obstacles.try_emplace(object.desc.name, kNowhere).first->second,
                        placed_bounds(object));
    }
    return std::optional(std::move(extents));
}

// What is left to do with a frame, in order, and its time.
struct Prepared {
    std::vector<Writer::InOrder> rest;
    double time{};  // [s]
};
using Work = OrderedWork<proto::Result<Prepared>>;

proto::Result<Prepared> prepare(proto::RecordingReader& reader, std::size_t index, std::size_t number,
                                const ConvertOptions& options, const ObjectTimeline& timeline,
                                const std::vector<Output>& outputs, FrameFiles& files) {
    auto frame = reader.read_frame(index);
    if (!frame) return frame.error();
    std::vector<std::byte> bytes;
    if (options.region) frame = select_region(*frame, *options.region, bytes);
    Prepared prepared{{}, frame->info.time};
    const std::vector<PlacedObject> objects = timeline.at(frame->info.step, frame->info.time);
    for (const Output& output : outputs) {
        const proto::FrameView part = select_fields(*frame, output.fields);
        auto rest = output.writer->prepare({part, number, objects});
        if (!rest) return rest.error();
        files.add(number);
        // What grows may fail; the lists of frames come last, so that none is listed of which that has failed.
        const bool grows = output.writer->frame_extension().empty();
        prepared.rest.insert(grows ? prepared.rest.begin() : prepared.rest.end(), *std::move(rest));
    }
    return prepared;
}

// Does all frames, or those up to Ctrl-C. Counts those that are done with in `conversion`, in case of an error too.
proto::Status write_frames(const std::vector<std::unique_ptr<proto::RecordingReader>>& readers,
                           const std::vector<std::size_t>& frames, const ConvertOptions& options,
                           const ObjectTimeline& timeline, const std::vector<Output>& outputs, FrameFiles& files,
                           Conversion& conversion) {
    std::vector<Work::Make> workers;
    for (const auto& own : readers)
        workers.push_back([&, source = own.get()](std::size_t number) {
            return prepare(*source, frames[number], number, options, timeline, outputs, files);
        });
    Progress progress = make_progress("converting");
    Work work(frames.size(), std::move(workers));
    std::size_t count = frames.size();
    while (conversion.frames < count) {
        auto prepared = work.next();
        if (!prepared) return prepared.error();
        for (const Writer::InOrder& rest : prepared->rest)
            if (auto done = rest(); !done) return done.error();
        ++conversion.frames;
        progress.update(static_cast<double>(conversion.frames) / static_cast<double>(frames.size()),
                        "t " + number(prepared->time) + " s");
        if (is_interrupted()) count = work.stop();
    }
    progress.finish();
    return proto::Done{};
}

// What a person finds in the folder after a failure: whole frames, nothing of the others.
proto::Error failed_after(proto::Error error, const FrameFiles& files, const Conversion& conversion,
                          std::size_t frames) {
    files.remove_from(conversion.frames);
    const bool has_probes = !conversion.probe_files.empty();
    std::string written = has_probes ? "written: the probes' files" : "nothing was written";
    if (files.has_any() && conversion.frames > 0) {
        written = "written and whole: ";
        written += conversion.frames == frames
                       ? "the files of each frame"
                       : "the first " + plural(static_cast<std::int64_t>(conversion.frames), "frame") + " of " +
                             with_thousands(static_cast<std::int64_t>(frames));
        if (has_probes) written += ", and the probes' files";
    }
    error.hint += (error.hint.empty() ? "" : "; ") + written;
    return error;
}

}  // namespace

proto::Status check_formats(const std::vector<std::string>& formats) {
    std::vector<std::string> known;
    for (const FormatInfo& format : writer_formats()) known.emplace_back(format.name);
    for (const std::string& format : formats)
        if (find_format(format) == nullptr)
            return usage_error("there is no format \"" + format + "\"", "--format", proto::suggest(format, known));
    return proto::Done{};
}

proto::Status check_fields(const std::vector<std::string>& formats, proto::FieldSet fields, proto::Field color_field) {
    for (const std::string& format : formats)
        if (const proto::FieldInfo* missing = find_missing(needed_fields(*find_format(format), color_field), fields))
            return usage_error(format + " files need the field " + std::string(missing->name), "--fields",
                               "add it, or give other formats by --format");
    return proto::Done{};
}

proto::Result<Conversion> convert(const ConvertOptions& options) {
    auto opened = proto::RecordingReader::open(options.recording);
    if (!opened) return opened.error();
    proto::RecordingReader& reader = **opened;
    Conversion conversion;
    if (options.probes) {
        auto files =
            write_probe_files(reader, {options.folder, options.recording.stem().string(), options.from, options.to});
        if (!files) return files.error();
        conversion.probe_files = *std::move(files);
    }
    if (options.formats.empty()) return conversion;
    if (auto checked = check_formats(options.formats); !checked) return checked.error();
    auto scene = proto::parse_scene(reader.summary().metadata.scene_json);
    if (!scene) return scene.error();
    const auto timeline = make_timeline(reader, options, *scene);
    if (!timeline) return timeline.error();

    const std::vector<std::size_t> frames = choose_frames(reader, options);
    if (frames.empty()) return no_frames(reader, options);
    auto first = reader.read_frame(frames.front());
    if (!first) return first.error();
    proto::FieldSet recorded;
    for (const proto::FrameColumn& column : first->columns) recorded.insert(column.field);
    if (auto checked = check_recorded(options, recorded); !checked) return checked.error();
    if (options.region)
        if (auto checked = check_region(reader, frames, options); !checked) return checked.error();
    auto extents = find_extents(reader, frames, options, *scene, *timeline);
    if (!extents) return extents.error();
    auto outputs = make_outputs(options, *scene, frames.size(), *extents);
    if (!outputs) return outputs.error();

    // Each job reads by itself: unpacking and checking frames is a good part of the work.
    std::vector<std::unique_ptr<proto::RecordingReader>> readers;
    readers.push_back(*std::move(opened));
    const std::size_t jobs = std::min<std::size_t>(
        frames.size(), options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency()));
    while (readers.size() < jobs) {
        auto another = proto::RecordingReader::open(options.recording);
        if (!another) return another.error();
        readers.push_back(*std::move(another));
    }
    std::vector<std::string> extensions;
    for (const Output& output : *outputs) extensions.emplace_back(output.writer->frame_extension());
    FrameFiles files(options.folder, options.recording.stem().string(), std::move(extensions), frames.size());
    if (auto written = write_frames(readers, frames, options, *timeline, *outputs, files, conversion); !written)
        return failed_after(written.error(), files, conversion, frames.size());
    for (const Output& output : *outputs) {
        if (auto finished = output.writer->finish(); !finished)
            return failed_after(finished.error(), files, conversion, frames.size());
        conversion.summaries.push_back(output.writer->summary());
    }
    return conversion;
}

}  // namespace headrace::client
