// Events of the publisher's thread, stamped with where the run is.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "server/event_log.h"
#include "server/status.h"

namespace headrace::publish {

inline void report(server::EventLog& events, const server::StatusBoard& board, std::string type, std::string message,
                   std::map<std::string, proto::EventValue> data) {
    const auto now = board.read();
    proto::Event event;
    event.type = std::move(type);
    event.step = now->status.step;
    event.time = now->status.time;
    event.message = std::move(message);
    event.data = std::move(data);
    events.add(std::move(event));
}

}  // namespace headrace::publish
