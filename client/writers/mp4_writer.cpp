// A film, <stem>.mp4 (H.264): the frames' pictures go through a pipe to ffmpeg, none is left as a file.
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "client/writers/exact_text.h"
#include "client/writers/formats.h"
#include "client/writers/frame_picture.h"

extern char** environ;

namespace headrace::client {

namespace {

// ffmpeg at work. Owner: one thread.
class Encoder {
  public:
    ~Encoder() {
        if (pid_ > 0) static_cast<void>(finish().ok());
        if (log_ != nullptr) std::fclose(log_);
    }

    // Errors, here and below: file_error, with what ffmpeg says.
    proto::Status start(const std::filesystem::path& file, int width, int height, double fps) {
        // A socket, not a pipe: writing to one whose reader has died is an error and not a signal.
        int ends[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return failed(std::strerror(errno));
        log_ = std::tmpfile();
        std::string rate;
        append_number(rate, fps);
        std::vector<std::string> words{"ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "bgr0", "-s",
                                       std::to_string(width) + "x" + std::to_string(height), "-r", rate, "-i", "pipe:0",
                                       // The format's colours need even sizes; 18: no loss that is seen.
                                       "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-crf",
                                       "18", "-pix_fmt", "yuv420p",
                                       // The same bytes each time: no versions, no times.
                                       "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1",
                                       "-movflags", "+faststart", "-f", "mp4", "file:" + file.string()};
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);

        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        if (log_ != nullptr) posix_spawn_file_actions_adddup2(&actions, ::fileno(log_), STDERR_FILENO);
        // A process group of its own: Ctrl-C reaches the client only, which then ends the film in order.
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        const int error = ::posix_spawnp(&pid_, "ffmpeg", &actions, &attributes, arguments.data(), environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        ::close(ends[0]);
        if (error != 0) {
            ::close(ends[1]);
            pid_ = 0;
            return failed(std::strerror(error));
        }
        input_ = ends[1];
        return proto::Done{};
    }

    proto::Status add(const Image& image) {
        const auto bytes = std::as_bytes(std::span(image.pixels));
        for (std::size_t sent = 0; sent < bytes.size();) {
            const ssize_t n = ::send(input_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) return finish() ? failed("it ended early") : failed(said());
            sent += static_cast<std::size_t>(n);
        }
        return proto::Done{};
    }

    // Waits until the film is complete.
    proto::Status finish() {
        ::close(input_);
        int status = 0;
        while (::waitpid(std::exchange(pid_, 0), &status, 0) < 0 && errno == EINTR) {
        }
        if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return proto::Done{};
        return failed(said());
    }

  private:
    std::string said() {
        if (log_ == nullptr) return "no reason given";
        std::rewind(log_);
        char text[400];
        const std::size_t length = std::fread(text, 1, sizeof text, log_);
        std::string said(text, length);
        said = said.substr(0, said.find('\n'));
        return said.empty() ? "no reason given" : said;
    }

    static proto::Error failed(const std::string& reason) {
        return {proto::ErrorCode::file_error, "ffmpeg cannot make the film: " + reason, "", ""};
    }

    pid_t pid_{0};
    int input_{-1};
    std::FILE* log_{nullptr};
};

class Mp4Writer final : public Writer {
  public:
    explicit Mp4Writer(const WriterOptions& options)
        : options_(options), picture_(options), file_(options.folder / (options.stem + ".mp4")), part_(file_) {
        part_ += ".part";
    }
    ~Mp4Writer() override {
        encoder_.reset();
        std::error_code ignored;
        std::filesystem::remove(part_, ignored);
    }
    Mp4Writer(const Mp4Writer&) = delete;
    Mp4Writer& operator=(const Mp4Writer&) = delete;

    proto::Result<InOrder> prepare(const FrameTask& task) override {
        if (auto checked = picture_.check_frame(task.frame); !checked) return checked.error();
        return InOrder([this, image = picture_.draw(task)] {
            if (!encoder_) {
                encoder_ = std::make_unique<Encoder>();
                if (auto started = encoder_->start(part_, image.width, image.height, options_.picture.fps); !started)
                    return started;
            }
            ++frames_;
            return encoder_->add(image);
        });
    }

    proto::Status finish() override {
        if (!encoder_) return proto::Done{};
        auto ended = encoder_->finish();
        if (!ended) return ended;
        std::error_code failure;
        std::filesystem::rename(part_, file_, failure);
        if (failure) return proto::Error{proto::ErrorCode::file_error, failure.message(), file_.string(), ""};
        return ended;
    }

    std::string summary() const override {
        return file_.string() + ": a film of " + std::to_string(frames_) + " frames";
    }

  private:
    WriterOptions options_;
    FramePicture picture_;
    std::filesystem::path file_, part_;
    std::unique_ptr<Encoder> encoder_;
    std::size_t frames_{0};
};

}  // namespace

bool has_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::string_view folders = path != nullptr ? path : "";
    while (!folders.empty()) {
        const std::size_t end = std::min(folders.find(':'), folders.size());
        if (::access((std::filesystem::path(folders.substr(0, end)) / "ffmpeg").c_str(), X_OK) == 0) return true;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    return false;
}

std::unique_ptr<Writer> make_mp4_writer(const WriterOptions& options) {
    return std::make_unique<Mp4Writer>(options);
}

}  // namespace headrace::client
