// What `headrace watch` shows: a run's status over the last minute or so, as lines of text. No terminal, no server.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "client/sparkline.h"
#include "proto/messages.h"

namespace headrace::client {

class Dashboard {
  public:
    struct Style {
        Glyphs glyphs{Glyphs::ascii};
        bool colors{false};
    };
    // The model's `rest_density` [kg/m^3], and the `balance` of a probe of energies [J], where there are such.
    struct Extras {
        std::optional<double> rest_density, energy_balance;
    };

    Dashboard(std::string endpoint, Style style) : endpoint_(std::move(endpoint)), style_(style) {}

    void add(const proto::SimStatusReply& status, const Extras& extras);
    // Those that a person should know of are shown as warnings, the newest last.
    void add(const proto::Event& event);
    void say(std::string note) { note_ = std::move(note); }  // the outcome of a key
    void ask(std::vector<std::string> choices) {
        choices_ = std::move(choices);
    }  // an object to remove; none: no question
    const std::vector<std::string>& choices() const { return choices_; }

    // At most so many rows, the least important left out; `with_keys`: the keys are told at the end.
    std::vector<std::string> lines(int rows, int columns, bool with_keys) const;

  private:
    struct Curve {
        std::deque<double> values;
        void add(double value);
    };
    std::string colored(const std::string& text, const char* code) const;
    std::string row(const std::string& name, const std::string& value, const Curve* curve, int columns) const;
    std::vector<std::string> run_lines(int columns, bool with_keys) const;
    bool may_follow_energies() const;
    std::vector<std::string> reader_lines() const;
    std::vector<std::string> warning_lines() const;

    std::string endpoint_;
    Style style_;
    std::optional<proto::SimStatusReply> status_;
    Extras extras_;
    Curve speed_, kinetic_, energy_, balance_, mean_error_, max_error_;
    std::deque<std::string> warnings_;
    std::string note_;
    std::vector<std::string> choices_;
};

}  // namespace headrace::client
