#include "client/writers/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "client/writers/annotations.h"
#include "client/writers/scene_renderer.h"

namespace headrace::client {

namespace {

constexpr int kMargin = 24, kGap = 10, kLabel = 24, kTitle = 40, kBar = 150;  // [px]

// k of n evenly spread over 0 .. count - 1, both ends included.
std::size_t spread(std::size_t k, std::size_t n, std::size_t count) {
    return n < 2 ? count - 1 : (k * (count - 1) + (n - 1) / 2) / (n - 1);
}

// The number of columns that makes the page's shape most like 16 : 10.
int best_columns(int cells, int width, int height) {
    int best = 1;
    double best_miss = 1e9;
    for (int columns = 1; columns <= cells; ++columns) {
        const int rows = (cells + columns - 1) / columns;
        const double aspect = static_cast<double>(columns * width + kBar) / (rows * (height + kLabel) + kTitle);
        // An empty cell is a blemish, not a disaster.
        const double miss = std::abs(std::log(aspect / 1.6)) + 0.15 * (rows * columns - cells);
        if (miss < best_miss) best_miss = miss, best = columns;
    }
    return best;
}

}  // namespace

ContactSheet::ContactSheet(std::size_t cells, std::size_t expected_frames)
    : wanted_(cells), expected_(expected_frames) {}

bool ContactSheet::wants(std::size_t frame) const {
    if (wanted_ == 0) return false;
    if (expected_ == 0) return frame % stride_ == 0;
    if (expected_ <= wanted_) return frame < expected_;
    for (std::size_t k = 0; k < wanted_; ++k)
        if (spread(k, wanted_, expected_) == frame) return true;
    return false;
}

void ContactSheet::add(std::size_t frame, Image picture, std::string label) {
    kept_.push_back({frame, std::move(picture), std::move(label)});
    if (expected_ == 0 && kept_.size() > 2 * wanted_) {
        stride_ *= 2;
        std::erase_if(kept_, [this](const Cell& cell) { return cell.frame % stride_ != 0; });
    }
}

std::vector<const ContactSheet::Cell*> ContactSheet::chosen() const {
    std::vector<const Cell*> cells;
    const std::size_t count = std::min(wanted_, kept_.size());
    for (std::size_t k = 0; k < count; ++k) cells.push_back(&kept_[spread(k, count, kept_.size())]);
    return cells;
}

std::vector<std::size_t> ContactSheet::chosen_frames() const {
    std::vector<std::size_t> frames;
    for (const Cell* cell : chosen()) frames.push_back(cell->frame);
    return frames;
}

Image ContactSheet::compose(const std::string& title, const ColorScale& colors) const {
    const std::vector<const Cell*> cells = chosen();
    const int width = cells.front()->picture.width, height = cells.front()->picture.height;
    const int count = static_cast<int>(cells.size());
    const int columns = best_columns(count, width, height), rows = (count + columns - 1) / columns;

    const int bar_left = kMargin + columns * (width + kGap);
    Image page(bar_left + kBar, 2 * kMargin + kTitle + rows * (height + kLabel + kGap) - kGap, kPaper);
    draw_text(page, kMargin, kMargin + 18, 20, title, Weight::bold);
    for (int k = 0; k < count; ++k) {
        const int x = kMargin + k % columns * (width + kGap);
        const int y = kMargin + kTitle + k / columns * (height + kLabel + kGap);
        paste(cells[k]->picture, page, x, y);
        draw_text(page, x + 2, y + height + 17, 14, cells[k]->label);
    }
    draw_color_bar(page, bar_box(page.height, page.width - 4, 1), colors, 1);
    return page;
}

}  // namespace headrace::client
