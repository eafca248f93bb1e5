#include "proto/path_below.h"

#include <algorithm>
#include <system_error>

namespace headrace::proto {

namespace fs = std::filesystem;

Result<fs::path> path_below(const fs::path& folder, const std::string& name, const std::string& path,
                            const std::string& hint) {
    const fs::path relative(name);
    const auto refuse = [&](const char* message) { return Error{ErrorCode::file_error, message, path, hint}; };
    if (relative.is_absolute()) return refuse("an absolute path is not allowed");
    std::error_code error;
    const fs::path root = fs::weakly_canonical(folder, error);
    const fs::path file = error ? fs::path() : fs::weakly_canonical(root / relative, error);
    if (error) return refuse("the path cannot be resolved");
    const auto [end, unused] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
    if (end != root.end()) return refuse("the path leaves the data folder");
    // A link that leads nowhere is left unresolved above, and would be written through.
    if (fs::is_symlink(fs::symlink_status(file, error))) return refuse("the path is a link that leads nowhere");
    return file;
}

}  // namespace headrace::proto
