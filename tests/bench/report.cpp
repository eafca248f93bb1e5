#include "tests/bench/report.h"

#include "tests/bench/text.h"

namespace headrace::bench {

std::string table_head() {
    return text_of("%-22s %9s %10s %7s %10s %10s %10s %10s %10s %8s  %s", "case", "N", "neighbours", "threads",
                   "ms best", "ms median", "M p-s/s", "per core", "s per sim s", "B/part.", "ms per step and stage");
}

std::string table_line(const Timing& t) {
    const double rate = t.particle_steps_per_second() * 1e-6;
    std::string line = text_of("%-22s %9zu %10.1f %7d %10.3f %10.3f %10.3f %10.3f %11.2f %8.0f ", t.label.c_str(),
                               t.particles, t.mean_neighbours, t.threads, t.best_ms, t.median_ms, rate,
                               rate / t.threads, t.wall_per_simulated_second(), t.bytes_per_particle);
    for (const StageTime& stage : t.stages) line += text_of(" %s %.3f", stage.name.c_str(), stage.ms);
    return line;
}

std::string csv_head() {
    return "case,model,dimensions,particles,spacing_m,support_m,mean_neighbours,threads,ms_per_step_best,"
           "ms_per_step_median,particle_steps_per_s,particle_steps_per_s_core,wall_s_per_simulated_s,"
           "bytes_per_particle,stages_ms";
}

std::string csv_row(const Timing& t) {
    std::string row =
        text_of("%s,%s,%d,%zu,%.6g,%.6g,%.2f,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.1f,", t.label.c_str(), t.model.c_str(),
                t.dimensions, t.particles, t.spacing, t.support, t.mean_neighbours, t.threads, t.best_ms, t.median_ms,
                t.particle_steps_per_second(), t.particle_steps_per_second() / t.threads, t.wall_per_simulated_second(),
                t.bytes_per_particle);
    for (std::size_t i = 0; i < t.stages.size(); ++i)
        row += text_of("%s%s=%.6g", i == 0 ? "" : ";", t.stages[i].name.c_str(), t.stages[i].ms);
    return row;
}

}  // namespace headrace::bench
