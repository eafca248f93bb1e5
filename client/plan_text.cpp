#include "client/plan_text.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

namespace headrace::client {

namespace {

double total_seconds(const std::vector<proto::PlanStage>& plan) {
    return std::accumulate(plan.begin(), plan.end(), 0.0,
                           [](double sum, const proto::PlanStage& stage) { return sum + stage.seconds; });
}

// "  1.23 s  45 %  "; as wide, but empty for a stage that has no time of its own.
std::string time_column(double seconds, double total) {
    char text[40];
    if (seconds > 0.0)
        std::snprintf(text, sizeof text, "%9.4g s %3.0f %%  ", seconds, 100.0 * seconds / total);
    else
        std::snprintf(text, sizeof text, "%18s", "");
    return text;
}

}  // namespace

std::vector<std::string> plan_lines(const std::vector<proto::PlanStage>& plan) {
    const double total = total_seconds(plan);
    std::vector<std::string> lines;
    for (const proto::PlanStage& stage : plan) {
        const char* const between = stage.active ? (stage.reason.empty() ? "" : ": ") : ": skipped, ";
        lines.push_back((total > 0.0 ? time_column(stage.seconds, total) : "") + stage.stage + between + stage.reason);
    }
    return lines;
}

std::string busiest_stages(const std::vector<proto::PlanStage>& plan) {
    constexpr std::size_t kMost = 3;
    const double total = total_seconds(plan);
    if (total <= 0.0) return "";
    std::vector<proto::PlanStage> stages = plan;
    std::stable_sort(stages.begin(), stages.end(), [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
    std::string text;
    for (std::size_t k = 0; k < std::min(kMost, stages.size()); ++k) {
        if (stages[k].seconds <= 0.0) break;
        char share[16];
        std::snprintf(share, sizeof share, " %.0f %%", 100.0 * stages[k].seconds / total);
        text += (k == 0 ? "" : ", ") + stages[k].stage + share;
    }
    return text;
}

}  // namespace headrace::client
