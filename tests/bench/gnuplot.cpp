#include "tests/bench/gnuplot.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace headrace::bench {

bool has_gnuplot() {
    if (std::system("command -v gnuplot > /dev/null 2>&1") == 0) return true;
    std::cout << "gnuplot is absent: no diagrams\n";
    return false;
}

bool run_gnuplot(const std::string& commands, const std::string& what) {
    std::FILE* pipe = popen("gnuplot", "w");
    if (!pipe) return false;
    std::fputs(commands.c_str(), pipe);
    const bool is_drawn = pclose(pipe) == 0;
    if (!is_drawn) std::cerr << "headrace_bench: gnuplot could not draw " << what << '\n';
    return is_drawn;
}

}  // namespace headrace::bench
