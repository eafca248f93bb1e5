// Draws on an Image by cairo. Only for .cpp files that draw text and lines.
#pragma once

#include <cairo.h>

#include <memory>

#include "client/writers/image.h"

namespace headrace::client {

struct DestroySurface {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;

// A view: the image outlives it and is not touched meanwhile. Cairo's RGB24 is our pixel layout.
inline Surface make_surface(Image& image) {
    return Surface(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(image.pixels.data()),
                                                       CAIRO_FORMAT_RGB24, image.width, image.height, image.width * 4));
}

struct DestroyContext {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};

class Canvas {
  public:
    explicit Canvas(Image& image) : surface_(make_surface(image)), context_(cairo_create(surface_.get())) {}
    ~Canvas() { cairo_surface_flush(surface_.get()); }
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    cairo_t* operator()() const { return context_.get(); }
    void set_color(Rgb c) const { cairo_set_source_rgb(context_.get(), c.r / 255.0, c.g / 255.0, c.b / 255.0); }

  private:
    Surface surface_;
    std::unique_ptr<cairo_t, DestroyContext> context_;
};

}  // namespace headrace::client
