// convert, info
#include "client/arguments.h"
#include "client/command.h"
#include "client/convert.h"
#include "client/text.h"
#include "proto/recording.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace {

struct ConvertWords {
    std::string file, formats, out, color_by{"velocity"}, range, size, fields, region, palette{"viridis"},
        view{"standard"}, camera, target, up, crop{"fluid"};
    double fps{30}, zoom{1};
    std::optional<double> from, to;
    std::size_t every{1};
    int jobs{0};
    std::optional<int> sheet;
    bool sheet_only{false}, probes{false};
};

// The place of a word among names.
template <std::size_t n>
proto::Result<std::size_t> find_name(const std::array<std::string_view, n>& names, const std::string& word,
                                     const std::string& option) {
    for (std::size_t k = 0; k < n; ++k)
        if (names[k] == word) return k;
    return usage_error("there is no \"" + word + "\"", option, proto::suggest(word, {names.begin(), names.end()}));
}

proto::Status take_view(const ConvertWords& words, PictureOptions& picture) {
    auto palette = find_name(kPaletteNames, words.palette, "--palette");
    if (!palette) return palette.error();
    picture.palette = static_cast<Palette>(*palette);
    auto view = find_name(kViewNames, words.view, "--view");
    if (!view) return view.error();
    picture.view.name = static_cast<ViewName>(*view);
    const auto take = [](const std::string& word, const char* option, std::optional<proto::Vec3>& into) {
        if (word.empty()) return proto::Status(proto::Done{});
        auto vector = parse_vector(word, option);
        if (!vector) return proto::Status(vector.error());
        into = *vector;
        return proto::Status(proto::Done{});
    };
    if (auto taken = take(words.camera, "--camera", picture.view.position); !taken) return taken;
    if (auto taken = take(words.target, "--target", picture.view.target); !taken) return taken;
    if (auto taken = take(words.up, "--up", picture.view.up); !taken) return taken;
    picture.view.zoom = words.zoom;
    picture.view.whole = words.crop == "scene";
    if (words.crop == "scene" || words.crop == "fluid") return proto::Done{};
    auto box = parse_box(words.crop, "--crop");
    if (!box)
        return usage_error("\"" + words.crop + "\" is no part of a scene", "--crop",
                           "fluid, scene, or corners in metres: x0,y0,x1,y1 or x0,y0,z0,x1,y1,z1");
    picture.view.crop = *box;
    return proto::Done{};
}

proto::Result<ConvertOptions> convert_options(const ConvertWords& words) {
    ConvertOptions options;
    options.recording = words.file;
    options.folder = words.out;
    if (!words.formats.empty()) options.formats = split(words.formats, ',');
    if (options.formats.empty() && !words.probes)
        return usage_error("nothing to convert to", "--format",
                           "give a --format (headrace convert --help lists them), or --probes");
    options.probes = words.probes;
    options.every = words.every;
    options.from = words.from;
    options.to = words.to;
    options.jobs = words.jobs;
    if (words.from && words.to && *words.from > *words.to)
        return usage_error("the range ends before it begins", "--to", "give --from the smaller time");
    if (!words.fields.empty()) {
        auto fields = parse_fields(words.fields);
        if (!fields) return fields.error();
        options.fields = *fields;
    }
    if (!words.region.empty()) {
        auto region = parse_box(words.region, "--region");
        if (!region) return region.error();
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (region->min[axis] > region->max[axis])
                return usage_error("the second corner must not be below the first", "--region",
                                   "x0,y0,x1,y1 or x0,y0,z0,x1,y1,z1, ascending");
        options.region = *region;
    }
    const auto field = parse_color_field(words.color_by);
    if (!field) return field.error();
    options.picture.color_field = *field;
    if (!words.range.empty()) {
        auto range = parse_range(words.range);
        if (!range) return range.error();
        options.picture.color_min = range->first;
        options.picture.color_max = range->second;
    }
    if (!words.size.empty()) {
        auto size = parse_size(words.size);
        if (!size) return size.error();
        options.picture.width = size->first;
        options.picture.height = size->second;
    }
    if (auto seen = take_view(words, options.picture); !seen) return seen.error();
    options.picture.fps = words.fps;
    if (words.sheet) options.picture.sheet_frames = *words.sheet;
    options.picture.every_frame = !words.sheet_only;
    return options;
}

proto::Status convert_file(const Globals& globals, const ConvertWords& words) {
    auto options = convert_options(words);
    if (!options) return options.error();
    auto conversion = convert(*options);
    if (!conversion) return conversion.error();
    if (globals.json) {
        print_json({{"frames", conversion->frames},
                    {"summaries", conversion->summaries},
                    {"probe_files", conversion->probe_files}});
        return proto::Done{};
    }
    // The first format is what the user opens next; the others are there as well.
    for (std::size_t k = 0; k < conversion->summaries.size(); ++k)
        k == 0 ? print_line(conversion->summaries[k]) : print_note(conversion->summaries[k]);
    for (const std::string& file : conversion->probe_files)
        options->formats.empty() ? print_line(file) : print_note(file);
    return proto::Done{};
}

proto::Status info(const Globals& globals, const std::string& file) {
    auto opened = proto::RecordingReader::open(file);
    if (!opened) return opened.error();
    const proto::RecordingSummary& summary = (*opened)->summary();
    auto scene = proto::parse_scene(summary.metadata.scene_json);
    const std::string scene_name = scene ? scene->name : "?";
    std::string fields;
    std::uint64_t particles = 0;
    if ((*opened)->frame_count() > 0) {
        auto frame = (*opened)->read_frame(0);
        if (!frame) return frame.error();
        particles = frame->info.particle_count;
        for (const proto::FrameColumn& column : frame->columns)
            fields += (fields.empty() ? "" : ",") + std::string(proto::field_info(column.field).name);
    }
    if (globals.json) {
        print_json({{"file", file},
                    {"complete", summary.complete},
                    {"damaged_bytes", summary.damaged_bytes},
                    {"frames", summary.frames},
                    {"gaps", summary.gaps},
                    {"first_time", summary.first_time},
                    {"last_time", summary.last_time},
                    {"scene", scene_name},
                    {"particles", particles},
                    {"fields", split(fields, ',')},
                    {"events", (*opened)->events().size()},
                    {"program", summary.metadata.program},
                    {"strategy", summary.metadata.strategy},
                    {"session", summary.metadata.session}});
        return proto::Done{};
    }
    print_line(
        file + ": " + (summary.complete ? "complete" : "cut off, readable as far as it goes") + ", " +
        recording_summary(summary.frames, summary.gaps) +
        (summary.frames > 0 ? ", t " + number(summary.first_time) + " s to " + number(summary.last_time) + " s" : ""));
    if (summary.damaged_bytes > 0)
        print_line(plural(static_cast<std::int64_t>(summary.damaged_bytes), "damaged byte") + " skipped");
    print_line("scene " + scene_name + ", " + plural(static_cast<std::int64_t>(particles), "particle") + ", fields " +
               fields + ", " + plural(std::ssize((*opened)->events()), "event"));
    print_line("made by " + summary.metadata.program + ", session " + summary.metadata.session +
               (summary.metadata.strategy.empty() ? "" : ", " + summary.metadata.strategy));
    return proto::Done{};
}

}  // namespace

void add_file_commands(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<ConvertWords>();
    CLI::App* converter = add_command(app, line, "convert", "turn a recording into files for other programs",
                                      [words](const Globals& globals) { return convert_file(globals, *words); });
    converter->add_option("FILE", words->file, "a recording, .mcap")->required();
    converter->add_option("--format", words->formats,
                          "several with commas: vtp (ParaView), csv (one table per frame), csv-long (one for all), "
                          "npz (NumPy), ply (point clouds), png, mp4 (a film, by ffmpeg), pov (POV-Ray)");
    converter->add_option("--out", words->out, "folder of the results")->required();
    converter->add_flag("--probes", words->probes, "a CSV file with the samples of each probe");
    converter->add_option("--every", words->every, "each so many-th frame")->check(positive());
    converter->add_option("--from", words->from, "first time [s]");
    converter->add_option("--to", words->to, "last time [s]");
    converter->add_option("--fields", words->fields, "which of the recorded fields, with commas; pictures take theirs");
    converter->add_option("--region", words->region, "only particles inside x0,y0,x1,y1 or x0,y0,z0,x1,y1,z1 [m]");
    converter->add_option("--jobs", words->jobs, "frames in work at a time; default: the cores")
        ->check(CLI::Range(1, 1'024));
    converter
        ->add_option("--color-by,--field", words->color_by,
                     "pictures: what the colours show: a field, speed for that of velocity")
        ->capture_default_str();
    converter->add_option("--palette", words->palette, "pictures: viridis, cividis, magma, coolwarm")
        ->capture_default_str();
    converter->add_option("--view", words->view, "pictures in 3D: standard, front, side, top, iso")
        ->capture_default_str();
    converter->add_option("--camera", words->camera, "pictures in 3D: the eye's place x,y,z [m] instead of a view");
    converter->add_option("--target", words->target, "the point x,y,z that the eye looks at [m]; default: the middle");
    converter->add_option("--up", words->up, "upwards for the eye, x,y,z; default: against gravity");
    converter
        ->add_option(
            "--crop", words->crop,
            "pictures: what fills them, the same for all frames: fluid (what it reaches in 48 frames spread over "
            "the recording, less 0.2 % of spray on each side), scene (all), or x0,y0,x1,y1 or "
            "x0,y0,z0,x1,y1,z1 [m]")
        ->capture_default_str();
    converter->add_option("--zoom", words->zoom, "pictures: so many times as large, about the middle or --target")
        ->capture_default_str();
    converter->add_option("--fps", words->fps, "films: frames a second")->capture_default_str();
    converter->add_option("--range", words->range, "pictures: ends of the colour scale, low:high");
    converter->add_option("--size", words->size, "pictures: WIDTHxHEIGHT in pixels");
    converter->add_option("--sheet", words->sheet, "pictures: how many on the contact sheet; 0: no sheet")
        ->check(CLI::Range(0, 400));
    converter->add_flag("--sheet-only", words->sheet_only, "pictures: the contact sheet alone");

    auto file = std::make_shared<std::string>();
    add_command(app, line, "info", "tell what a recording holds",
                [file](const Globals& globals) { return info(globals, *file); })
        ->add_option("FILE", *file, "a recording, .mcap")
        ->required();
}

}  // namespace headrace::client
