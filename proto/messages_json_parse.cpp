// JSON text -> value under our limits. The library alone would take the last of two equal keys and nest without end.
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <vector>

#include "proto/json_path.h"
#include "proto/json_visitors.h"

namespace headrace::proto {

namespace {

struct Place {
    std::size_t line{1}, column{1};  // column in bytes
};

Place place_of(std::string_view text, std::size_t offset) {
    Place place;
    for (char c : text.substr(0, offset)) {
        ++place.column;
        if (c == '\n') place = {place.line + 1, 1};
    }
    return place;
}

// The remedy for usual slips, from the text at the token that was not understood.
std::string hint_for(std::string_view token) {
    for (std::string_view number : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-inf"})
        if (token.starts_with(number)) return "numbers must be finite";
    if (token.starts_with('\'')) return "strings and names stand in double quotes";
    if (token.starts_with('/') || token.starts_with('#')) return "JSON has no comments";
    if (token.starts_with('}') || token.starts_with(']')) return "no comma before a closing bracket";
    if (token.starts_with("True") || token.starts_with("False")) return "true and false are written in small letters";
    if (token.starts_with("None")) return "leave the member out instead";
    return {};
}

// Builds the value from the parser's events; the first offence ends the parse.
class Builder {
  public:
    explicit Builder(std::string_view text) : text_(text) {}

    Json take() { return std::move(root_); }
    const Error& error() const { return error_; }

    bool null() { return put(Json(nullptr)); }
    bool boolean(bool x) { return put(Json(x)); }
    bool number_integer(Json::number_integer_t x) { return put(Json(x)); }
    bool number_unsigned(Json::number_unsigned_t x) { return put(Json(x)); }
    bool number_float(Json::number_float_t x, const std::string&) { return put(Json(x)); }
    bool string(std::string& x) { return put(Json(std::move(x))); }
    bool binary(Json::binary_t&) { return false; }  // no JSON text has one
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name) {
        Level& level = levels_.back();
        const bool is_new = level.names.insert(name).second;
        level.name = std::move(name);
        if (is_new) return true;
        error_ = {ErrorCode::duplicate_key, "member " + in_quotes(level.name) + " is given twice", path(), "keep one"};
        return false;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& failure) {
        const std::size_t offset = position == 0 ? 0 : position - 1;
        const Place place = place_of(text_, offset);
        error_ = {ErrorCode::parse_error, {}, path(), {}};
        error_.message = "line " + std::to_string(place.line) + ", column " + std::to_string(place.column) + ": ";
        if (dynamic_cast<const Json::out_of_range*>(&failure)) {
            error_.message += "number too large";
            error_.hint = "numbers must be finite";
        } else if (offset >= text_.size()) {
            error_.message += text_.empty() ? "nothing there" : "the text ends too early";
        } else {
            error_.message += reason(failure.what());
            // The parser stops somewhere inside a bad word: look at the word from its start.
            std::size_t start = offset;
            while (start > 0 && (std::isalpha(static_cast<unsigned char>(text_[start - 1])) || text_[start - 1] == '-'))
                --start;
            error_.message += ", near " + in_quotes(text_.substr(start, 12));
            error_.hint = hint_for(text_.substr(start));
        }
        return false;
    }

  private:
    // An open object or array. `names` keeps the check for equal keys linear in the text's length.
    struct Level {
        Json* value;
        std::unordered_set<std::string> names;
        std::string name;  // of the member being read
    };

    // "syntax error while parsing value - invalid literal", out of the library's longer text.
    static std::string reason(std::string_view what) {
        const std::size_t start = what.find("syntax error");
        if (start == std::string_view::npos) return "syntax error";
        what.remove_prefix(start);
        return std::string(what.substr(0, what.find("; last read")));
    }

    bool put(Json value) { return place(std::move(value)) != nullptr; }

    bool open(Json value) {
        if (levels_.size() >= static_cast<std::size_t>(kMaxJsonDepth)) {
            error_ = {ErrorCode::json_too_deep,
                      "nested deeper than " + std::to_string(kMaxJsonDepth) + " levels",
                      {},
                      "no message of the protocol needs more"};
            return false;
        }
        levels_.push_back({place(std::move(value)), {}, {}});
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    // Appends without the library's search for an equal key. The address stays good while the value is open: its
    // parent grows only afterwards.
    Json* place(Json value) {
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Level& level = levels_.back();
        if (level.value->is_array()) {
            level.value->push_back(std::move(value));
            return &level.value->back();
        }
        auto& members = level.value->get_ref<Json::object_t&>();
        members.emplace_back(level.name, std::move(value));
        return &members.back().second;
    }

    std::string path() const {
        std::string where;
        for (const Level& level : levels_) {
            // An item that is open itself is in the array already; a number or text is not yet.
            const bool holds_item = &level != &levels_.back();
            if (level.value->is_array())
                append_index(where, level.value->size() - (holds_item ? 1 : 0));
            else if (!level.name.empty())
                append_member(where, level.name);
        }
        return where;
    }

    std::string_view text_;
    Json root_;
    std::vector<Level> levels_;
    Error error_;
};

}  // namespace

Result<Json> parse_json(std::string_view text) {
    Builder builder(text);
    if (!Json::sax_parse(text.begin(), text.end(), &builder)) return builder.error();
    return builder.take();
}

}  // namespace headrace::proto
