// Numbers in POV-Ray's language: six digits, more than a picture shows.
#pragma once

#include <charconv>
#include <string>

#include "client/writers/vec3.h"

namespace headrace::client {

inline void append_pov_number(std::string& text, double number) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
    text.append(digits, end.ptr);
}

inline std::string pov_number(double number) {
    std::string text;
    append_pov_number(text, number);
    return text;
}

inline std::string pov_vector(const Vec3& x) {
    return "<" + pov_number(x[0]) + "," + pov_number(x[1]) + "," + pov_number(x[2]) + ">";
}

}  // namespace headrace::client
