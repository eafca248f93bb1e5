// The members of each message, told once: `describe(visitor, message)` names every member with its unit, range and
// meaning, and three visitors make decoder, encoder and schema of it. Internal to messages_json; no JSON library here.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "proto/messages.h"

namespace headrace::proto {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// Admissible numbers. Integers are checked in the same way: their bounds of ours are far below 2^53.
struct Range {
    double min{-kInfinity};
    double max{kInfinity};
    bool above_min{false};  // greater than min instead of at least min
};
inline constexpr Range kPositive{0.0, kInfinity, true};
inline constexpr Range kNotNegative{0.0, kInfinity, false};
constexpr Range at_least(double min) {
    return {min, kInfinity, false};
}
constexpr Range between(double min, double max) {
    return {min, max, false};
}

// name: 1 to 64 of A-Z a-z 0-9 _ . -    recording_file: ends in .mcap, no control characters
enum class Text { free, name, recording_file };

inline constexpr std::size_t kMaxNameLength = 64;
inline constexpr std::size_t kMaxExpressionText = 1000;
inline constexpr std::string_view kNamePattern = "^[A-Za-z0-9_.-]{1,64}$";

// What is said about one member.
struct About {
    std::string_view meaning{};
    std::string_view unit{};  // SI, "1" for a ratio; empty for what is no quantity
    Range range{};
    Text text{Text::free};
    std::size_t max_length{kNoLimit};  // of a text, in characters
    std::size_t min_items{0};          // of a list or map
    std::size_t max_items{kNoLimit};
    bool may_be_non_finite{false};  // "NaN", "Infinity" and "-Infinity" are read too
    bool only_true{false};          // a flag that is left out instead of set to false
    std::size_t choices{kNoLimit};  // a variant: the schema states its first so many alternatives only
};

// optional: has a default. absent_means_none: std::optional, no default value to speak of.
enum class Presence { required, optional, absent_means_none };

// A member that takes part in an "exactly one of" rule, and whether it is there.
struct Alternative {
    std::string_view name;
    bool is_present{};
};

// Members that exist only while another member has a certain value.
struct Condition {
    std::string_view member;
    std::string_view value;
    bool is_default{};  // the member has this value when it is absent
};

template <class E>
struct EnumNames;  // in enumerator order
template <>
struct EnumNames<SimState> {
    static constexpr std::array<std::string_view, 5> names{"empty", "loading", "idle", "running", "faulted"};
};
template <>
struct EnumNames<JobState> {
    static constexpr std::array<std::string_view, 6> names{"running",   "paused",    "finished",
                                                           "cancelled", "timed_out", "faulted"};
};
template <>
struct EnumNames<Precision> {
    static constexpr std::array<std::string_view, 2> names{"f4", "f8"};
};
template <>
struct EnumNames<StreamMode> {
    static constexpr std::array<std::string_view, 2> names{"live", "lossless"};
};
template <>
struct EnumNames<OnStall> {
    static constexpr std::array<std::string_view, 2> names{"pause", "fail"};
};
template <>
struct EnumNames<Compression> {
    static constexpr std::array<std::string_view, 2> names{"none", "zstd"};
};
template <>
struct EnumNames<ObjectRole> {
    static constexpr std::array<std::string_view, 2> names{"container", "obstacle"};
};
template <>
struct EnumNames<WallSlip> {
    static constexpr std::array<std::string_view, 2> names{"free_slip", "no_slip"};
};

template <>
struct EnumNames<LevelSurface> {
    static constexpr std::array<std::string_view, 2> names{"highest", "lowest"};
};
template <>
struct EnumNames<ProfileField> {
    static constexpr std::array<std::string_view, 5> names{"pressure", "density", "velocity_x", "velocity_y",
                                                           "velocity_z"};
};

// A variant written as an object with one member, which names the alternative.
template <class V>
struct Tags;
template <>
struct Tags<ShapeDesc> {
    static constexpr std::array<std::string_view, 6> names{"box",   "sphere",     "cylinder",
                                                           "plane", "difference", "intersection"};
    static constexpr std::string_view definition = "shape";  // shapes hold shapes: the schema refers to it by this name
};
inline constexpr std::size_t kPrimitiveShapes = 4;  // the first so many hold no shapes
template <>
struct Tags<SceneAction> {
    static constexpr std::array<std::string_view, 4> names{"remove_object", "move_object", "set_parameters", "pause"};
};
template <>
struct Tags<ProbeKind> {
    static constexpr std::array<std::string_view, 9> names{"pressure",  "velocity", "level",    "profile", "front",
                                                           "discharge", "force",    "energies", "density"};
};

class Visitor {
  public:
    virtual ~Visitor() = default;

    template <class T>
    void required(std::string_view name, T& x, const About& about) {
        if (!enter(name, Presence::required, false)) return;
        visit(x, about);
        leave();
    }
    template <class T>
    void optional(std::string_view name, T& x, const About& about) {
        bool is_empty = false;
        if constexpr (requires { x.empty(); }) is_empty = x.empty();
        if (!enter(name, Presence::optional, is_empty)) return;
        visit(x, about);
        leave();
    }
    template <class T>
    void optional(std::string_view name, std::optional<T>& x, const About& about) {
        if (!enter(name, Presence::absent_means_none, !x.has_value())) return;
        if (!x) x.emplace();
        visit(*x, about);
        leave();
    }

    // Left out in writing while it is the default.
    template <class T>
    void unless_default(std::string_view name, T& x, const About& about, const T& absent = {}) {
        if (!enter(name, Presence::optional, x == absent)) return;
        visit(x, about);
        leave();
    }

    // The reader's rules beyond single members; the schema states those it can.
    virtual void tolerate_text(std::string_view /*name*/) {}  // a text that is read and forgotten
    virtual void at_most_one(std::initializer_list<Alternative>) {}
    virtual void exactly_one(std::initializer_list<Alternative>) {}
    virtual void only_with(const Alternative& /*member*/, const Alternative& /*needed*/) {}
    virtual void begin_only_when(const Condition&, bool /*holds*/) {}
    virtual void end_only_when() {}
    // `member` is relative to the message being described and may be empty.
    virtual void refuse(std::string_view /*member*/, std::string /*message*/, std::string /*hint*/) {}

    // Of the scene being read: vectors must have (3), or may have (2), so many components. 0: not known.
    int dimensions{0};

    template <class T>
    void visit(T& x, const About& about);

  protected:
    virtual bool enter(std::string_view name, Presence presence, bool is_empty) = 0;
    virtual void leave() = 0;
    virtual bool begin_object(const About& about) = 0;
    virtual void end_object() = 0;
    virtual std::size_t begin_list(std::size_t size, const About& about) = 0;  // returns how many items to visit
    virtual bool enter_item(std::size_t index) = 0;
    virtual void leave_item() = 0;
    virtual void end_list() = 0;
    virtual bool begin_choice(std::span<const std::string_view> tags, const About& about) = 0;
    virtual bool enter_choice(std::string_view tag, bool is_current) = 0;
    virtual void leave_choice() = 0;
    virtual void end_choice() = 0;
    // A plain value (a name, numbers) or an object instead; `kinds` names both for people.
    virtual void begin_plain_or_object(std::string_view kinds, const About& about) = 0;
    virtual bool enter_plain(bool is_current) = 0;
    virtual bool enter_object(bool is_current) = 0;
    virtual void leave_either() = 0;
    // A part that holds parts of its own kind. false: it is described elsewhere.
    virtual bool begin_definition(std::string_view /*name*/, const About&) { return true; }
    virtual void end_definition() {}

    virtual void value(double& x, const About& about) = 0;
    virtual void value(std::optional<double>& x, const About& about) = 0;  // in a list: null where there is none
    virtual void value(bool& x, const About& about) = 0;
    virtual void value(std::string& x, const About& about) = 0;
    virtual void value(Vec3& x, const About& about) = 0;
    virtual void value(Scalar& x, const About& about) = 0;
    virtual void value(ScalarVec3& x, const About& about) = 0;
    virtual void value(std::array<bool, 3>& x, const About& about) = 0;
    virtual void value(FieldSet& x, const About& about) = 0;
    virtual void value(ParameterValue& x, const About& about) = 0;
    virtual void value(Parameters& x, const About& about) = 0;
    virtual void value(std::map<std::string, EventValue>& x, const About& about) = 0;
    virtual void signed_value(std::int64_t& x, const About& about) = 0;
    virtual void unsigned_value(std::uint64_t& x, const About& about) = 0;
    virtual void enum_value(std::size_t& index, std::span<const std::string_view> names, const About& about) = 0;

  private:
    template <class T>
    void visit_integer(T& x, About about);
    template <class T>
    void visit_list(std::vector<T>& x, const About& about);
    template <class V>
    void visit_choice(V& x, const About& about);
    template <std::size_t k, class V>
    void visit_alternative(V& x);
    template <class Plain, class Object>
    void visit_plain_or_object(std::variant<Plain, Object>& x, const About& about);
};

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

template <class T>
void Visitor::visit(T& x, const About& about) {
    if constexpr (std::is_enum_v<T>) {
        auto index = static_cast<std::size_t>(x);
        enum_value(index, EnumNames<T>::names, about);
        x = static_cast<T>(index);
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
        visit_integer(x, about);
    } else if constexpr (is_list<T>) {
        visit_list(x, about);
    } else if constexpr (requires { Tags<T>::definition; }) {
        // Objects allow fewer alternatives, none of which holds parts: no definition is needed.
        if (about.choices != kNoLimit) return visit_choice(x, about);
        if (!begin_definition(Tags<T>::definition, about)) return;
        visit_choice(x, about);
        end_definition();
    } else if constexpr (requires { Tags<T>::names; }) {
        visit_choice(x, about);
    } else if constexpr (requires { value(x, about); }) {
        value(x, about);
    } else if constexpr (requires { visit_plain_or_object(x, about); }) {
        visit_plain_or_object(x, about);
    } else if (begin_object(about)) {
        describe(*this, x);
        end_object();
    }
}

// Narrow integers travel as 64-bit ones; the range keeps them narrow.
template <class T>
void Visitor::visit_integer(T& x, About about) {
    if constexpr (sizeof(T) < 8) {
        about.range.min = std::max(about.range.min, static_cast<double>(std::numeric_limits<T>::min()));
        about.range.max = std::min(about.range.max, static_cast<double>(std::numeric_limits<T>::max()));
    }
    if constexpr (std::is_signed_v<T>) {
        auto wide = static_cast<std::int64_t>(x);
        signed_value(wide, about);
        x = static_cast<T>(wide);
    } else {
        auto wide = static_cast<std::uint64_t>(x);
        unsigned_value(wide, about);
        x = static_cast<T>(wide);
    }
}

template <class T>
void Visitor::visit_list(std::vector<T>& x, const About& about) {
    x.resize(begin_list(x.size(), about));
    About of_item = about;
    of_item.meaning = {};
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (!enter_item(k)) break;
        visit(x[k], of_item);
        leave_item();
    }
    end_list();
}

template <std::size_t k, class V>
void Visitor::visit_alternative(V& x) {
    if (!enter_choice(Tags<V>::names[k], x.index() == k)) return;
    if (x.index() != k) x.template emplace<k>();
    visit(std::get<k>(x), {});
    leave_choice();
}

template <class V>
void Visitor::visit_choice(V& x, const About& about) {
    if (!begin_choice(Tags<V>::names, about)) return;
    [&]<std::size_t... k>(std::index_sequence<k...>) {
        (visit_alternative<k>(x), ...);
    }
    (std::make_index_sequence<Tags<V>::names.size()>{});
    end_choice();
}

template <class Plain, class Object>
void Visitor::visit_plain_or_object(std::variant<Plain, Object>& x, const About& about) {
    constexpr bool is_name = std::is_same_v<Plain, std::string>;
    begin_plain_or_object(is_name                             ? "a name or an object"
                          : std::is_same_v<Plain, ScalarVec3> ? "an array of numbers and expressions, or a table"
                                                              : "a number, an expression, or a table",
                          about);
    if (enter_plain(x.index() == 0)) {
        if (x.index() != 0) x.template emplace<0>();
        About plain = is_name ? About{.text = Text::name} : about;
        plain.meaning = {};
        visit(std::get<0>(x), plain);
        leave_either();
    }
    if (enter_object(x.index() == 1)) {  // the schema has both
        if (x.index() != 1) x.template emplace<1>();
        visit(std::get<1>(x), {.unit = is_name ? std::string_view{} : about.unit});
        leave_either();
    }
}

}  // namespace headrace::proto
