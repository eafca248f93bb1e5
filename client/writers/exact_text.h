// Numbers as text that reads back to the same bits.
#pragma once

#include <charconv>
#include <string>

#include "proto/frame.h"

namespace headrace::client {

template <class Number>
void append_number(std::string& text, Number number) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number);
    text.append(digits, end.ptr);
}

// The shortest digits that give back the stored bits: a "<f4" value is printed as float.
inline void append_value(std::string& text, const proto::FrameColumn& column, std::size_t row, int component) {
    const double value = proto::FrameView::value(column, row, component);
    if (column.dtype == "<f4")
        append_number(text, static_cast<float>(value));
    else if (column.dtype == "<u4")
        append_number(text, static_cast<std::uint64_t>(value));
    else
        append_number(text, value);
}

}  // namespace headrace::client
