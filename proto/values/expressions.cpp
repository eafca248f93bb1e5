#include "proto/values/expressions.h"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;
using proto::Vec3;

// A muParser with the places of its variables; it stays where it is, because the parser points into it.
class Formula::Parser {
  public:
    Parser(const std::string& text, const Symbols& symbols) : text_(text), symbols_(symbols) {
        parser_.DefineConst("pi", std::numbers::pi);
        parser_.DefineConst("dx", symbols.spacing);
        if (symbols.position) {
            constexpr const char* kAxes[]{"x", "y", "z"};
            for (int k = 0; k < symbols.dimensions; ++k) parser_.DefineVar(kAxes[k], &x_[k]);
        }
        if (symbols.time) parser_.DefineVar("t", &t_);
        parser_.SetExpr(text);
    }
    Parser(const Parser&) = delete;
    Parser& operator=(const Parser&) = delete;

    std::shared_ptr<Parser> clone() const { return std::make_shared<Parser>(text_, symbols_); }

    double operator()(const Vec3& x, double t) {
        x_ = x;
        t_ = t;
        return parser_.Eval();
    }
    int result_count() const { return parser_.GetNumResults(); }
    bool uses(const char* name) const { return parser_.GetUsedVar().contains(name); }

  private:
    std::string text_;
    Symbols symbols_;
    Vec3 x_{};
    double t_{};
    mu::Parser parser_;
};

namespace {

std::string allowed(const Symbols& symbols) {
    std::string names;
    if (symbols.position) names = symbols.dimensions == 2 ? "x, y" : "x, y, z";
    if (symbols.time) names += names.empty() ? "t" : ", t";
    return "it may name " + (names.empty() ? std::string("no variables") : names) +
           "; constants: pi, dx; functions: sin, cos, tan, sqrt, exp, ln, abs, min, max, ...";
}

// muParser's own would change a variable.
bool has_assignment(const std::string& text) {
    const auto is_one_of = [&](std::size_t k, const char* characters) {
        return k < text.size() && std::string_view(characters).find(text[k]) != std::string_view::npos;
    };
    for (std::size_t k = 0; k < text.size(); ++k)
        if (text[k] == '=' && !is_one_of(k + 1, "=") && (k == 0 || !is_one_of(k - 1, "=<>!"))) return true;
    return false;
}

// What cannot be seen; muParser would end at a NUL and ignore the rest.
bool has_control_character(const std::string& text) {
    return std::ranges::any_of(text, [](unsigned char c) { return c < ' ' && c != '\t' && c != '\n' && c != '\r'; });
}

Error refused(const std::string& path, const std::string& message, const std::string& hint) {
    return {ErrorCode::scene_invalid, message, path, hint};
}

}  // namespace

Result<Formula> Formula::compile(const proto::Scalar& scalar, const Symbols& symbols, const std::string& path) {
    Formula formula;
    if (const double* number = std::get_if<double>(&scalar)) {
        if (!std::isfinite(*number)) return refused(path, "must be finite", "give a number or an expression");
        formula.value_ = *number;
        return formula;
    }
    const auto& text = std::get<std::string>(scalar);
    if (has_control_character(text))
        return refused(path, "has a control character", "write the expression in plain text");
    if (has_assignment(text))
        return refused(path, "cannot assign in an expression: \"" + text + "\"", "compare with ==, <=, >=, !=");
    try {
        auto parser = std::make_shared<Parser>(text, symbols);
        formula.value_ = (*parser)({}, 0.0);
        if (parser->result_count() != 1)
            return refused(path, "must be one value, \"" + text + "\" is " + std::to_string(parser->result_count()),
                           "write one expression without commas outside of functions");
        formula.uses_position_ = parser->uses("x") || parser->uses("y") || parser->uses("z");
        formula.uses_time_ = parser->uses("t");
        if (formula.uses_position_ || formula.uses_time_) {
            formula.parser_ = std::move(parser);
            formula.mutex_ = std::make_shared<std::mutex>();
            formula.value_ = 0.0;
        } else if (!std::isfinite(formula.value_)) {
            return refused(path, "\"" + text + "\" is " + std::to_string(formula.value_) + ", not a finite number",
                           "look for a division by zero or a root of a negative number");
        }
    } catch (const mu::ParserError& error) {
        std::string message = error.GetMsg();
        while (message.ends_with('.') || message.ends_with(' ')) message.pop_back();
        return refused(path, "is no valid expression: " + message + " of \"" + text + "\"", allowed(symbols));
    }
    return formula;
}

double Formula::operator()(const Vec3& x, double t) const {
    if (is_constant()) return value_;
    const std::lock_guard lock(*mutex_);
    return (*parser_)(x, t);
}

void FormulaTeam::prepare(int threads) {
    if (formula_.is_constant()) return;
    while (std::ssize(parsers_) < threads) parsers_.push_back(formula_.parser_->clone());
}

double FormulaTeam::operator()(int thread, const Vec3& x, double t) const {
    return formula_.is_constant() ? formula_.value_ : (*parsers_[static_cast<std::size_t>(thread)])(x, t);
}

Result<std::array<Formula, 3>> compile_vector(const proto::ScalarVec3& vector, const Symbols& symbols,
                                              const std::string& path) {
    std::array<Formula, 3> formulas;
    for (int k = 0; k < symbols.dimensions; ++k) {
        Result<Formula> formula = Formula::compile(vector[k], symbols, path + "[" + std::to_string(k) + "]");
        if (!formula) return formula.error();
        formulas[k] = std::move(*formula);
    }
    return formulas;
}

std::string place_text(const Vec3& x, int dimensions) {
    char text[128];
    const auto plain = [&](int k) { return x[k] + 0.0; };  // no "-0"
    if (dimensions == 2)
        std::snprintf(text, sizeof text, "(%.6g, %.6g) m", plain(0), plain(1));
    else
        std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", plain(0), plain(1), plain(2));
    return text;
}

std::string value_at_text(double value, const Vec3& x, int dimensions) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text + (" at " + place_text(x, dimensions));
}

}  // namespace headrace::scene
