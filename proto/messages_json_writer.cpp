// Message -> JSON.
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "proto/json_visitors.h"

namespace headrace::proto {

namespace {

// The JSON library would write NaN as null, which reads as "absent".
Json number(double x) {
    if (std::isnan(x)) return "NaN";
    if (std::isinf(x)) return x > 0 ? "Infinity" : "-Infinity";
    return x;
}

Json vector(const Vec3& x) {
    return Json::array({number(x[0]), number(x[1]), number(x[2])});
}

struct ParameterWriter {
    Json operator()(double x) const { return number(x); }
    Json operator()(bool x) const { return x; }
    Json operator()(std::int64_t x) const { return x; }
    Json operator()(const std::string& x) const { return x; }
    Json operator()(const Vec3& x) const { return vector(x); }
};

template <class Map>
Json map_of(const Map& map) {
    Json object = Json::object();
    for (const auto& [name, x] : map) object[name] = std::visit(ParameterWriter{}, x);
    return object;
}

class Writer final : public Visitor {
  public:
    explicit Writer(Json& root) : nodes_{&root} {}

    void begin_only_when(const Condition&, bool holds) override { is_left_out_ = !holds; }
    void end_only_when() override { is_left_out_ = false; }

  protected:
    bool enter(std::string_view name, Presence presence, bool is_empty) override {
        if (is_left_out_ || (is_empty && presence != Presence::required)) return false;
        push(node()[std::string(name)]);
        return true;
    }
    void leave() override { nodes_.pop_back(); }
    bool begin_object(const About&) override {
        node() = Json::object();
        return true;
    }
    void end_object() override {}
    std::size_t begin_list(std::size_t size, const About&) override {
        node() = Json::array();
        return size;
    }
    bool enter_item(std::size_t) override {
        node().push_back(nullptr);
        push(node().back());
        return true;
    }
    void leave_item() override { nodes_.pop_back(); }
    void end_list() override {}
    bool begin_choice(std::span<const std::string_view>, const About&) override {
        node() = Json::object();
        return true;
    }
    bool enter_choice(std::string_view tag, bool is_current) override {
        return is_current && enter(tag, Presence::required, false);
    }
    void leave_choice() override { nodes_.pop_back(); }
    void end_choice() override {}
    void begin_plain_or_object(std::string_view, const About&) override {}
    bool enter_plain(bool is_current) override { return is_current; }
    bool enter_object(bool is_current) override { return is_current; }
    void leave_either() override {}

    void value(double& x, const About&) override { node() = number(x); }
    void value(std::optional<double>& x, const About&) override { node() = x ? number(*x) : Json(nullptr); }
    void value(bool& x, const About&) override { node() = x; }
    void value(std::string& x, const About&) override { node() = x; }
    void value(Vec3& x, const About&) override { node() = vector(x); }
    void value(Scalar& x, const About&) override { node() = std::visit(ParameterWriter{}, x); }
    void value(ScalarVec3& x, const About&) override {
        node() = Json::array();
        for (const Scalar& component : x) node().push_back(std::visit(ParameterWriter{}, component));
    }
    void value(std::array<bool, 3>& x, const About&) override { node() = x; }
    void value(FieldSet& x, const About&) override {
        node() = Json::array();
        for (const FieldInfo& info : kFields)
            if (x.contains(info.field)) node().push_back(info.name);
    }
    void value(ParameterValue& x, const About&) override { node() = std::visit(ParameterWriter{}, x); }
    void value(Parameters& x, const About&) override { node() = map_of(x); }
    void value(std::map<std::string, EventValue>& x, const About&) override { node() = map_of(x); }
    void signed_value(std::int64_t& x, const About&) override { node() = x; }
    void unsigned_value(std::uint64_t& x, const About&) override { node() = x; }
    void enum_value(std::size_t& index, std::span<const std::string_view> names, const About&) override {
        node() = names[index];
    }

  private:
    Json& node() { return *nodes_.back(); }
    void push(Json& child) { nodes_.push_back(&child); }

    std::vector<Json*> nodes_;  // a parent is not touched while a child is open
    bool is_left_out_{false};
};

}  // namespace

Json write_message(AnyMessage from) {
    Json root;
    Writer writer(root);
    from.visit(writer, from.message);
    return root;
}

std::string json_text(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t kShown = 40;
    if (text.size() <= kShown) return json_text(Json(text));
    return json_text(Json(std::string(text.substr(0, kShown)) + "..."));
}

std::string number_text(double x) {
    if (std::abs(x) < 1e16 && x == std::trunc(x)) return std::to_string(static_cast<long long>(x));
    return json_text(number(x));
}

}  // namespace headrace::proto
