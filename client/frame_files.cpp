#include "client/frame_files.h"

#include <algorithm>
#include <system_error>

#include "client/writers/file_output.h"

namespace headrace::client {

void FrameFiles::remove_from(std::size_t first) const {
    for (std::size_t frame = first; frame < written_.size(); ++frame) {
        for (std::size_t k = 0; k < written_[frame]; ++k) {
            if (extensions_[k].empty()) continue;
            std::error_code ignored;
            std::filesystem::remove(folder_ / numbered_name(stem_, frame, extensions_[k]), ignored);
        }
    }
}

bool FrameFiles::has_any() const {
    return std::any_of(extensions_.begin(), extensions_.end(), [](const std::string& name) { return !name.empty(); });
}

}  // namespace headrace::client
