// The table, the CSV file and the JSON of a convergence study.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "client/convergence_report.h"
#include "client/text.h"

namespace headrace::client {

namespace {

constexpr const char* kRunNames[] = {"coarse", "middle", "fine", "faster sound"};
constexpr double kShownVolume = 5e-3;  // a change of the fluid's volume that is worth a word

// So many significant digits; 110, not 1.1e+02.
std::string rounded(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
    return number(std::strtod(text, nullptr));
}
std::string value_text(const std::optional<double>& value) {
    return value ? rounded(*value, 5) : "-";
}
// An error is known to no more than two digits.
std::string error_text(const std::optional<double>& error) {
    return error ? rounded(*error, 2) : "-";
}

std::string convergence_name(Convergence convergence) {
    switch (convergence) {
        case Convergence::identical:
            return "identical";
        case Convergence::monotone:
            return "monotone";
        case Convergence::oscillatory:
            return "oscillatory";
        case Convergence::diverging:
            return "diverging";
    }
    return "?";
}

std::string order_text(const ResolutionEstimate& estimate) {
    switch (estimate.convergence) {
        case Convergence::identical:
            return "same";
        case Convergence::monotone:
            return rounded(*estimate.order, 2) + (*estimate.order == estimate.order_used ? "" : "*");
        case Convergence::oscillatory:
            return "~";
        case Convergence::diverging:
            return "!";
    }
    return "?";
}

// Columns as wide as their widest word; the first is flush left, the others flush right.
std::string aligned(const std::vector<std::vector<std::string>>& lines) {
    // In characters: of each UTF-8 sequence only the first byte counts.
    const auto width_of = [](const std::string& word) {
        return static_cast<std::size_t>(
            std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xC0) != 0x80; }));
    };
    std::vector<std::size_t> widths(lines.front().size(), 0);
    for (const auto& line : lines)
        for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], width_of(line[k]));
    std::string text;
    for (const auto& line : lines) {
        for (std::size_t k = 0; k < line.size(); ++k) {
            const std::string blanks(widths[k] - width_of(line[k]), ' ');
            text += (k > 0 ? "  " : "") + (k > 0 ? blanks + line[k] : line[k] + blanks);
        }
        text += '\n';
    }
    return text;
}

std::string runs_table(const Study& study) {
    std::vector<std::vector<std::string>> lines{
        {"run", "spacing [m]", "sound speed [m/s]", "particles", "steps", "wall [s]"}};
    const auto add = [&](const StudyRun& run) {
        lines.push_back({kRunNames[lines.size() - 1], value_text(run.spacing), value_text(run.sound_speed),
                         with_thousands(run.particles), with_thousands(run.steps), rounded(run.wall_s, 3)});
    };
    for (const StudyRun& run : study.runs) add(run);
    if (study.faster) add(*study.faster);
    return aligned(lines);
}

std::string share_text(const StudyRow& row) {
    const double size = std::abs(row.extrapolated.value_or(row.values[kFine]));
    if (row.total_error == 0) return "0 %";
    return row.total_error < size ? rounded(100 * row.total_error / size, 2) + " %" : "> 100 %";
}

std::string rows_table(const std::vector<StudyRow>& rows) {
    std::vector<std::vector<std::string>> lines{{"probe", "unit", "coarse", "middle", "fine", "faster sound", "order",
                                                 "extrapolated", "± spacing", "± sound", "± total", "of value"}};
    for (const StudyRow& row : rows) {
        if (row.is_point) continue;
        std::vector<std::string> line{row.probe + "." + row.column, row.unit};
        if (row.is_compared)
            line.insert(line.end(),
                        {value_text(row.values[kCoarse]), value_text(row.values[kMiddle]),
                         value_text(row.values[kFine]), value_text(row.faster), order_text(row.resolution),
                         value_text(row.extrapolated), error_text(row.resolution.error),
                         error_text(row.compressibility_error), error_text(row.total_error), share_text(row)});
        else
            line.resize(lines.front().size(), "-");
        lines.push_back(std::move(line));
    }
    return aligned(lines);
}

// What the signs that do occur mean.
std::string legend(const std::vector<StudyRow>& rows) {
    const auto any = [&](auto&& holds) {
        return std::any_of(rows.begin(), rows.end(), [&](const StudyRow& row) { return !row.is_point && holds(row); });
    };
    const auto is = [](Convergence convergence) {
        return
            [convergence](const StudyRow& row) { return row.is_compared && row.resolution.convergence == convergence; };
    };
    std::string text;
    if (any([](const StudyRow& row) {
            return row.resolution.order && *row.resolution.order != row.resolution.order_used;
        }))
        text += "*  outside 0.5 to 2: extrapolated and bar use the nearer of the two, below 0.5 with a wider bar\n";
    if (any(is(Convergence::oscillatory)))
        text += "~  the changes point to different sides: the bar is the spread of the runs, more is not known\n";
    if (any(is(Convergence::diverging)))
        text += "!  no convergence: the bar is the spread of the runs, the error may be larger; begin finer\n";
    if (any([](const StudyRow& row) { return !row.is_compared; }))
        text += "-  no time at which all runs have a value\n";
    for (const StudyRow& row : rows)
        if (row.is_compared && !row.is_point && row.covered < 0.995)
            text += row.probe + "." + row.column + ": in " + rounded(100 * row.covered, 3) +
                    " % of the time all runs have a value; the rest is left out\n";
    return text;
}

// The lattice fills a volume with whole particles: what that alone changes from spacing to spacing.
std::string volume_note(const Study& study) {
    double least = 0, most = 0;
    for (const StudyRun& run : study.runs) {
        const double volume = static_cast<double>(run.particles) * std::pow(run.spacing, study.dimensions);
        least = least == 0 ? volume : std::min(least, volume);
        most = std::max(most, volume);
    }
    if (!(most > least * (1 + kShownVolume))) return {};
    return "note: the fluid's volume differs by " + rounded(100 * (most / least - 1), 2) +
           " % between the spacings, and the bars contain it; --ratio 2 or another --spacing may fill it evenly\n";
}

void append(std::string& text, const std::optional<double>& value) {
    text += ',';
    if (!value) return;
    char digits[40];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, *value).ptr);
}

proto::Json optional_json(const std::optional<double>& value) {
    return value ? proto::Json(*value) : proto::Json(nullptr);
}

proto::Json row_json(const StudyRow& row) {
    proto::Json json{{"probe", row.probe}, {"column", row.column}, {"unit", row.unit}};
    if (row.position) json["position"] = *row.position;
    json["covered"] = row.covered;
    if (!row.is_compared) return json;
    json["values"] = row.values;
    json["faster_sound"] = optional_json(row.faster);
    json["convergence"] = convergence_name(row.resolution.convergence);
    json["order"] = optional_json(row.resolution.order);
    json["order_used"] = row.resolution.order ? proto::Json(row.resolution.order_used) : proto::Json(nullptr);
    json["extrapolated"] = optional_json(row.extrapolated);
    json["resolution_error"] = row.resolution.error;
    json["compressibility_error"] = optional_json(row.compressibility_error);
    json["total_error"] = row.total_error;
    return json;
}

}  // namespace

std::string study_table(const Study& study, const std::vector<StudyRow>& rows) {
    std::string text = study.scene + " until t " + number(study.until) + " s; ";
    text += study.measure == Measure::curve ? "values and bars: rms over the time (and places)\n"
                                            : measure_name(study.measure) + " over the time\n";
    text += runs_table(study) + '\n' + rows_table(rows) + legend(rows) + volume_note(study);
    text += "error bars: of the fine run";
    if (!study.faster) text += ", without that of the finite sound speed";
    return text;
}

std::string study_csv(const std::vector<StudyRow>& rows) {
    std::string text =
        "probe,column,position,unit,coarse,middle,fine,faster_sound,convergence,order,order_used,extrapolated,"
        "resolution_error,compressibility_error,total_error,covered\n";
    for (const StudyRow& row : rows) {
        text += row.probe + "," + row.column;
        append(text, row.position);
        text += "," + row.unit;
        if (row.is_compared) {
            for (const double value : row.values) append(text, value);
            append(text, row.faster);
            text += "," + convergence_name(row.resolution.convergence);
            append(text, row.resolution.order);
            append(text, row.resolution.order ? std::optional(row.resolution.order_used) : std::nullopt);
            append(text, row.extrapolated);
            append(text, row.resolution.error);
            append(text, row.compressibility_error);
            append(text, row.total_error);
        } else {
            text.append(11, ',');
        }
        append(text, row.covered);
        text += '\n';
    }
    return text;
}

proto::Json study_json(const Study& study, const std::vector<StudyRow>& rows) {
    proto::Json json{{"scene", study.scene}, {"until", study.until}, {"of", measure_name(study.measure)}};
    json["runs"] = proto::Json::array();
    const auto add = [&](const StudyRun& run) {
        json["runs"].push_back({{"name", kRunNames[json["runs"].size()]},
                                {"spacing", run.spacing},
                                {"sound_speed", optional_json(run.sound_speed)},
                                {"particles", run.particles},
                                {"steps", run.steps},
                                {"wall_s", run.wall_s}});
    };
    for (const StudyRun& run : study.runs) add(run);
    if (study.faster) add(*study.faster);
    json["results"] = proto::Json::array();
    for (const StudyRow& row : rows) json["results"].push_back(row_json(row));
    return json;
}

}  // namespace headrace::client
