// Message -> JSON schema 2020-12, usable alone: nested messages stand inside; only what holds parts of its own kind
// (shapes) is referred to, below "$defs" of the same schema.
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "proto/json_visitors.h"

namespace headrace::proto {

namespace {

Json bound(double x) {
    if (x == static_cast<double>(static_cast<std::int64_t>(x))) return static_cast<std::int64_t>(x);
    return x;
}

Json only(const char* keyword, Json value) {
    Json schema = Json::object();
    schema[keyword] = std::move(value);
    return schema;
}

Json only_required(std::string_view member) {
    return only("required", Json::array({member}));
}

Json scalar_types() {
    return Json::array({"number", "boolean", "string"});
}

Json non_finite_names() {
    return Json::array({"NaN", "Infinity", "-Infinity"});
}

class SchemaBuilder final : public Visitor {
  public:
    explicit SchemaBuilder(Json& root) : nodes_{&root} {}

    // Referred-to parts by name, once the message was visited.
    const std::map<std::string, Json>& definitions() const { return definitions_; }

    void tolerate_text(std::string_view name) override { node()["properties"][std::string(name)]["type"] = "string"; }
    void at_most_one(std::initializer_list<Alternative> members) override {
        for (const Alternative* a = members.begin(); a != members.end(); ++a)
            for (const Alternative* b = a + 1; b != members.end(); ++b) {
                Json pair = Json::object();
                pair["not"]["required"] = Json::array({a->name, b->name});
                node()["allOf"].push_back(std::move(pair));
            }
    }
    void exactly_one(std::initializer_list<Alternative> members) override {
        for (const Alternative& member : members) node()["oneOf"].push_back(only_required(member.name));
    }
    void only_with(const Alternative& member, const Alternative& needed) override {
        node()["dependentRequired"][std::string(member.name)] = Json::array({needed.name});
    }
    void begin_only_when(const Condition& condition, bool) override {
        Json rule = Json::object();
        rule["if"]["properties"][std::string(condition.member)]["const"] = condition.value;
        if (!condition.is_default) rule["if"]["required"] = Json::array({condition.member});
        rule["else"]["properties"] = Json::object();
        node()["allOf"].push_back(std::move(rule));
        is_conditional_ = true;
    }
    void end_only_when() override { is_conditional_ = false; }

  protected:
    bool enter(std::string_view name, Presence presence, bool) override {
        const std::string key(name);
        if (presence == Presence::required) node()["required"].push_back(key);
        if (is_conditional_) node()["allOf"].back()["else"]["properties"][key] = false;
        wants_default_ = presence == Presence::optional;
        nodes_.push_back(&(node()["properties"][key] = Json::object()));
        return true;
    }
    void leave() override {
        nodes_.pop_back();
        wants_default_ = false;
    }
    bool begin_object(const About& about) override {
        wants_default_ = false;
        open("object", about);
        node()["properties"] = Json::object();
        return true;
    }
    void end_object() override { node()["additionalProperties"] = false; }
    std::size_t begin_list(std::size_t, const About& about) override {
        wants_default_ = false;
        open("array", about);
        if (about.min_items > 0) node()["minItems"] = about.min_items;
        if (about.max_items != kNoLimit) node()["maxItems"] = about.max_items;
        return 1;
    }
    bool enter_item(std::size_t) override {
        nodes_.push_back(&(node()["items"] = Json::object()));
        return true;
    }
    void leave_item() override { nodes_.pop_back(); }
    void end_list() override {}
    bool begin_choice(std::span<const std::string_view>, const About& about) override {
        wants_default_ = false;
        describe_node(about);
        node()["oneOf"] = Json::array();
        choices_ = about.choices;
        return true;
    }
    bool enter_choice(std::string_view tag, bool) override {
        if (node()["oneOf"].size() >= choices_) return false;
        node()["oneOf"].push_back(Json::object());
        nodes_.push_back(&node()["oneOf"].back());
        node()["type"] = "object";
        node()["required"] = Json::array({tag});
        nodes_.push_back(&(node()["properties"][std::string(tag)] = Json::object()));
        return true;
    }
    void leave_choice() override {
        nodes_.pop_back();
        node()["additionalProperties"] = false;
        nodes_.pop_back();
    }
    void end_choice() override {}
    bool begin_definition(std::string_view name, const About& about) override {
        wants_default_ = false;
        describe_node(about);
        node()["$ref"] = "#/$defs/" + std::string(name);
        const auto [definition, is_new] = definitions_.try_emplace(std::string(name), Json::object());
        if (is_new) nodes_.push_back(&definition->second);
        return is_new;
    }
    void end_definition() override { nodes_.pop_back(); }
    void begin_plain_or_object(std::string_view, const About& about) override {
        wants_default_ = false;
        describe_node(about);
        node()["anyOf"] = Json::array({Json::object(), Json::object()});
    }
    bool enter_plain(bool) override {
        nodes_.push_back(&node()["anyOf"][0]);
        return true;
    }
    bool enter_object(bool) override {
        nodes_.push_back(&node()["anyOf"][1]);
        return true;
    }
    void leave_either() override { nodes_.pop_back(); }

    void value(double& x, const About& about) override {
        describe_node(about);
        number(node(), about);
        unit_of(about);
        default_of(x);
    }
    void value(std::optional<double>&, const About& about) override {
        describe_node(about);
        node()["type"] = Json::array({"number", "null"});
        unit_of(about);
        wants_default_ = false;
    }
    void value(bool& x, const About& about) override {
        describe_node(about);
        if (about.only_true)
            node()["const"] = true;
        else
            node()["type"] = "boolean";
        default_of(x);
    }
    void value(std::string& x, const About& about) override {
        open("string", about);
        if (about.text == Text::name) node()["pattern"] = kNamePattern;
        if (about.text == Text::recording_file) node()["pattern"] = "^[^\\u0000-\\u001f]+\\.mcap$";
        if (about.max_length != kNoLimit) node()["maxLength"] = about.max_length;
        if (!x.empty()) default_of(x);
    }
    void value(Vec3& x, const About& about) override {
        open("array", about);
        number(node()["items"], about);
        vector_size(node());
        unit_of(about);
        default_of(x);
    }
    void value(Scalar& x, const About& about) override {
        describe_node(about);
        expression(node());
        unit_of(about);
        std::visit([this](const auto& absent) { default_of(absent); }, x);
    }
    void value(ScalarVec3& x, const About& about) override {
        open("array", about);
        expression(node()["items"]);
        vector_size(node());
        unit_of(about);
        Json absent = Json::array();
        for (const Scalar& component : x) std::visit([&](const auto& c) { absent.push_back(c); }, component);
        default_of(absent);
    }
    void value(std::array<bool, 3>& x, const About& about) override {
        open("array", about);
        node()["items"]["type"] = "boolean";
        vector_size(node());
        default_of(x);
    }
    void value(FieldSet& x, const About& about) override {
        open("array", about);
        Json names = Json::array(), defaults = Json::array();
        for (const FieldInfo& info : kFields) {
            names.push_back(info.name);
            if (x.contains(info.field)) defaults.push_back(info.name);
        }
        node()["items"]["enum"] = std::move(names);
        node()["uniqueItems"] = true;
        if (about.min_items > 0) node()["minItems"] = about.min_items;
        if (!x.empty()) default_of(defaults);
    }
    void value(ParameterValue&, const About& about) override {
        describe_node(about);
        parameter_value(node());
        wants_default_ = false;
    }
    void value(Parameters&, const About& about) override {
        open("object", about);
        node()["propertyNames"]["pattern"] = kNamePattern;
        parameter_value(node()["additionalProperties"]);
        if (about.min_items > 0) node()["minProperties"] = about.min_items;
        if (about.max_items != kNoLimit) node()["maxProperties"] = about.max_items;
        wants_default_ = false;
    }
    void value(std::map<std::string, EventValue>&, const About& about) override {
        open("object", about);
        node()["additionalProperties"]["type"] = scalar_types();
        wants_default_ = false;
    }
    void signed_value(std::int64_t& x, const About& about) override {
        integer(about);
        default_of(x);
    }
    void unsigned_value(std::uint64_t& x, About const& about) override {
        About not_negative = about;
        not_negative.range.min = std::max(0.0, about.range.min);
        integer(not_negative);
        default_of(x);
    }
    void enum_value(std::size_t& index, std::span<const std::string_view> names, const About& about) override {
        describe_node(about);
        node()["enum"] = Json::array();
        for (std::string_view name : names) node()["enum"].push_back(name);
        default_of(names[index]);
    }

  private:
    Json& node() { return *nodes_.back(); }

    void describe_node(const About& about) {
        if (!about.meaning.empty()) node()["description"] = about.meaning;
    }
    void open(std::string_view type, const About& about) {
        describe_node(about);
        node()["type"] = type;
    }
    void unit_of(const About& about) {
        if (!about.unit.empty()) node()["x-unit"] = about.unit;
    }
    template <class T>
    void default_of(const T& x) {
        if (wants_default_) node()["default"] = x;
        wants_default_ = false;
    }

    static void limit(Json& schema, const Range& range) {
        if (range.min > -kInfinity) schema[range.above_min ? "exclusiveMinimum" : "minimum"] = bound(range.min);
        if (range.max < kInfinity) schema["maximum"] = bound(range.max);
    }
    static void number(Json& schema, const About& about) {
        if (about.may_be_non_finite) {
            schema["anyOf"] = Json::array({only("type", "number"), only("enum", non_finite_names())});
        } else {
            schema["type"] = "number";
            limit(schema, about.range);
        }
    }
    void integer(const About& about) {
        open("integer", about);
        if (about.range.min == about.range.max)
            node()["const"] = bound(about.range.min);
        else
            limit(node(), about.range);
        unit_of(about);
    }
    static void expression(Json& schema) {
        schema["type"] = Json::array({"number", "string"});
        schema["maxLength"] = kMaxExpressionText;
    }
    static void vector_size(Json& schema) {
        schema["minItems"] = 2;
        schema["maxItems"] = 3;
    }
    static void parameter_value(Json& schema) {
        Json array = Json::object();
        array["type"] = "array";
        array["items"]["type"] = "number";
        vector_size(array);
        schema["anyOf"] = Json::array({only("type", scalar_types()), std::move(array)});
    }

    std::vector<Json*> nodes_;  // a parent gets no further member while a child is open
    bool wants_default_{false};
    bool is_conditional_{false};
    std::size_t choices_{kNoLimit};
    std::map<std::string, Json> definitions_;
};

}  // namespace

Json message_schema(std::string_view title, AnyMessage defaults) {
    Json schema = Json::object();
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    schema["title"] = title;
    SchemaBuilder builder(schema);
    defaults.visit(builder, defaults.message);
    for (const auto& [name, definition] : builder.definitions()) schema["$defs"][name] = definition;
    return schema;
}

}  // namespace headrace::proto
