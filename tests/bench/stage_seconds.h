// Where the time of steps goes.
#pragma once

namespace headrace::bench {

// [s] spent in each stage.
struct StageSeconds {
    double sort{}, list{}, pair{}, integrate{};

    double total() const { return sort + list + pair + integrate; }
    StageSeconds& operator+=(const StageSeconds& other) {
        sort += other.sort;
        list += other.list;
        pair += other.pair;
        integrate += other.integrate;
        return *this;
    }
    friend StageSeconds operator-(const StageSeconds& a, const StageSeconds& b) {
        return {a.sort - b.sort, a.list - b.list, a.pair - b.pair, a.integrate - b.integrate};
    }
};

}  // namespace headrace::bench
