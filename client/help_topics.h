// What `headrace help TOPIC` prints: the files of client/topics.
#pragma once

#include <span>
#include <string_view>

namespace headrace::client {

struct HelpTopic {
    std::string_view name;
    std::string_view title;  // the first line of the text
    std::string_view text;
};

std::span<const HelpTopic> help_topics();

}  // namespace headrace::client
