// Text from numbers, as printf makes it.
#pragma once

#include <string>

namespace headrace::bench {

[[gnu::format(printf, 1, 2)]] std::string text_of(const char* format, ...);

std::string with_thousands(long number);  // "64,000"

}  // namespace headrace::bench
