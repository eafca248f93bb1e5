#include "tests/validation/support/reference_data.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace headrace::validation {

namespace {

std::string reference_folder() {
    const char* folder = std::getenv("HEADRACE_REFERENCE_DIR");
    return folder && *folder ? folder : HEADRACE_REFERENCE_DIR;
}

}  // namespace

Table load_reference(const std::string& relative_path) {
    std::ifstream file(reference_folder() + "/" + relative_path);
    Table table;
    std::string line;
    if (!std::getline(file, line)) return table;
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::string cell;
        for (std::size_t column = 0; std::getline(cells, cell, ','); ++column) {
            if (column == table.size()) table.emplace_back();
            char* end{};
            const double value = std::strtod(cell.c_str(), &end);
            table[column].push_back(end == cell.c_str() ? std::numeric_limits<double>::quiet_NaN() : value);
        }
    }
    return table;
}

double interpolate_linear(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto above = std::upper_bound(x.begin(), x.end(), at);
    if (above == x.begin()) return y.front();
    if (above == x.end()) return y.back();
    const auto k = static_cast<std::size_t>(above - x.begin());
    return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

}  // namespace headrace::validation
