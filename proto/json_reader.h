// The visitor that fills a message from JSON, strictly; the first offence is kept with its path. Internal to
// messages_json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/json_visitors.h"

namespace headrace::proto {

// What stands in the JSON instead of what was expected, for a message.
std::string found(const Json& json);

class Reader final : public Visitor {
  public:
    Reader(const Json& root, std::string_view path, Strictness strictness)
        : root_path_(path), strictness_(strictness), nodes_{&root} {}

    const std::optional<Error>& error() const { return error_; }

    void tolerate_text(std::string_view name) override;
    void at_most_one(std::initializer_list<Alternative> members) override;
    void exactly_one(std::initializer_list<Alternative> members) override;
    void only_with(const Alternative& member, const Alternative& needed) override;
    void begin_only_when(const Condition& condition, bool holds) override {
        if (!holds) unmet_ = condition;
    }
    void end_only_when() override { unmet_.reset(); }
    void refuse(std::string_view member, std::string message, std::string hint) override;

  protected:
    bool enter(std::string_view name, Presence presence, bool is_empty) override;
    void leave() override { pop(); }
    bool begin_object(const About& about) override;
    void end_object() override;
    std::size_t begin_list(std::size_t size, const About& about) override;
    bool enter_item(std::size_t index) override;
    void leave_item() override { pop(); }
    void end_list() override {}
    bool begin_choice(std::span<const std::string_view> tags, const About& about) override;
    bool enter_choice(std::string_view tag, bool is_current) override;
    void leave_choice() override { pop(); }
    void end_choice() override {}
    void begin_plain_or_object(std::string_view kinds, const About&) override;
    bool enter_plain(bool) override;
    bool enter_object(bool) override;
    void leave_either() override {}

    void value(double& x, const About& about) override;
    void value(std::optional<double>& x, const About& about) override;
    void value(bool& x, const About& about) override;
    void value(std::string& x, const About& about) override;
    void value(Vec3& x, const About& about) override;
    void value(Scalar& x, const About& about) override;
    void value(ScalarVec3& x, const About& about) override;
    void value(std::array<bool, 3>& x, const About& about) override;
    void value(FieldSet& x, const About& about) override;
    void value(ParameterValue& x, const About& about) override;
    void value(Parameters& x, const About& about) override;
    void value(std::map<std::string, EventValue>& x, const About& about) override;
    void signed_value(std::int64_t& x, const About& about) override;
    void unsigned_value(std::uint64_t& x, const About& about) override;
    void enum_value(std::size_t& index, std::span<const std::string_view> names, const About& about) override;

  private:
    struct Segment {
        std::string_view name;
        std::size_t index{};
        bool is_index{false};
    };

    const Json& node() const { return *nodes_.back(); }
    void push(const Json& child, Segment segment) {
        nodes_.push_back(&child);
        segments_.push_back(segment);
    }
    void pop() {
        nodes_.pop_back();
        segments_.pop_back();
    }
    std::string path() const;
    void fail(std::string message, std::string hint = {}) { fail_at(path(), std::move(message), std::move(hint)); }
    void fail_at(std::string path, std::string message, std::string hint);
    void wrong_kind(const std::string& expected);
    bool check_count(std::size_t count, const About& about, std::string_view what);
    bool check_range(double x, const About& about);
    // One value per axis: in a scene of 2 dimensions the third is `none` or left out.
    template <class T>
    void read_per_axis(std::array<T, 3>& x, std::string_view items, const T& none, const About& about);
    const Json* find(std::string_view name) const;
    // An integer, also when it is written as 1e3 or 2.0; larger ones than 2^53 only as digits.
    template <class Integer>
    bool read_integer(Integer& x, const About& about);

    std::string root_path_;
    Strictness strictness_;
    std::vector<const Json*> nodes_;
    std::vector<Segment> segments_;
    std::vector<std::vector<std::string>> known_;  // member names seen so far, per open object
    std::optional<Condition> unmet_;
    std::optional<Error> error_;
    std::size_t missing_depth_{0};  // the error is a missing member of the object this deep; 0: it is something else
};

}  // namespace headrace::proto
