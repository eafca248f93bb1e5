#include "proto/recording_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>

namespace headrace::proto::recording {

namespace {

Error system_error(const std::filesystem::path& path, const std::string& what, int number) {
    const char* hint = "";
    if (number == EEXIST) hint = R"(choose another name, or replace it: --overwrite, in a command "overwrite": true)";
    if (number == ENOENT) hint = "check the name; folders are not created";
    if (number == EACCES || number == EPERM || number == EROFS) hint = "check the permissions of file and folder";
    if (number == ENOSPC || number == EDQUOT) hint = "free space on the disk; what is written so far stays readable";
    if (number == EFBIG) hint = "the limit of file size is reached; what is written so far stays readable";
    return file_error(path, what + ": " + std::strerror(number), hint);
}

}  // namespace

Error file_error(const std::filesystem::path& path, const std::string& what, const std::string& hint) {
    return {ErrorCode::file_error, path.string() + ": " + what, path.string(), hint};
}

Result<File> File::create(const std::filesystem::path& path, bool overwrite) {
    // Truncated only once locked: the file may be another writer's. O_NONBLOCK: a pipe must not hang us.
    const int flags = O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | (overwrite ? 0 : O_EXCL);
    const int descriptor = ::open(path.c_str(), flags, 0666);
    if (descriptor < 0) return system_error(path, "cannot create the file", errno);
    File file(path, descriptor);
    struct stat info {};
    if (::fstat(file.descriptor_, &info) != 0 || !S_ISREG(info.st_mode))
        return file_error(path, "cannot record into what is no regular file", "choose another name");
    if (::flock(file.descriptor_, LOCK_EX | LOCK_NB) != 0)
        return file_error(path, "another recording is being written to this file", "choose another name");
    if (::ftruncate(file.descriptor_, 0) != 0) return system_error(path, "cannot empty the file", errno);
    return file;
}

Result<File> File::open(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) return system_error(path, "cannot open the file", errno);
    File file(path, descriptor);
    struct stat info {};
    if (::fstat(file.descriptor_, &info) != 0 || !S_ISREG(info.st_mode))
        return file_error(path, "not a regular file", "");
    file.size_ = static_cast<std::uint64_t>(info.st_size);
    return file;
}

File::File(File&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Status File::append(std::span<const mcap::ByteView> pieces) {
    constexpr std::size_t kMost = 8;
    assert(pieces.size() <= kMost);
    std::array<iovec, kMost> left{};
    std::size_t count = 0;
    std::uint64_t total = 0;
    for (const mcap::ByteView piece : pieces) {
        if (piece.empty()) continue;
        left[count++] = {const_cast<std::byte*>(piece.data()), piece.size()};
        total += piece.size();
    }
    for (std::size_t first = 0; first < count;) {
        const ssize_t written = ::writev(descriptor_, left.data() + first, static_cast<int>(count - first));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            const int number = written < 0 ? errno : ENOSPC;
            // Half a chunk would be skipped by readers anyway: cutting it off is a courtesy and may fail.
            [[maybe_unused]] const int cut = ::ftruncate(descriptor_, static_cast<off_t>(size_));
            return system_error(path_, "cannot write", number);
        }
        // A short write: go on behind what was taken.
        auto taken = static_cast<std::size_t>(written);
        while (first < count && taken >= left[first].iov_len) taken -= left[first++].iov_len;
        if (first < count) {
            left[first].iov_base = static_cast<std::byte*>(left[first].iov_base) + taken;
            left[first].iov_len -= taken;
        }
    }
    size_ += total;
    return Done{};
}

Status File::read(std::uint64_t offset, std::span<std::byte> out) const {
    assert(offset + out.size() <= size_);
    while (!out.empty()) {
        const ssize_t got = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_error(path_, "cannot read at byte " + std::to_string(offset), errno);
        if (got == 0) return file_error(path_, "the file became shorter while it was read", "open it again");
        offset += static_cast<std::uint64_t>(got);
        out = out.subspan(static_cast<std::size_t>(got));
    }
    return Done{};
}

}  // namespace headrace::proto::recording
