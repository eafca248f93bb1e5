// Expressions of the scene document in x, y, z [m] and t [s], compiled when the scene is loaded.
//
// The values do not depend on the number of threads: a formula is a pure function. muParser's parsers are not to be
// shared between threads, so each thread of a loop takes its own (FormulaTeam); a single call is guarded by a mutex.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"

namespace headrace::scene {

// What an expression may name, besides the constants pi and dx (the scene's spacing [m]).
struct Symbols {
    int dimensions{3};
    double spacing{};  // [m]
    bool position{false};
    bool time{false};
};

class Formula {
  public:
    // A number, or an expression that names only what `symbols` allows and is one value. Errors: scene_invalid at
    // `path`; a constant must be finite.
    static proto::Result<Formula> compile(const proto::Scalar& scalar, const Symbols& symbols, const std::string& path);

    Formula() = default;  // 0

    bool is_constant() const { return !parser_; }
    bool is_zero() const { return is_constant() && value_ == 0.0; }
    bool uses_position() const { return uses_position_; }
    bool uses_time() const { return uses_time_; }
    // Safe from any thread.
    double operator()(const proto::Vec3& x, double t) const;

    class Parser;

  private:
    friend class FormulaTeam;

    std::shared_ptr<Parser> parser_;  // null: the value
    std::shared_ptr<std::mutex> mutex_;
    double value_{0.0};
    bool uses_position_{false};
    bool uses_time_{false};
};

// One parser a thread: for loops over particles.
class FormulaTeam {
  public:
    explicit FormulaTeam(Formula formula) : formula_(std::move(formula)) {}

    const Formula& formula() const { return formula_; }
    // Makes the parsers of the threads 0 .. threads - 1. Call it before the loop.
    void prepare(int threads);
    // Each thread its own number.
    double operator()(int thread, const proto::Vec3& x, double t) const;

  private:
    Formula formula_;
    std::vector<std::shared_ptr<Formula::Parser>> parsers_;
};

// Three of them: a vector. Errors name the component: path[1].
proto::Result<std::array<Formula, 3>> compile_vector(const proto::ScalarVec3& vector, const Symbols& symbols,
                                                     const std::string& path);

// "(0.1, 0.2, 0) m", for errors; 2D: two coordinates.
std::string place_text(const proto::Vec3& x, int dimensions);
// "nan at (0.1, 0.2, 0) m", for errors; 2D: two coordinates.
std::string value_at_text(double value, const proto::Vec3& x, int dimensions);

}  // namespace headrace::scene
