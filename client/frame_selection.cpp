#include "client/frame_selection.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "client/writers/boxes.h"

namespace headrace::client {

namespace {

std::vector<std::size_t> rows_inside(const proto::FrameView& frame, const proto::BoxDesc& region) {
    const proto::FrameColumn& position = *frame.find(proto::Field::position);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < frame.info.particle_count; ++row) {
        bool is_inside = true;
        for (int axis = 0; axis < position.components; ++axis) {
            const double x = proto::FrameView::value(position, row, axis);
            is_inside = is_inside && region.min[axis] <= x && x <= region.max[axis];
        }
        if (is_inside) rows.push_back(row);
    }
    return rows;
}

}  // namespace

proto::FrameView select_region(const proto::FrameView& frame, const proto::BoxDesc& region,
                               std::vector<std::byte>& bytes) {
    const std::vector<std::size_t> rows = rows_inside(frame, region);
    std::size_t particle_bytes = 0;
    for (const proto::FrameColumn& column : frame.columns)
        particle_bytes += column.components * proto::dtype_size(column.dtype);
    bytes.resize(rows.size() * particle_bytes);  // all columns at once: the views into it stay valid

    proto::FrameView part{frame.info, {}};
    part.info.particle_count = rows.size();
    std::byte* out = bytes.data();
    for (const proto::FrameColumn& column : frame.columns) {
        const std::size_t row_bytes = column.components * proto::dtype_size(column.dtype);
        proto::FrameColumn chosen = column;
        chosen.bytes = {out, rows.size() * row_bytes};
        for (const std::size_t row : rows) {
            std::memcpy(out, column.bytes.data() + row * row_bytes, row_bytes);
            out += row_bytes;
        }
        part.columns.push_back(chosen);
    }
    return part;
}

proto::BoxDesc bounds_without_spray(const proto::FrameView& frame) {
    constexpr double kSpray = 0.002;  // of the particles
    const proto::FrameColumn& position = *frame.find(proto::Field::position);
    proto::BoxDesc bounds = kNowhere;
    std::vector<double> places;
    for (int axis = 0; axis < 3; ++axis) {
        places.clear();
        for (std::size_t row = 0; row < frame.info.particle_count && axis < position.components; ++row) {
            const double x = proto::FrameView::value(position, row, axis);
            if (std::isfinite(x)) places.push_back(x);
        }
        if (axis >= position.components) places.push_back(0);
        if (places.empty()) return kNowhere;
        const auto spray = static_cast<std::ptrdiff_t>(kSpray * static_cast<double>(places.size()));
        std::nth_element(places.begin(), places.begin() + spray, places.end());
        bounds.min[axis] = places[spray];
        std::nth_element(places.begin(), places.end() - 1 - spray, places.end());
        bounds.max[axis] = places[places.size() - 1 - spray];
    }
    return bounds;
}

proto::FrameView select_fields(const proto::FrameView& frame, proto::FieldSet fields) {
    proto::FrameView part{frame.info, {}};
    std::copy_if(frame.columns.begin(), frame.columns.end(), std::back_inserter(part.columns),
                 [fields](const proto::FrameColumn& column) { return fields.contains(column.field); });
    return part;
}

}  // namespace headrace::client
