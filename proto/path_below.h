// Files of a folder that others may name: nothing outside of it can be reached.
#pragma once

#include <filesystem>
#include <string>

#include "proto/result.h"

namespace headrace::proto {

// The file `name` below `folder`, links resolved. Errors: file_error with `path` and a hint that says what to give, for
// absolute names, names that leave the folder, and links that lead nowhere. Whether the file exists does not matter.
Result<std::filesystem::path> path_below(const std::filesystem::path& folder, const std::string& name,
                                         const std::string& path, const std::string& hint);

}  // namespace headrace::proto
