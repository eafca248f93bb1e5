#include "tests/bench/text.h"

#include <cstdarg>
#include <cstdio>

namespace headrace::bench {

std::string text_of(const char* format, ...) {
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

std::string with_thousands(long number) {
    std::string text = std::to_string(number);
    for (auto k = static_cast<std::ptrdiff_t>(text.size()) - 3; k > (number < 0 ? 1 : 0); k -= 3)
        text.insert(static_cast<std::size_t>(k), ",");
    return text;
}

}  // namespace headrace::bench
