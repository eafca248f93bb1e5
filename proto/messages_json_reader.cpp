// Reading objects, lists and choices, and the rules between members.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "proto/json_path.h"
#include "proto/json_reader.h"
#include "proto/suggest.h"

namespace headrace::proto {

std::string Reader::path() const {
    std::string text = root_path_;
    for (const Segment& segment : segments_) {
        if (segment.is_index)
            append_index(text, segment.index);
        else
            append_member(text, segment.name);
    }
    return text;
}

void Reader::fail_at(std::string path, std::string message, std::string hint) {
    if (error_) return;
    error_ = Error{ErrorCode::invalid_params, std::move(message), std::move(path), std::move(hint)};
}

void Reader::wrong_kind(const std::string& expected) {
    fail("must be " + expected + ", got " + found(node()),
         node().is_null() ? "leave the member out instead of giving null" : "");
}

void Reader::refuse(std::string_view member, std::string message, std::string hint) {
    std::string where = path();
    if (!member.empty()) where.append(where.empty() ? "" : ".").append(member);
    fail_at(std::move(where), std::move(message), std::move(hint));
}

const Json* Reader::find(std::string_view name) const {
    const auto member = node().find(name);
    return member == node().end() ? nullptr : &*member;
}

// ---- objects ----

bool Reader::enter(std::string_view name, Presence presence, bool) {
    known_.back().emplace_back(name);
    if (error_) return false;
    const Json* member = find(name);
    if (!member) {
        if (presence == Presence::required) {
            refuse(name, "is missing", {});
            missing_depth_ = known_.size();
        }
        return false;
    }
    if (unmet_) {
        refuse(name, "is for " + std::string(unmet_->member) + " \"" + std::string(unmet_->value) + "\" only",
               "leave it out, or set " + std::string(unmet_->member) + " to \"" + std::string(unmet_->value) + "\"");
        return false;
    }
    push(*member, {name});
    return true;
}

bool Reader::begin_object(const About&) {
    if (error_) return false;
    if (!node().is_object()) return wrong_kind("an object"), false;
    known_.emplace_back();
    return true;
}

// A misspelt name explains a missing member better than its absence does.
void Reader::end_object() {
    const bool is_missing = error_ && missing_depth_ == known_.size();
    if (strictness_ == Strictness::strict && (!error_ || is_missing)) {
        const std::vector<std::string>& known = known_.back();
        for (const auto& [name, x] : node().items()) {
            if (std::find(known.begin(), known.end(), name) != known.end()) continue;
            std::string where = path();
            append_member(where, name);
            error_ = Error{ErrorCode::invalid_params, "unknown member " + in_quotes(name), where, suggest(name, known)};
            break;
        }
    }
    if (is_missing) missing_depth_ = 0;
    known_.pop_back();
}

void Reader::tolerate_text(std::string_view name) {
    known_.back().emplace_back(name);
    const Json* member = error_ ? nullptr : find(name);
    if (member && !member->is_string()) refuse(name, "must be a string, got " + found(*member), {});
}

void Reader::at_most_one(std::initializer_list<Alternative> members) {
    std::string all, first;
    for (const Alternative& member : members) all.append(all.empty() ? "" : ", ").append(member.name);
    for (const Alternative& member : members) {
        if (!member.is_present) continue;
        if (!first.empty()) return refuse(member.name, "cannot be given together with " + first, "give one of " + all);
        first = member.name;
    }
}

void Reader::exactly_one(std::initializer_list<Alternative> members) {
    at_most_one(members);
    std::string all;
    for (const Alternative& member : members) {
        if (member.is_present) return;
        all.append(all.empty() ? "" : ", ").append(member.name);
    }
    if (error_) return;
    refuse({}, "needs one of " + all, {});
    missing_depth_ = known_.size();
}

void Reader::only_with(const Alternative& member, const Alternative& needed) {
    if (member.is_present && !needed.is_present)
        refuse(member.name, "needs " + std::string(needed.name) + " beside it", {});
}

// ---- lists and choices ----

bool Reader::check_count(std::size_t count, const About& about, std::string_view what) {
    if (count >= about.min_items && count <= about.max_items) return true;
    if (count < about.min_items)
        fail("must have at least " + std::to_string(about.min_items) + " " + std::string(what));
    else
        fail("must have at most " + std::to_string(about.max_items) + " " + std::string(what) + ", got " +
             std::to_string(count));
    return false;
}

std::size_t Reader::begin_list(std::size_t, const About& about) {
    if (error_) return 0;
    if (!node().is_array()) return wrong_kind("an array"), 0;
    return check_count(node().size(), about, "items") ? node().size() : 0;
}

bool Reader::enter_item(std::size_t index) {
    if (error_) return false;
    push(node()[index], {{}, index, true});
    return true;
}

bool Reader::begin_choice(std::span<const std::string_view> tags, const About&) {
    if (error_) return false;
    std::string all;
    for (std::string_view tag : tags) all.append(all.empty() ? "" : ", ").append(tag);
    if (!node().is_object() || node().size() != 1) {
        fail("must be an object with one member out of " + all + ", got " +
             (node().is_object() ? std::to_string(node().size()) + " members" : found(node())));
        return false;
    }
    const std::string& name = node().begin().key();
    if (std::find(tags.begin(), tags.end(), name) != tags.end()) return true;
    std::string where = path();
    append_member(where, name);
    fail_at(where, "unknown member " + in_quotes(name), suggest(name, {tags.begin(), tags.end()}));
    return false;
}

bool Reader::enter_choice(std::string_view tag, bool) {
    if (error_ || node().begin().key() != tag) return false;
    push(node().front(), {tag});
    return true;
}

void Reader::begin_plain_or_object(std::string_view kinds, const About&) {
    if (!error_ && !node().is_string() && !node().is_object() && kinds.starts_with("a name"))
        wrong_kind(std::string(kinds));
}

bool Reader::enter_plain(bool) {
    return !error_ && !node().is_object();
}

bool Reader::enter_object(bool) {
    return !error_ && node().is_object();
}

std::optional<Error> read_message(const Json& json, std::string_view path, Strictness strictness, AnyMessage into) {
    Reader reader(json, path, strictness);
    into.visit(reader, into.message);
    return reader.error();
}

}  // namespace headrace::proto
