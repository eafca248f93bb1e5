#include "proto/man_page.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "proto/version.h"

namespace headrace::proto {

namespace {

// man(7) reads a backslash anywhere, and a dot or a quote at a line's start; a minus that is to be copied is \-.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const bool is_start = result.empty() || result.back() == '\n';
        if (is_start && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else if (c == '^')
            result += "\\(ha";
        else if (c == '~')
            result += "\\(ti";
        else if (c == '`')
            result += "\\(ga";
        else
            result += c;
    }
    return result;
}

std::string with_capital(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool positional) {
    return app.get_options([positional](const CLI::Option* option) {
        return option->get_positional() == positional && !option->get_group().empty();
    });
}

std::string synopsis(const CLI::App& app, const std::string& command) {
    std::string text = "\\fB" + escaped(command) + "\\fR";
    if (!options_of(app, false).empty()) text += " [\\fIoptions\\fR]";
    for (const CLI::Option* option : options_of(app, true)) {
        const std::string word =
            "\\fI" + escaped(option->get_name(true)) + "\\fR" + (option->get_items_expected_max() > 1 ? "..." : "");
        text += option->get_required() ? " " + word : " [" + word + "]";
    }
    if (!app.get_subcommands({}).empty()) text += " \\fIcommand\\fR ...";
    return text;
}

std::string option_entry(const CLI::App& app, const CLI::Option& option) {
    const auto formatter = std::dynamic_pointer_cast<CLI::Formatter>(app.get_formatter());
    const bool positional = option.get_positional();
    return ".TP\n\\fB" + escaped(formatter->make_option_name(&option, positional)) + "\\fR" +
           escaped(formatter->make_option_opts(&option)) + "\n" + escaped(with_capital(option.get_description())) +
           ".\n";
}

std::string section(const std::string& title, const std::string& body) {
    return body.empty() ? "" : ".SH " + title + "\n" + body;
}

std::string option_entries(const CLI::App& app, bool positional) {
    std::string text;
    for (const CLI::Option* option : options_of(app, positional)) text += option_entry(app, *option);
    return text;
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& name, const std::string& command) {
    std::string upper = name;
    std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
    std::string commands;
    for (const CLI::App* each : app.get_subcommands([](const CLI::App* a) { return !a->get_group().empty(); }))
        commands += ".TP\n\\fB" + escaped(each->get_name()) + "\\fR\n" +
                    escaped(with_capital(each->get_description())) + ": \\fB" + escaped(name + "-" + each->get_name()) +
                    "\\fR(1).\n";
    std::string summary = app.get_description();
    if (summary.ends_with('.')) summary.pop_back();
    std::string footer = app.get_footer();
    if (!footer.empty()) footer = ".nf\n" + escaped(footer) + "\n.fi\n";
    std::string see;
    if (const CLI::App* parent = app.get_parent())
        see = "\\fB" + escaped(parent->get_name()) + "\\fR(1), whose options are understood here too.\n";
    else
        see = "\\fBheadrace\\fR(1), \\fBheadraced\\fR(1)\n";
    return ".TH " + escaped(upper) + " 1 \"\" \"headrace " + kProgramVersion + "\" \"headrace\"\n" +
           section("NAME", escaped(name) + " \\- " + escaped(summary) + "\n") +
           section("SYNOPSIS", synopsis(app, command) + "\n") +
           section("DESCRIPTION", escaped(with_capital(summary)) + ".\n") +
           section("ARGUMENTS", option_entries(app, true)) + section("OPTIONS", option_entries(app, false)) +
           section("COMMANDS", commands) + section("NOTES", footer) + section("SEE ALSO", see);
}

}  // namespace headrace::proto
