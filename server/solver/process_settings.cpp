#include "server/solver/process_settings.h"

#include <unistd.h>

#include <array>
#include <climits>
#include <cstdlib>

namespace headrace::solver {

void restart_with_settings(char** argv) {
    constexpr const char* kSpins = "10000";  // some ten microseconds, the length of a barrier between busy threads
    constexpr const char* kMemory =
        "glibc.malloc.hugetlb=1"  // where the kernel has them for those who ask
        ":glibc.malloc.mmap_threshold=1048576:glibc.malloc.trim_threshold=67108864";
    const bool waits = std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr;
    const bool is_tuned = std::getenv("GLIBC_TUNABLES") != nullptr;
    if (waits && is_tuned) return;
    std::array<char, PATH_MAX> self{};
    if (::readlink("/proc/self/exe", self.data(), self.size() - 1) <= 0) return;
    if (!waits && ::setenv("GOMP_SPINCOUNT", kSpins, 1) != 0) return;
    if (!is_tuned && ::setenv("GLIBC_TUNABLES", kMemory, 1) != 0) return;
    ::execv(self.data(), argv);
}

}  // namespace headrace::solver
