#include "client/arguments.h"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "proto/suggest.h"

namespace headrace::client {

namespace {

std::optional<std::int64_t> parse_count(std::string_view word) {
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc{} || end != word.data() + word.size() || count < 0) return std::nullopt;
    return count;
}

std::optional<std::vector<double>> numbers_in(std::string_view word) {
    std::vector<double> numbers;
    for (const std::string& part : split(word, ',')) {
        const auto value = parse_number(part);
        if (!value) return std::nullopt;
        numbers.push_back(*value);
    }
    return numbers;
}

std::string quoted(std::string_view word) {
    std::string text(1, '"');
    return text.append(word).append(1, '"');
}

}  // namespace

proto::Error usage_error(std::string message, std::string path, std::string hint) {
    return {proto::ErrorCode::usage, std::move(message), std::move(path), std::move(hint)};
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> parse_number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::optional<double> parse_seconds(std::string_view word) {
    if (word.ends_with('s')) word.remove_suffix(1);
    const auto value = parse_number(word);
    return value && *value >= 0 ? value : std::nullopt;
}

proto::Result<std::vector<double>> parse_numbers(std::string_view word, std::string_view option) {
    if (auto numbers = numbers_in(word)) return *std::move(numbers);
    return usage_error(quoted(word) + " is not a list of numbers", std::string(option),
                       "numbers with commas and no blanks, such as 0,0.5,1");
}

proto::Result<proto::Vec3> parse_vector(std::string_view word, std::string_view option) {
    auto numbers = parse_numbers(word, option);
    if (!numbers) return numbers.error();
    if (numbers->size() != 2 && numbers->size() != 3)
        return usage_error("a vector has two or three numbers", std::string(option), "for example 0,-9.8,0");
    numbers->resize(3);
    return proto::Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

proto::ParameterValue parse_parameter_value(std::string_view word) {
    if (word == "true") return true;
    if (word == "false") return false;
    if (const auto value = parse_number(word)) return *value;
    if (auto numbers = numbers_in(word); numbers && (numbers->size() == 2 || numbers->size() == 3)) {
        numbers->resize(3);
        return proto::Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    }
    return std::string(word);
}

proto::Result<proto::Parameters> parse_assignments(const std::vector<std::string>& words) {
    proto::Parameters parameters;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            return usage_error(quoted(word) + " assigns nothing", word, "write name=value, for example viscosity=5");
        const std::string name = word.substr(0, equals);
        if (!parameters.emplace(name, parse_parameter_value(word.substr(equals + 1))).second)
            return usage_error(quoted(name) + " is given twice", word);
    }
    return parameters;
}

proto::Result<proto::RunUntil> parse_until(std::string_view word) {
    proto::RunUntil until;
    const auto count_after = [&](std::string_view prefix) -> std::optional<std::int64_t> {
        return word.starts_with(prefix) ? parse_count(word.substr(prefix.size())) : std::nullopt;
    };
    if (word == "at-rest" || word == "at_rest")
        until.at_rest = true;
    else if (const auto step = count_after("step="))
        until.step = *step;
    else if (const auto steps = count_after("steps="))
        until.steps = *steps;
    else if (const std::size_t sign = word.find_first_of("<>"); sign != std::string_view::npos && sign > 0) {
        const auto value = parse_number(word.substr(sign + 1));
        if (!value)
            return usage_error(quoted(word) + " compares a probe with no number", "--until", "such as 'gauge>0.3'");
        until.probe.emplace();
        until.probe->probe = word.substr(0, sign);
        (word[sign] == '>' ? until.probe->above : until.probe->below) = *value;
    } else if (const auto seconds = parse_seconds(word))
        (word.starts_with('+') ? until.duration : until.time) = *seconds;
    else
        return usage_error(
            quoted(word) + " is no end of a run", "--until",
            "at-rest, 2 (t = 2 s), +2 (2 s from now), step=400, steps=400, or a probe's value: 'gauge>0.3'");
    return until;
}

namespace {

proto::Error no_field(const std::string& name, const std::string& path) {
    std::vector<std::string> known;
    for (const proto::FieldInfo& info : proto::kFields) known.emplace_back(info.name);
    return usage_error("there is no field \"" + name + "\"", path, proto::suggest(name, known));
}

}  // namespace

proto::Result<proto::FieldSet> parse_fields(std::string_view word) {
    proto::FieldSet fields;
    for (const std::string& name : split(word, ',')) {
        if (const auto field = proto::find_field(name)) {
            fields.insert(*field);
            continue;
        }
        return no_field(name, name);
    }
    return fields;
}

proto::Result<proto::Field> parse_color_field(std::string_view word) {
    constexpr std::pair<std::string_view, proto::Field> kOtherNames[] = {
        {"speed", proto::Field::velocity}, {"|velocity|", proto::Field::velocity}, {"v", proto::Field::velocity},
        {"p", proto::Field::pressure},     {"rho", proto::Field::density},         {"a", proto::Field::acceleration}};
    for (const auto& [name, field] : kOtherNames)
        if (name == word) return field;
    if (const auto field = proto::find_field(word)) return *field;
    return no_field(std::string(word), "--color-by");
}

proto::Result<proto::Precision> parse_precision(std::string_view word) {
    if (word == "f4") return proto::Precision::f4;
    if (word == "f8") return proto::Precision::f8;
    return usage_error(quoted(word) + " is no precision", "--precision", "f4 (single) or f8 (double)");
}

proto::Result<std::pair<std::optional<double>, std::optional<double>>> parse_range(std::string_view word) {
    const auto error = usage_error(quoted(word) + " is no range", "--range", "write low:high, such as 0:2");
    const std::vector<std::string> ends = split(word, ':');
    if (ends.size() != 2) return error;
    std::pair<std::optional<double>, std::optional<double>> range{parse_number(ends[0]), parse_number(ends[1])};
    if ((!range.first && !ends[0].empty()) || (!range.second && !ends[1].empty())) return error;
    if (range.first && range.second && *range.first >= *range.second) return error;
    return range;
}

proto::Result<std::pair<int, int>> parse_size(std::string_view word) {
    constexpr std::int64_t kLargest = 16'384;  // [pixels] a side; a picture past it is a slip
    const std::vector<std::string> sides = split(word, 'x');
    if (sides.size() == 2) {
        const auto width = parse_count(sides[0]), height = parse_count(sides[1]);
        if (width && height && *width >= 16 && *height >= 16 && *width <= kLargest && *height <= kLargest)
            return std::pair{static_cast<int>(*width), static_cast<int>(*height)};
    }
    return usage_error(quoted(word) + " is no size of a picture", "--size",
                       "write WIDTHxHEIGHT with sides of 16 to 16384 pixels, such as 1280x720");
}

proto::Result<Removal> parse_removal(std::string_view word) {
    const std::size_t at = word.rfind('@');
    if (at != std::string_view::npos && at > 0) {
        if (auto when = parse_until(word.substr(at + 1))) return Removal{std::string(word.substr(0, at)), *when};
    }
    return usage_error(quoted(word) + " names no object and moment", "--remove",
                       "write NAME@at-rest or NAME@TIME, such as panel@1.5");
}

proto::Result<proto::BoxDesc> parse_box(std::string_view word, const std::string& option) {
    auto numbers = parse_numbers(word, option);
    if (!numbers) return numbers.error();
    const std::vector<double>& n = *numbers;
    if (n.size() == 4) return proto::BoxDesc{{n[0], n[1], 0}, {n[2], n[3], 0}};
    if (n.size() == 6) return proto::BoxDesc{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    return usage_error("a box has 4 numbers (2D) or 6 (3D)", option, "x0,y0,x1,y1 or x0,y0,z0,x1,y1,z1");
}

proto::Result<proto::SphereDesc> parse_sphere(std::string_view word) {
    auto numbers = parse_numbers(word, "--sphere");
    if (!numbers) return numbers.error();
    const std::vector<double>& n = *numbers;
    if (n.size() == 3) return proto::SphereDesc{{n[0], n[1], 0}, n[2]};
    if (n.size() == 4) return proto::SphereDesc{{n[0], n[1], n[2]}, n[3]};
    return usage_error("a sphere has 3 numbers (2D) or 4 (3D)", "--sphere", "x,y,radius or x,y,z,radius");
}

proto::Result<proto::CylinderDesc> parse_cylinder(std::string_view word) {
    auto numbers = parse_numbers(word, "--cylinder");
    if (!numbers) return numbers.error();
    const std::vector<double>& n = *numbers;
    if (n.size() == 7) return proto::CylinderDesc{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]};
    return usage_error("a cylinder has 7 numbers", "--cylinder",
                       "the centres of its flat ends and the radius: x0,y0,z0,x1,y1,z1,r; in 2D use --sphere");
}

proto::Result<proto::PlaneDesc> parse_plane(std::string_view word) {
    auto numbers = parse_numbers(word, "--plane");
    if (!numbers) return numbers.error();
    const std::vector<double>& n = *numbers;
    if (n.size() == 4) return proto::PlaneDesc{{n[0], n[1], 0}, {n[2], n[3], 0}};
    if (n.size() == 6) return proto::PlaneDesc{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
    return usage_error("a plane has 4 numbers (2D) or 6 (3D)", "--plane",
                       "a point and the normal towards the fluid: x,y,nx,ny or x,y,z,nx,ny,nz");
}

}  // namespace headrace::client
