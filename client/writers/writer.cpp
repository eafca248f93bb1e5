#include "client/writers/writer.h"

#include <array>
#include <cmath>
#include <system_error>

#include "client/writers/formats.h"
#include "client/writers/scene_view.h"
#include "client/writers/stage.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace {

using proto::Error;
using proto::ErrorCode;

struct Format {
    FormatInfo info;
    std::unique_ptr<Writer> (*make)(const WriterOptions&);
};

using proto::Field;
constexpr std::array<Format, 8> kFormats{{
    {{"vtp", {Field::position}, false, true}, make_vtp_writer},
    {{"csv", {}, false, false}, make_csv_writer},
    {{"csv-long", {Field::id}, false, false}, make_long_csv_writer},
    {{"npz", {}, false, false}, make_npz_writer},
    {{"ply", {Field::position}, false, false}, make_ply_writer},
    {{"png", {Field::position}, true, true}, make_picture_writer},
    {{"mp4", {Field::position}, true, true}, make_mp4_writer},
    {{"pov", {Field::position}, true, true}, make_pov_writer},
}};

proto::Status check_picture(const PictureOptions& picture) {
    // 16384 px: cairo's surfaces end at 32767, and twice the size is rasterised.
    if (picture.width < 160 || picture.height < 120 || picture.width > 16384 || picture.height > 16384)
        return Error{ErrorCode::invalid_params, "a picture is between 160 x 120 and 16384 x 16384 pixels", "picture",
                     ""};
    if (picture.sheet_frames < 0 || picture.sheet_frames > 400)
        return Error{ErrorCode::invalid_params, "a contact sheet holds 0 to 400 frames", "picture.sheet_frames", ""};
    for (const auto& end : {picture.color_min, picture.color_max})
        if (end && !std::isfinite(*end))
            return Error{ErrorCode::invalid_params, "the ends of the colour scale must be finite", "picture", ""};
    if (!(picture.view.zoom >= 0.01 && picture.view.zoom <= 1000))
        return Error{ErrorCode::invalid_params, "a zoom is between 0.01 and 1000", "picture.view.zoom",
                     "1 shows all, 2 half of it twice as large"};
    if (!(picture.fps >= 1 && picture.fps <= 240))
        return Error{ErrorCode::invalid_params, "films have 1 to 240 pictures a second", "picture.fps", ""};
    if (picture.color_min && picture.color_max && !(*picture.color_min < *picture.color_max))
        return Error{ErrorCode::invalid_params, "the colour scale must ascend", "picture.color_min", ""};
    return proto::Done{};
}

}  // namespace

std::vector<FormatInfo> writer_formats() {
    std::vector<FormatInfo> formats;
    for (const Format& format : kFormats) formats.push_back(format.info);
    return formats;
}

proto::Status Writer::write(const proto::FrameView& frame, const std::vector<PlacedObject>& objects) {
    auto rest = prepare({frame, written_++, objects});
    return rest ? (*rest)() : proto::Status(rest.error());
}

proto::Result<std::unique_ptr<Writer>> make_writer(std::string_view format, const WriterOptions& options) {
    const Format* found = nullptr;
    for (const Format& candidate : kFormats)
        if (candidate.info.name == format) found = &candidate;
    if (found == nullptr) {
        std::vector<std::string> known;
        for (const Format& candidate : kFormats) known.emplace_back(candidate.info.name);
        return Error{ErrorCode::invalid_params, "there is no file format \"" + std::string(format) + "\"", "format",
                     proto::suggest(format, known)};
    }
    if (options.stem.empty() || options.stem.find('/') != std::string::npos)
        return Error{ErrorCode::invalid_params, "file names need a stem without slashes", "stem", ""};
    if (const proto::Status checked = check_picture(options.picture); !checked) return checked.error();

    if (found->info.is_picture)
        if (const proto::Status checked = check_view(options); !checked) return checked.error();
    if (format == "mp4" && !has_ffmpeg())
        return Error{ErrorCode::file_error, "films need ffmpeg, which is not installed", "format",
                     "apt-get install ffmpeg, or choose the format png"};

    std::error_code failure;
    std::filesystem::create_directories(options.folder.empty() ? "." : options.folder, failure);
    if (failure)
        return Error{ErrorCode::file_error, "cannot make the folder: " + failure.message(), options.folder.string(),
                     ""};
    return found->make(options);
}

}  // namespace headrace::client
