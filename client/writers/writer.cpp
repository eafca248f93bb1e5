#include "client/writers/writer.h"

#include <array>
#include <cmath>
#include <system_error>

#include "client/writers/formats.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace {

using proto::Error;
using proto::ErrorCode;

struct Format {
    std::string_view name;
    std::unique_ptr<Writer> (*make)(const WriterOptions&);
};

constexpr std::array<Format, 3> kFormats{{
    {"vtp", make_vtp_writer},
    {"csv", make_csv_writer},
    {"png", make_picture_writer},
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
    if (picture.color_min && picture.color_max && !(*picture.color_min < *picture.color_max))
        return Error{ErrorCode::invalid_params, "the colour scale must ascend", "picture.color_min", ""};
    return proto::Done{};
}

}  // namespace

std::vector<std::string> writer_formats() {
    std::vector<std::string> names;
    for (const Format& format : kFormats) names.emplace_back(format.name);
    return names;
}

proto::Result<std::unique_ptr<Writer>> make_writer(std::string_view format, const WriterOptions& options) {
    const Format* found = nullptr;
    for (const Format& candidate : kFormats)
        if (candidate.name == format) found = &candidate;
    if (found == nullptr)
        return Error{ErrorCode::invalid_params, "there is no file format \"" + std::string(format) + "\"", "format",
                     proto::suggest(format, writer_formats())};
    if (options.stem.empty() || options.stem.find('/') != std::string::npos)
        return Error{ErrorCode::invalid_params, "file names need a stem without slashes", "stem", ""};
    if (const proto::Status checked = check_picture(options.picture); !checked) return checked.error();

    std::error_code failure;
    std::filesystem::create_directories(options.folder.empty() ? "." : options.folder, failure);
    if (failure)
        return Error{ErrorCode::file_error, "cannot make the folder: " + failure.message(), options.folder.string(),
                     ""};
    return found->make(options);
}

}  // namespace headrace::client
