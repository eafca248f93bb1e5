#include "tests/bench/speed_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

// What else there is of a case, over its clusters on one thread in the best set.
std::string ratio_table(const std::vector<SpeedRow>& rows, const std::string& isa, double support) {
    struct Column {
        const char* strategy;
        const char* isa;  // null: the best
        int threads;
        std::string title;
    };
    const Column columns[] = {{"half", nullptr, 1, "half lists"},
                              {"buffer", nullptr, 1, "buffer"},
                              {"broadcast", nullptr, 1, "broadcast"},
                              {"clusters", "AVX2", 1, "AVX2"},
                              {"clusters", "SSE4", 1, "SSE4"},
                              {"clusters", "SCALAR", 1, "without SIMD"},
                              {"clusters", nullptr, 2, "two threads together"},
                              {"half", nullptr, 2, "the same, half lists"}};
    std::string text = text_of("| R/dp = %.3g, speed over that of clusters | particles |", support), rule = "|---|---|";
    for (const Column& column : columns) {
        text += " " + column.title + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const std::string name : {"plain_2d", "plain_3d"}) {
        for (const Size& size : kSizes) {
            const auto of = [&](const char* strategy, const std::string& set, int threads) {
                return find(rows, [&](const SpeedRow& row) {
                    return row.name == name && row.strategy == strategy && row.threads == threads && row.isa == set &&
                           is_of_support(row, support) && is_of_size(row, size);
                });
            };
            const SpeedRow* one = of("clusters", isa, 1);
            if (one == nullptr) continue;
            std::string cells;
            bool has_any = false;
            for (const Column& column : columns) {
                const SpeedRow* other = of(column.strategy, column.isa != nullptr ? column.isa : isa, column.threads);
                has_any = has_any || other != nullptr;
                // With threads: of the whole, not of a core.
                cells += other != nullptr
                             ? text_of(" %.2f |", other->Mpsps_per_core * other->threads / one->Mpsps_per_core)
                             : " - |";
            }
            if (has_any)
                text += "| " + name.substr(6, 1) + "D | " + with_thousands(static_cast<long>(one->particles)) + " |" +
                        cells + "\n";
        }
    }
    return text;
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
    const std::string isa = find_best_set(rows);
    return "\n" + models_table(rows) + "\n" + engine_table(rows, isa) + "\n" + ratio_table(rows, isa, 3.0) + "\n";
}

}  // namespace

std::optional<std::string> with_speed_tables(const std::string& readme, const std::vector<SpeedRow>& rows) {
    const std::size_t begin = readme.find(kSpeedBegin);
    if (begin == std::string::npos) return std::nullopt;
    const std::size_t first = begin + std::string(kSpeedBegin).size(), end = readme.find(kSpeedEnd, first);
    if (end == std::string::npos) return std::nullopt;
    return readme.substr(0, first) + readme_tables(rows) + readme.substr(end);
}

std::string speed_document(const std::vector<SpeedRow>& rows) {
    const std::string isa = find_best_set(rows);
    return "# Speed of the pair engine and of whole models\n\nMade by `headrace_bench speed --readme` from speed.csv; "
           "README.md says what the cases are. M particle-steps per second and\ncore; in brackets GFLOP/s of fused "
           "multiply-adds beside the measurement, one core.\n\n## Models\n\n" +
           models_table(rows) + "\n## Strategies, one thread, " + isa + "\n\n" + strategy_table(rows, isa) +
           "\n## Instruction sets and threads\n\n" + ratio_table(rows, isa, 3.0);
}

}  // namespace headrace::bench
