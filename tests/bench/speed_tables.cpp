#include "tests/bench/speed_tables.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <utility>

#include "tests/bench/text.h"

namespace headrace::bench {

namespace {

using Wanted = std::function<bool(const SpeedRow&)>;

// The fastest row there is of what is wanted: one, unless sizes of two edges share a group.
const SpeedRow* find(const std::vector<SpeedRow>& rows, const Wanted& wanted) {
    const SpeedRow* found = nullptr;
    for (const SpeedRow& row : rows)
        if (wanted(row) && (found == nullptr || row.Mpsps_per_core > found->Mpsps_per_core)) found = &row;
    return found;
}

// Sizes of the plain cases: whole cubes and squares of about so many.
struct Size {
    double particles;
    const char* name;
};
constexpr Size kSizes[] = {{1e4, "10^4"}, {6.4e4, "64,000"}, {1e5, "10^5"}, {1e6, "10^6"}, {1e7, "10^7"}};

bool is_of_size(const SpeedRow& row, const Size& size) {
    return std::abs(std::log(static_cast<double>(row.particles) / size.particles)) < 0.15;  // 64,000 is not 10^5
}

bool is_of_support(const SpeedRow& row, double support_over_dp) {
    return std::abs(row.support_over_dp - support_over_dp) < 0.005;  // the file has four digits
}

std::vector<double> find_supports(const std::vector<SpeedRow>& rows, const std::string& name) {
    std::vector<double> supports;
    for (const SpeedRow& row : rows)
        if (row.name == name &&
            std::none_of(supports.begin(), supports.end(), [&](double known) { return is_of_support(row, known); }))
            supports.push_back(row.support_over_dp);
    std::sort(supports.begin(), supports.end());
    return supports;
}

// The set that the machine's best figures were measured in.
std::string find_best_set(const std::vector<SpeedRow>& rows) {
    const SpeedRow* fastest =
        find(rows, [](const SpeedRow& row) { return row.model == "plain" && row.strategy == "clusters"; });
    return fastest != nullptr ? fastest->isa : "";
}

// "5.12 (248)": M particle-steps/s per core, and GFLOP/s of fused multiply-adds beside them.
std::string figure(const SpeedRow* row) {
    return row != nullptr ? text_of("%.3g (%.0f)", row->Mpsps_per_core, row->fma_gflops) : "-";
}

std::string models_table(const std::vector<SpeedRow>& rows) {
    std::string text =
        "| dam break | particles | neighbours | threads | set | full steps | acoustic steps | s per simulated s | FMA "
        "|\n"
        "|---|---|---|---|---|---|---|---|---|\n";
    for (const char* model : {"wcsph", "thesis"}) {
        for (const int dimensions : {2, 3}) {
            const std::string name = std::string(model) + text_of("_dam_break_%dd", dimensions);
            for (const SpeedRow& row : rows) {
                if (row.name != name) continue;
                text += text_of("| `%s` %dD, R/dp %.3g | ", model, dimensions, row.support_over_dp) +
                        with_thousands(static_cast<long>(row.particles)) +
                        text_of(" | %.0f | %d | %s | %.3g | ", row.neighbours, row.threads, row.isa.c_str(),
                                row.Mpsps_per_core) +
                        (row.acoustic_steps > 1.0 ? text_of("%.3g", row.Mpsps_per_core * row.acoustic_steps) : "") +
                        text_of(" | %.3g | %.0f |\n", row.wall_per_simulated_s, row.fma_gflops);
            }
        }
    }
    return text;
}

// Rows: supports, and lists that name each pair for both of its points or once; columns: sizes.
std::string engine_table(const std::vector<SpeedRow>& rows, const std::string& isa) {
    std::string head = "| plain terms, one thread, " + isa + " | R/dp | neighbours | lists |",
                rule = "|---|---|---|---|";
    std::vector<Size> sizes;
    for (const Size& size : kSizes) {
        const auto is_measured = [&](const SpeedRow& row) {
            return (row.name == "plain_2d" || row.name == "plain_3d") && row.strategy == "clusters" &&
                   row.threads == 1 && is_of_size(row, size);
        };
        if (find(rows, is_measured) == nullptr) continue;
        sizes.push_back(size);
        head += std::string(" ") + size.name + " |";
        rule += "---|";
    }
    std::string text = head + "\n" + rule + "\n";
    for (const int dimensions : {2, 3}) {
        const std::string name = text_of("plain_%dd", dimensions);
        for (const double support : find_supports(rows, name)) {
            for (const std::string strategy : {"clusters", "half"}) {
                const auto of = [&](const Size& size) {
                    return find(rows, [&](const SpeedRow& row) {
                        return row.name == name && row.strategy == strategy && row.threads == 1 && row.isa == isa &&
                               is_of_support(row, support) && is_of_size(row, size);
                    });
                };
                std::string cells;
                double neighbours = 0.0;
                for (const Size& size : sizes) {
                    const SpeedRow* row = of(size);
                    if (row != nullptr) neighbours = row->neighbours;
                    cells += " " + figure(row) + " |";
                }
                if (neighbours > 0.0)
                    text += text_of("| %dD | %.3g | %.0f |", dimensions, support, neighbours) +
                            (strategy == "half" ? " half |" : " whole |") + cells + "\n";
            }
        }
    }
    return text;
}

// What else there may be of a case, over its clusters on one thread in the best set.
struct RatioColumn {
    const char* strategy;
    const char* isa;  // null: the best
    int threads;
    const char* title;
};
constexpr RatioColumn kRatios[] = {{"half", nullptr, 1, "half lists"},
                                   {"buffer", nullptr, 1, "buffer"},
                                   {"broadcast", nullptr, 1, "broadcast"},
                                   {"clusters", "AVX2", 1, "AVX2"},
                                   {"clusters", "SSE4", 1, "SSE4"},
                                   {"clusters", "SCALAR", 1, "without SIMD"},
                                   {"clusters", nullptr, 2, "two threads together"},
                                   {"half", nullptr, 2, "the same, half lists"}};

struct RatioLine {
    std::string size;
    double ratios[std::size(kRatios)]{};  // 0: not measured
};

std::vector<RatioLine> find_ratios(const std::vector<SpeedRow>& rows, const std::string& isa, double support) {
    std::vector<RatioLine> lines;
    for (const std::string name : {"plain_2d", "plain_3d"}) {
        for (const Size& size : kSizes) {
            const auto of = [&](const std::string& strategy, const std::string& set, int threads) {
                return find(rows, [&](const SpeedRow& row) {
                    return row.name == name && row.strategy == strategy && row.threads == threads && row.isa == set &&
                           is_of_support(row, support) && is_of_size(row, size);
                });
            };
            const SpeedRow* one = of("clusters", isa, 1);
            if (one == nullptr) continue;
            RatioLine line{"| " + name.substr(6, 1) + "D | " + with_thousands(static_cast<long>(one->particles)), {}};
            for (std::size_t c = 0; c < std::size(kRatios); ++c) {
                const RatioColumn& column = kRatios[c];
                const SpeedRow* other = of(column.strategy, column.isa != nullptr ? column.isa : isa, column.threads);
                if (other == nullptr || other == one) continue;
                // With threads: of the whole, not of a core.
                line.ratios[c] = other->Mpsps_per_core * other->threads / one->Mpsps_per_core;
            }
            const bool is_alone =
                std::all_of(std::begin(line.ratios), std::end(line.ratios), [](double ratio) { return ratio == 0.0; });
            if (!is_alone) lines.push_back(std::move(line));
        }
    }
    return lines;
}

std::string ratio_table(const std::vector<SpeedRow>& rows, const std::string& isa, double support) {
    const std::vector<RatioLine> lines = find_ratios(rows, isa, support);
    const auto is_measured = [&](std::size_t c) {
        return std::any_of(lines.begin(), lines.end(), [&](const RatioLine& line) { return line.ratios[c] > 0.0; });
    };
    std::string text = text_of("| R/dp = %.3g, speed over that of clusters | particles |", support), rule = "|---|---|";
    for (std::size_t c = 0; c < std::size(kRatios); ++c) {
        if (!is_measured(c)) continue;
        text += std::string(" ") + kRatios[c].title + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const RatioLine& line : lines) {
        text += line.size + " |";
        for (std::size_t c = 0; c < std::size(kRatios); ++c)
            if (is_measured(c)) text += line.ratios[c] > 0.0 ? text_of(" %.2f |", line.ratios[c]) : " - |";
        text += "\n";
    }
    return text;
}

// How time and memory of a particle grow with the number of particles; empty where that was not measured.
std::string growth_table(const std::vector<SpeedRow>& rows, const std::string& isa) {
    std::string text;
    for (const std::string name : {"growth_plain_3d", "growth_wcsph_3d"}) {
        for (const std::string strategy : {"clusters", "half"}) {
            const auto is_one = [&](const SpeedRow& row) {
                return row.name == name && row.strategy == strategy && row.threads == 1 && row.isa == isa;
            };
            const SpeedRow* fewest = nullptr;
            for (const SpeedRow& row : rows)
                if (is_one(row) && (fewest == nullptr || row.particles < fewest->particles)) fewest = &row;
            for (const SpeedRow& row : rows) {
                if (!is_one(row)) continue;
                text +=
                    "| " + row.model + (strategy == "half" ? " | half | " : " | whole | ") +
                    with_thousands(static_cast<long>(row.particles)) + " | " + figure(&row) +
                    text_of(" | %.2f | %.0f |\n", fewest->Mpsps_per_core / row.Mpsps_per_core, row.bytes_per_particle);
            }
        }
    }
    if (text.empty()) return "";
    return "| growth, 3D, R/dp = 3, one thread, " + isa +
           " | lists | particles | full steps | time per particle over that of "
           "the fewest | bytes a particle |\n|---|---|---|---|---|---|\n" +
           text;
}

// One line per case and size: which strategy is the fastest.
std::string strategy_table(const std::vector<SpeedRow>& rows, const std::string& isa) {
    std::string text =
        "| case | particles | R/dp | clusters | half | buffer | broadcast | fastest | sort, list, pair, integrate of "
        "clusters [ns] | bytes a particle |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const std::string name : {"plain_2d_jittered", "plain_2d", "plain_3d_jittered", "plain_3d"}) {
        for (const Size& size : kSizes) {
            for (const double support : find_supports(rows, name)) {
                const auto of = [&](const std::string& strategy) {
                    return find(rows, [&](const SpeedRow& row) {
                        return row.name == name && row.strategy == strategy && row.threads == 1 && row.isa == isa &&
                               is_of_support(row, support) && is_of_size(row, size);
                    });
                };
                const SpeedRow* clusters = of("clusters");
                if (clusters == nullptr) continue;
                const SpeedRow* fastest = clusters;
                std::string cells;
                for (const char* strategy : {"clusters", "half", "buffer", "broadcast"}) {
                    const SpeedRow* row = of(strategy);
                    if (row != nullptr && row->Mpsps_per_core > fastest->Mpsps_per_core) fastest = row;
                    cells += " " + figure(row) + " |";
                }
                const bool is_alone = of("half") == nullptr && of("buffer") == nullptr && of("broadcast") == nullptr;
                text += "| " + name + " | " + with_thousands(static_cast<long>(clusters->particles)) +
                        text_of(" | %.3g |", support) + cells + " " + (is_alone ? "-" : fastest->strategy) +
                        text_of(" | %.3g, %.3g, %.3g, %.3g | %.0f |\n", clusters->ns_sort, clusters->ns_list,
                                clusters->ns_pair, clusters->ns_integrate, clusters->bytes_per_particle);
            }
        }
    }
    return text;
}

std::string readme_tables(const std::vector<SpeedRow>& rows) {
    const std::string isa = find_best_set(rows), growth = growth_table(rows, isa);
    return "\n" + models_table(rows) + "\n" + engine_table(rows, isa) + "\n" + ratio_table(rows, isa, 3.0) + "\n" +
           (growth.empty() ? "" : growth + "\n");
}

}  // namespace

std::string speed_begin(const std::string& name) {
    return "<!-- made by `headrace_bench speed --readme` from " + name + " -->\n";
}

std::string speed_end(const std::string& name) {
    return "<!-- end of " + name + " -->\n";
}

std::optional<std::string> with_speed_tables(const std::string& readme, const std::string& name,
                                             const std::vector<SpeedRow>& rows) {
    const std::size_t begin = readme.find(speed_begin(name));
    if (begin == std::string::npos) return std::nullopt;
    const std::size_t first = begin + speed_begin(name).size(), end = readme.find(speed_end(name), first);
    if (end == std::string::npos) return std::nullopt;
    return readme.substr(0, first) + readme_tables(rows) + readme.substr(end);
}

std::string speed_document(const std::string& name, const std::vector<SpeedRow>& rows) {
    const std::string isa = find_best_set(rows), growth = growth_table(rows, isa);
    return "# Speed of the pair engine and of whole models\n\nMade by `headrace_bench speed --readme` from " + name +
           "; README.md says what the cases are. M particle-steps per second and\ncore; in brackets GFLOP/s of fused "
           "multiply-adds beside the measurement, one core.\n\n## Models\n\n" +
           models_table(rows) + "\n## Strategies, one thread, " + isa + "\n\n" + strategy_table(rows, isa) +
           "\n## Instruction sets and threads\n\n" + ratio_table(rows, isa, 3.0) +
           (growth.empty() ? "" : "\n## Growth\n\n" + growth);
}

std::vector<std::string> find_speed_files(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("speed") && name.ends_with(".csv")) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace headrace::bench
