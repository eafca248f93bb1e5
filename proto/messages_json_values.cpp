// Reading numbers, texts, vectors and parameters, with their ranges and units.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "proto/json_path.h"
#include "proto/json_reader.h"
#include "proto/suggest.h"

namespace headrace::proto {

namespace {

constexpr double kLargestExactInteger = 9007199254740992.0;  // 2^53
constexpr std::size_t kMaxParameterText = 256;

std::string in_unit(std::string_view unit) {
    std::string text;
    if (!unit.empty() && unit != "1") text.append(" ").append(unit);
    return text;
}

std::string with_unit(std::string_view kind, std::string_view unit) {
    std::string text(kind);
    if (!unit.empty() && unit != "1") text.append(" [").append(unit).append("]");
    return text;
}

std::string range_text(const Range& range, std::string_view unit) {
    const std::string suffix = in_unit(unit);
    if (range.min == range.max) return "must be " + number_text(range.min) + suffix;
    std::string text = "must be ";
    if (range.min > -kInfinity)
        text += (range.above_min ? "greater than " : "at least ") + number_text(range.min) + suffix;
    if (range.min > -kInfinity && range.max < kInfinity) text += " and ";
    if (range.max < kInfinity) text += "at most " + number_text(range.max) + suffix;
    return text;
}

bool is_within(const Range& range, double x) {
    return (range.above_min ? x > range.min : x >= range.min) && x <= range.max;
}

bool is_name(std::string_view text) {
    return !text.empty() && text.size() <= kMaxNameLength && std::all_of(text.begin(), text.end(), is_name_character);
}

std::size_t count_characters(std::string_view utf8) {
    return std::count_if(utf8.begin(), utf8.end(),
                         [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

std::optional<double> find_non_finite(const Json& json) {
    if (json == "NaN") return std::nan("");
    if (json == "Infinity") return kInfinity;
    if (json == "-Infinity") return -kInfinity;
    return std::nullopt;
}

}  // namespace

std::string found(const Json& json) {
    switch (json.type()) {
        case Json::value_t::null:
            return "null";
        case Json::value_t::object:
            return "an object";
        case Json::value_t::array:
            return "an array of " + std::to_string(json.size());
        case Json::value_t::string:
            return "the string " + in_quotes(json.get_ref<const std::string&>());
        default:
            return json_text(json);
    }
}

bool Reader::check_range(double x, const About& about) {
    if (is_within(about.range, x)) return true;
    fail(range_text(about.range, about.unit) + ", got " + found(node()));
    return false;
}

void Reader::value(double& x, const About& about) {
    if (error_) return;
    if (about.may_be_non_finite) {
        if (const auto special = find_non_finite(node())) {
            x = *special;
            return;
        }
    }
    if (!node().is_number()) return wrong_kind(with_unit("a number", about.unit));
    const double number = node().get<double>();
    if (!std::isfinite(number)) return fail("must be finite");
    if (check_range(number, about)) x = number;
}

void Reader::value(std::optional<double>& x, const About& about) {
    if (error_) return;
    x.reset();
    if (!node().is_null()) value(x.emplace(), about);
}

template <class Integer>
bool Reader::read_integer(Integer& x, const About& about) {
    if (error_) return false;
    const Json& json = node();
    const std::string kind = with_unit("an integer", about.unit);
    if (json.is_number_float()) {
        const double number = json.get<double>();
        if (number != std::trunc(number) || std::abs(number) > kLargestExactInteger) return wrong_kind(kind), false;
        if (std::is_unsigned_v<Integer> && number < 0) return fail("must be at least 0, got " + found(json)), false;
        x = static_cast<Integer>(number);
    } else if (json.is_number_unsigned()) {
        const auto number = json.get<std::uint64_t>();
        if (number > static_cast<std::uint64_t>(std::numeric_limits<Integer>::max()))
            return fail("is too large, got " + found(json)), false;
        x = static_cast<Integer>(number);
    } else if (json.is_number_integer()) {
        const auto number = json.get<std::int64_t>();
        if (std::is_unsigned_v<Integer> && number < 0) return fail("must be at least 0, got " + found(json)), false;
        x = static_cast<Integer>(number);
    } else {
        return wrong_kind(kind), false;
    }
    return check_range(static_cast<double>(x), about);
}

void Reader::signed_value(std::int64_t& x, const About& about) {
    if (std::int64_t read = x; read_integer(read, about)) x = read;
}

void Reader::unsigned_value(std::uint64_t& x, const About& about) {
    if (std::uint64_t read = x; read_integer(read, about)) x = read;
}

void Reader::value(bool& x, const About& about) {
    if (error_) return;
    if (!node().is_boolean()) return wrong_kind(about.only_true ? "true" : "true or false");
    x = node().get<bool>();
    if (about.only_true && !x) fail("must be true, got false", "leave the member out instead");
}

void Reader::value(std::string& x, const About& about) {
    if (error_) return;
    if (!node().is_string()) return wrong_kind("a string");
    const auto& text = node().get_ref<const std::string&>();
    if (about.text == Text::name && !is_name(text))
        return fail("must be 1 to 64 letters, digits, _ . or -, got " + in_quotes(text));
    if (count_characters(text) > about.max_length)
        return fail("must have at most " + std::to_string(about.max_length) + " characters");
    if (about.text == Text::recording_file) {
        const bool has_control = std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 32; });
        if (has_control) return fail("must have no control characters, got " + in_quotes(text));
        if (!text.ends_with(".mcap") || text.size() == 5) return fail("must end in .mcap, got " + in_quotes(text));
    }
    x = text;
}

void Reader::enum_value(std::size_t& index, std::span<const std::string_view> names, const About&) {
    if (error_) return;
    std::string all;
    for (std::string_view name : names) all.append(all.empty() ? "" : ", ").append(name);
    if (!node().is_string()) return wrong_kind("one of " + all);
    const auto& text = node().get_ref<const std::string&>();
    const auto match = std::find(names.begin(), names.end(), text);
    if (match == names.end())
        return fail("must be one of " + all + ", got " + in_quotes(text), suggest(text, {names.begin(), names.end()}));
    index = static_cast<std::size_t>(match - names.begin());
}

template <class T>
void Reader::read_per_axis(std::array<T, 3>& x, std::string_view items, const T& none, const About& about) {
    if (error_) return;
    const std::size_t size = node().is_array() ? node().size() : 0;
    if (size != 3 && (size != 2 || dimensions == 3)) {
        const std::string count = dimensions == 3 ? "an array of 3 " : "an array of 2 or 3 ";
        return wrong_kind(with_unit(count + std::string(items), about.unit));
    }
    std::array<T, 3> read{};
    for (std::size_t k = 0; k < size && !error_; ++k) {
        push(node()[k], {{}, k, true});
        value(read[k], about);
        if (k == 2 && dimensions == 2 && !error_ && read[2] != none)
            fail(std::string("must be ") + (std::is_same_v<T, bool> ? "false" : "0") +
                     " in a scene of 2 dimensions, got " + found(node()),
                 "leave the third " + std::string(std::is_same_v<T, bool> ? "value" : "number") + " out");
        pop();
    }
    if (!error_) x = read;
}

void Reader::value(Vec3& x, const About& about) {
    read_per_axis(x, "numbers", 0.0, about);
}

void Reader::value(ScalarVec3& x, const About& about) {
    read_per_axis(x, "numbers or expressions", Scalar{0.0}, about);
}

void Reader::value(std::array<bool, 3>& x, const About& about) {
    read_per_axis(x, "true or false", false, about);
}

void Reader::value(Scalar& x, const About& about) {
    if (error_) return;
    if (node().is_number()) return value(x.emplace<double>(), about);
    if (!node().is_string()) return wrong_kind(with_unit("a number or an expression", about.unit));
    value(x.emplace<std::string>(), About{.max_length = kMaxExpressionText});
}

void Reader::value(FieldSet& x, const About& about) {
    if (error_) return;
    if (!node().is_array()) return wrong_kind("an array of field names");
    if (!check_count(node().size(), about, "fields")) return;
    FieldSet read;
    for (std::size_t k = 0; k < node().size() && !error_; ++k) {
        push(node()[k], {{}, k, true});
        std::string name;
        value(name, {});
        const auto field = find_field(name);
        if (!error_ && !field) {
            std::vector<std::string> known;
            for (const FieldInfo& info : kFields) known.emplace_back(info.name);
            fail("unknown field " + in_quotes(name), suggest(name, known));
        } else if (!error_ && read.contains(*field)) {
            fail("field " + in_quotes(name) + " is named twice");
        } else if (!error_) {
            read.insert(*field);
        }
        pop();
    }
    if (!error_) x = read;
}

void Reader::value(ParameterValue& x, const About&) {
    if (error_) return;
    if (node().is_number())
        value(x.emplace<double>(), About{});
    else if (node().is_boolean())
        x = node().get<bool>();
    else if (node().is_string())
        value(x.emplace<std::string>(), About{.max_length = kMaxParameterText});
    else if (node().is_array())
        value(x.emplace<Vec3>(), About{});
    else
        wrong_kind("a number, true or false, a string or a vector");
}

void Reader::value(Parameters& x, const About& about) {
    if (error_) return;
    if (!node().is_object()) return wrong_kind("an object of parameters");
    if (!check_count(node().size(), about, "parameters")) return;
    x.clear();
    for (const auto& [name, json] : node().items()) {
        push(json, {name});
        if (!is_name(name)) fail("is no parameter's name");
        value(x[name], About{});
        pop();
        if (error_) return;
    }
}

void Reader::value(std::map<std::string, EventValue>& x, const About&) {
    if (error_) return;
    if (!node().is_object()) return wrong_kind("an object");
    x.clear();
    for (const auto& [name, json] : node().items()) {
        push(json, {name});
        if (json.is_boolean())
            x[name] = json.get<bool>();
        else if (json.is_string())
            x[name] = json.get<std::string>();
        else if (json.is_number_float())
            x[name] = json.get<double>();
        else if (json.is_number())
            signed_value(x[name].emplace<std::int64_t>(), About{});
        else
            wrong_kind("a number, true or false, or a string");
        pop();
        if (error_) return;
    }
}

}  // namespace headrace::proto
