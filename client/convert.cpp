#include "client/convert.h"

#include <algorithm>
#include <memory>

#include "client/arguments.h"
#include "client/interrupt.h"
#include "client/object_timeline.h"
#include "client/probe_csv.h"
#include "client/progress.h"
#include "client/text.h"
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

proto::Result<std::vector<std::unique_ptr<Writer>>> make_writers(const ConvertOptions& options,
                                                                 const proto::SceneDesc& scene, std::size_t frames) {
    WriterOptions writer_options;
    writer_options.folder = options.folder;
    writer_options.stem = options.recording.stem().string();
    writer_options.scene = scene;
    writer_options.expected_frames = frames;
    writer_options.picture = options.picture;
    std::vector<std::unique_ptr<Writer>> writers;
    if (auto checked = check_formats(options.formats); !checked) return checked.error();
    for (const std::string& format : options.formats) {
        auto writer = make_writer(format, writer_options);
        if (!writer) return writer.error();
        writers.push_back(*std::move(writer));
    }
    return writers;
}

}  // namespace

proto::Status check_formats(const std::vector<std::string>& formats) {
    const auto known = writer_formats();
    for (const std::string& format : formats)
        if (std::find(known.begin(), known.end(), format) == known.end())
            return usage_error("there is no format \"" + format + "\"", "--format", proto::suggest(format, known));
    return proto::Done{};
}

proto::Status check_fields(const std::vector<std::string>& formats, proto::FieldSet fields, proto::Field color_field) {
    for (const std::string& format : formats) {
        proto::FieldSet needed;
        if (format == "vtp" || format == "png") needed.insert(proto::Field::position);
        if (format == "png") needed.insert(color_field);
        for (const proto::FieldInfo& info : proto::kFields)
            if (needed.contains(info.field) && !fields.contains(info.field))
                return usage_error(format + " files need the field " + std::string(info.name), "--fields",
                                   "add it, or give other formats by --format");
    }
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
    const proto::RecordingMetadata& metadata = reader.summary().metadata;
    auto scene = proto::parse_scene(metadata.scene_json);
    if (!scene) return scene.error();
    auto objects = proto::parse_objects(metadata.objects_json);
    if (!objects) return objects.error();
    const ObjectTimeline timeline(*std::move(objects), reader.events());

    const std::vector<std::size_t> frames = choose_frames(reader, options);
    if (frames.empty())
        return proto::Error{proto::ErrorCode::file_error, "no frame in the range asked for", options.recording.string(),
                            "headrace info tells which times it has"};
    auto writers = make_writers(options, *scene, frames.size());
    if (!writers) return writers.error();

    Progress progress = make_progress("converting");
    for (const std::size_t index : frames) {
        if (is_interrupted()) break;
        auto frame = reader.read_frame(index);
        if (!frame) return frame.error();
        for (const auto& writer : *writers)
            if (auto written = writer->write(*frame, timeline.at(frame->info.step)); !written) return written.error();
        ++conversion.frames;
        progress.update(static_cast<double>(conversion.frames) / static_cast<double>(frames.size()),
                        "t " + number(frame->info.time) + " s");
    }
    progress.finish();
    for (const auto& writer : *writers) {
        if (auto finished = writer->finish(); !finished) return finished.error();
        conversion.summaries.push_back(writer->summary());
    }
    return conversion;
}

}  // namespace headrace::client
