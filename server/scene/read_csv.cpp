// Tables as `headrace convert --format csv` writes them: a line of titles such as "velocity_x [m/s]" (the unit may be
// left out), then a line of numbers for each particle. Columns of other names are not looked at.
#include <charconv>
#include <fstream>

#include "server/scene/particle_file.h"

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;

namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '"')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r' || text.back() == '"')) text.remove_suffix(1);
    return text;
}

// Calls visit(column, cell) for each cell of the line; returns how many there are.
template <class Visit>
std::size_t for_each_cell(std::string_view line, const Visit& visit) {
    std::size_t column = 0;
    for (;;) {
        const std::size_t end = line.find(',');
        visit(column++, trimmed(line.substr(0, end)));
        if (end == std::string_view::npos) return column;
        line.remove_prefix(end + 1);
    }
}

}  // namespace

proto::Result<ParticleTable> read_csv(const std::filesystem::path& file) {
    std::ifstream in(file);
    const std::string name = file.filename();
    std::size_t line_number = 1;
    const auto wrong = [&](const std::string& message, std::string hint = {}) {
        return Error{ErrorCode::scene_invalid, name + ", line " + std::to_string(line_number) + ": " + message, "",
                     std::move(hint)};
    };

    std::string line;
    if (!std::getline(in, line))
        return wrong("there is no line of titles", "the first line names the columns: position_x,position_y");
    if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // spreadsheets mark UTF-8
    ParticleTable table;
    std::vector<std::vector<double>*> columns;  // null: of no use here
    std::vector<std::string> titles;
    std::string doubled;
    for_each_cell(line, [&](std::size_t, std::string_view title) {
        titles.emplace_back(trimmed(title.substr(0, title.find('['))));
        table.names.push_back(titles.back());
        columns.push_back(nullptr);
        if (!is_particle_column(titles.back())) return;
        const auto [place, is_new] = table.columns.try_emplace(titles.back());
        if (!is_new) doubled = titles.back();
        columns.back() = &place->second;
    });
    if (!doubled.empty()) return wrong("there are two columns " + doubled, "leave one of them out");

    std::int64_t rows = 0;
    while (std::getline(in, line)) {
        ++line_number;
        if (trimmed(line).empty()) continue;
        if (++rows > kMostParticlesOfFile) return wrong("too many particles", kTooManyHint);
        std::string problem;
        const std::size_t cells = for_each_cell(line, [&](std::size_t column, std::string_view cell) {
            if (column >= columns.size() || columns[column] == nullptr) return;
            double value = 0.0;
            const auto [end, failure] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
            if ((failure != std::errc() || end != cell.data() + cell.size()) && problem.empty())
                problem = "column " + std::to_string(column + 1) + " (" + titles[column] + ") is \"" +
                          std::string(cell.substr(0, 40)) + "\", not a number";
            columns[column]->push_back(value);
        });
        if (!problem.empty()) return wrong(problem, "numbers have a point, and commas only between them");
        if (cells != titles.size())
            return wrong(std::to_string(cells) + " columns where line 1 has " + std::to_string(titles.size()),
                         "each line has as many; is the file complete?");
    }
    if (in.bad()) return Error{ErrorCode::file_error, "cannot read " + name + " to its end", "", "copy it anew"};
    return table;
}

}  // namespace headrace::scene
