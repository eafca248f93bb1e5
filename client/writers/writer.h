// Other programs' file formats, one per file behind one small interface.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/writers/boxes.h"
#include "client/writers/palette.h"
#include "client/writers/placed_object.h"
#include "proto/frame.h"
#include "proto/result.h"
#include "proto/scene_desc.h"

namespace headrace::client {

enum class ViewName { standard, front, side, top, iso };
inline constexpr std::array<std::string_view, 5> kViewNames{"standard", "front", "side", "top", "iso"};

// From where a 3D scene is seen and how much of it, as large as it fits. 2D scenes are seen from the front.
struct ViewOptions {
    ViewName name{ViewName::standard};      // standard: from the front, a little from the right and above
    std::optional<proto::Vec3> position;    // [m] of the eye, instead of the name
    std::optional<proto::Vec3> target, up;  // looked at, upwards; absent: the middle, against gravity
    std::optional<proto::BoxDesc> crop;     // [m] what fills the picture; 2D: without regard to z
    bool whole{false};                      // without `crop`: all of the scene, also where no fluid ever comes
    double zoom{1};                         // so many times as large, about the target or the picture's middle
};

// What the frames of a conversion reach. [m]
struct Extents {
    proto::BoxDesc fluid{kNowhere};       // but for a little spray
    proto::BoxDesc containers{kNowhere};  // planes left out, here and below
    std::map<std::string, proto::BoxDesc> obstacles;
};

// How pictures look; other formats ignore it.
struct PictureOptions {
    Palette palette{Palette::viridis};
    ViewOptions view;
    double fps{30};                                    // films: pictures a second
    proto::Field color_field{proto::Field::velocity};  // vectors: their magnitude
    // Ends of the colour scale, in the field's unit. Absent: guessed once from the scene, the same for all frames.
    std::optional<double> color_min, color_max;
    int width{1280}, height{720};  // [px] of each frame's picture
    int sheet_frames{12};          // pictures on the contact sheet; 0: no sheet
    bool every_frame{true};        // false: the contact sheet only
};

struct WriterOptions {
    std::filesystem::path folder;  // created when missing
    std::string stem;              // files are <stem>_000123.vtp and the like
    proto::SceneDesc scene;
    std::size_t expected_frames{0};  // 0: not known, and frames come one after the other; spreads the contact sheet
    std::optional<Extents> extents;  // absent: not known, and pictures show all of the scene
    PictureOptions picture;
};

// One frame of a conversion.
struct FrameTask {
    const proto::FrameView& frame;
    std::size_t number{};  // among the frames converted, from 0
    // Of this frame, after events and commands, where they stand then; for formats that show them.
    const std::vector<PlacedObject>& objects;
};

// After an error the writer only wants to be destroyed; files of the frames before it are whole.
class Writer {
  public:
    // What is left to do with a frame when all frames before it are done with.
    using InOrder = std::function<proto::Status()>;

    virtual ~Writer() = default;

    // The work on one frame. On any thread, several frames at a time and in any order; what it returns is called on one
    // thread, in ascending order of the frames. Neither bytes nor objects are kept.
    virtual proto::Result<InOrder> prepare(const FrameTask& task) = 0;
    virtual proto::Status finish() = 0;       // index files; call once, after the last frame
    virtual std::string summary() const = 0;  // for a person: what was written and how to open it
    // Of the file that prepare() writes of each frame, <stem>_000123.<extension>; empty: frames get none of their own.
    virtual std::string_view frame_extension() const { return {}; }

    // The same for frames that come one after the other.
    proto::Status write(const proto::FrameView& frame, const std::vector<PlacedObject>& objects);

  private:
    std::size_t written_{0};  // by write()
};

struct FormatInfo {
    std::string_view name;
    proto::FieldSet needs;  // pictures besides: the field that the colours show
    bool is_picture;        // draws what it needs; other formats store all fields that are chosen
    bool shows_objects;     // others take no notice of a task's objects
};

std::vector<FormatInfo> writer_formats();

// Errors: invalid_params for an unknown format or unusable options, file_error when the folder cannot be made.
proto::Result<std::unique_ptr<Writer>> make_writer(std::string_view format, const WriterOptions& options);

}  // namespace headrace::client
