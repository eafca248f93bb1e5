// How a program has large arrays from the system.
#pragma once

#include <malloc.h>

namespace headrace {

// Each as pages of its own, which go back to the system when it is freed. glibc would do so at first, and from the
// first one freed on put arrays up to 32 MB between the many small ones of the neighbour lists, where their room is
// lost.
inline void keep_large_arrays_apart() {
    constexpr int kLarge = 1 << 20, kSpare = 64 << 20;  // bytes
    mallopt(M_MMAP_THRESHOLD, kLarge);
    mallopt(M_TRIM_THRESHOLD, kSpare);  // small pieces come and go with each sort: what they leave at the end is kept
}

}  // namespace headrace
