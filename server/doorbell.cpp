#include "server/doorbell.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace headrace::server {

Doorbell::Doorbell() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Doorbell::~Doorbell() {
    ::close(fd_);
}

void Doorbell::ring() noexcept {
    const std::uint64_t one = 1;
    // Fails only when the counter is full, that is when it rings already.
    [[maybe_unused]] const auto written = ::write(fd_, &one, sizeof one);
}

void Doorbell::quiet() noexcept {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto taken = ::read(fd_, &count, sizeof count);
}

}  // namespace headrace::server
