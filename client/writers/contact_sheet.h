// A recording at a glance: small pictures evenly spread over its frames, on one page with one colour bar.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "client/writers/image.h"
#include "client/writers/scene_view.h"

namespace headrace::client {

class ContactSheet {
  public:
    // `cells` small pictures of expected_frames; of an unknown number of frames (0), every second kept picture is let
    // go each time twice the cells are full.
    ContactSheet(std::size_t cells, std::size_t expected_frames);

    bool wants(std::size_t frame) const;
    void add(std::size_t frame, Image picture, std::string label);  // precondition: wants(frame), all of one size

    std::vector<std::size_t> chosen_frames() const;  // that the sheet will show, ascending

    // Precondition: at least one frame was added.
    Image compose(const std::string& title, const ColorScale& colors) const;

  private:
    struct Cell {
        std::size_t frame;
        Image picture;
        std::string label;
    };
    std::vector<const Cell*> chosen() const;

    std::size_t wanted_, expected_;
    std::size_t stride_{1};  // of kept frames while their number is not known
    std::vector<Cell> kept_;
};

}  // namespace headrace::client
