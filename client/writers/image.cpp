#include "client/writers/image.h"

#include <algorithm>
#include <string>

#include "client/writers/cairo_canvas.h"
#include "client/writers/file_output.h"

namespace headrace::client {

namespace {

cairo_status_t append_bytes(void* sink, const unsigned char* data, unsigned int length) {
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    auto& file = *static_cast<std::vector<std::byte>*>(sink);
    file.insert(file.end(), bytes, bytes + length);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

void paste(const Image& source, Image& target, int x, int y) {
    for (int line = 0; line < source.height; ++line)
        std::copy_n(source.row(line), source.width, target.row(y + line) + x);
}

proto::Status write_png(const std::filesystem::path& file, const Image& image) {
    // Cairo only reads the pixels here; its interface has no const.
    const Surface surface = make_surface(const_cast<Image&>(image));
    std::vector<std::byte> encoded;
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append_bytes, &encoded);
    if (status != CAIRO_STATUS_SUCCESS)
        return proto::Error{proto::ErrorCode::file_error,
                            std::string("cannot encode the picture: ") + cairo_status_to_string(status), file.string(),
                            ""};
    return write_file(file, {encoded});
}

}  // namespace headrace::client
