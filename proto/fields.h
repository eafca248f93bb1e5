// The closed table of particle fields that can be asked for in frames and recordings.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace headrace::proto {

enum class Field : std::uint8_t { id, position, velocity, acceleration, density, pressure };

inline constexpr std::size_t kFieldCount = 6;

struct FieldInfo {
    Field field;
    std::string_view name;    // on the wire and in files
    std::string_view symbol;  // in formulas
    std::string_view unit;    // SI; "1" when it has none
    bool is_vector;           // components: the scene's dimensions (2 or 3), else 1
    bool is_integer;          // "<u4"; else "<f4", or "<f8" on request
    std::string_view meaning;
};

inline constexpr std::array<FieldInfo, kFieldCount> kFields{{
    {Field::id, "id", "i", "1", false, true,
     "particle number, from 0, in the order of the scene's fluids; never reused"},
    {Field::position, "position", "x", "m", true, false, "position at the frame's time"},
    {Field::velocity, "velocity", "v", "m/s", true, false, "velocity of the step just done (Staubach 2010, Eq. 2.36)"},
    {Field::acceleration, "acceleration", "a", "m/s^2", true, false, "acceleration evaluated in the step just done"},
    {Field::density, "density", "rho", "kg/m^3", false, false, "mass density evaluated in the step just done"},
    {Field::pressure, "pressure", "p", "Pa", false, false, "pressure evaluated in the step just done"},
}};

constexpr const FieldInfo& field_info(Field field) {
    return kFields[static_cast<std::size_t>(field)];
}

constexpr std::optional<Field> find_field(std::string_view name) {
    for (const FieldInfo& info : kFields)
        if (info.name == name) return info.field;
    return std::nullopt;
}

// A set of fields. Iterate kFields and ask `contains`: the order in a frame is the table's order.
class FieldSet {
  public:
    constexpr FieldSet() = default;
    constexpr FieldSet(std::initializer_list<Field> fields) {
        for (Field field : fields) insert(field);
    }
    constexpr void insert(Field field) { bits_ |= bit(field); }
    constexpr bool contains(Field field) const { return (bits_ & bit(field)) != 0; }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr FieldSet operator|(FieldSet other) const {
        FieldSet both;
        both.bits_ = bits_ | other.bits_;
        return both;
    }
    constexpr bool operator==(const FieldSet&) const = default;

  private:
    static constexpr std::uint32_t bit(Field field) { return 1u << static_cast<unsigned>(field); }
    std::uint32_t bits_{0};
};

inline constexpr FieldSet kDefaultFields{Field::id, Field::position, Field::velocity, Field::density, Field::pressure};

}  // namespace headrace::proto
