#include "server/service/server.h"

#include <omp.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <utility>
#include <zmq.hpp>

#include "proto/version.h"
#include "server/doorbell.h"
#include "server/publish/frame_hub.h"
#include "server/publish/publisher.h"
#include "server/service/command_socket.h"
#include "server/service/commands.h"
#include "server/service/endpoints.h"
#include "server/service/limits.h"
#include "server/simulation.h"

namespace headrace::server {

using proto::ErrorCode;
namespace fs = std::filesystem;

namespace {

constexpr int kIoThreads = 2;                                // one for the control socket, one for the frames
constexpr std::size_t kMessagesPerTurn = 100;                // before outcomes and waiters get their turn
constexpr std::size_t kMessagesAtTheEnd = 10'000;            // that a stopping server still answers
constexpr std::chrono::milliseconds kLingerAtTheEnd{1'000};  // for the last replies to leave

std::uint64_t new_session() {
    std::random_device random;
    return (std::uint64_t{random()} << 32) | random();
}

std::string session_text(std::uint64_t session) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(session));
    return text;
}

Endpoints checked_endpoints(const std::string& bind) {
    proto::Result<Endpoints> endpoints = resolve_endpoints(bind);
    if (!endpoints) throw std::runtime_error(endpoints.error().message + "; " + endpoints.error().hint);
    return *std::move(endpoints);
}

std::optional<IpcLock> checked_lock(const Endpoints& endpoints) {
    if (!endpoints.is_ipc) return std::nullopt;
    proto::Result<IpcLock> lock = IpcLock::take(endpoints);
    if (!lock) throw std::runtime_error(lock.error().message + "; " + lock.error().hint);
    return *std::move(lock);
}

fs::path checked_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (!fs::is_directory(folder, failure))
        throw std::runtime_error("the data folder " + folder.string() + " cannot be made; choose another with --data");
    return fs::canonical(folder);
}

// What a person can do about an endpoint that cannot be bound.
std::string bind_failure(const std::string& endpoint, const std::string& reason) {
    return "cannot listen on " + endpoint + ": " + reason +
           "; end what listens there, or choose another port with --bind tcp://127.0.0.1:PORT (the server takes PORT "
           "and the next three) or --bind 'tcp://127.0.0.1:*'";
}

std::unique_ptr<CommandSocket> make_command_socket(zmq::context_t& context, const std::string& endpoint) {
    try {
        return std::make_unique<CommandSocket>(context, endpoint);
    } catch (const zmq::error_t& error) {
        throw std::runtime_error(bind_failure(endpoint, error.what()));
    }
}

publish::PublisherOptions publisher_options(const Endpoints& endpoints, const fs::path& data_folder,
                                            std::uint64_t session) {
    return {endpoints.events, endpoints.frames,  endpoints.data,   data_folder,
            session,          kSoftMessageLimit, kHardMessageLimit};
}

}  // namespace

struct Server::Impl {
    explicit Impl(const ServerOptions& options)
        : log(options.log),
          endpoints(checked_endpoints(options.bind)),
          lock(checked_lock(endpoints)),
          session_number(new_session()),
          session(session_text(session_number)),
          threads(options.threads > 0 ? options.threads : omp_get_max_threads()),
          data_folder(checked_folder(options.data_folder)),
          zmq(kIoThreads),
          socket(make_command_socket(zmq, endpoints.control)),
          simulation({threads, data_folder}, outbox, events, jobs, board, probes, hub),
          publisher(zmq, publisher_options(endpoints, data_folder, session_number), hub, events, board, probes, outbox),
          context(make_context()),
          table([this] { return board.read()->status.state; }, [this](const CallReport& call) { log_call(call); }) {
        hub.set_waker([this] { simulation.wake(); });
        events.add_listener(events_bell);
        add_commands(table, context);
    }

    CommandContext make_context() {
        return {
            .board = board,
            .events = events,
            .jobs = jobs,
            .probes = probes,
            .hello = make_hello(),
            .to_simulation = [this](Token token, Mutation m) { simulation.post(token, std::move(m)); },
            .to_publisher = [this](Token token, publish::PublisherRequest r) { publisher.post(token, std::move(r)); },
            .record_command = [this](std::string json, double time) { publisher.log_command(std::move(json), time); },
            .publisher_counts = [this] { return publisher.counts(); },
            .shut_down = [this] { stop_wanted = true; },
            .pending = {},
            .waiters = {}};
    }

    proto::HelloReply make_hello() const {
        proto::HelloReply hello;
        hello.version = proto::kProgramVersion;
        hello.protocol = proto::kProtocolVersion;
        hello.session = session;
        if (endpoints.is_ipc) {
            hello.events_endpoint = publisher.events_endpoint();
            hello.frames_endpoint = publisher.frames_endpoint();
            hello.data_endpoint = publisher.data_endpoint();
        } else {
            hello.events_port = port_of(publisher.events_endpoint());
            hello.frames_port = port_of(publisher.frames_endpoint());
            hello.data_port = port_of(publisher.data_endpoint());
        }
        hello.threads = threads;
        hello.soft_message_limit = kSoftMessageLimit;
        hello.hard_message_limit = kHardMessageLimit;
        return hello;
    }

    void log_call(const CallReport& call) const {
        const LogLevel level = call.error == nullptr ? LogLevel::debug : LogLevel::info;
        if (!log.wants(level)) return;
        std::string line = call.method + (call.error == nullptr ? " done" : " refused") + " in " +
                           std::to_string(call.seconds * 1e3) + " ms";
        if (call.error != nullptr)
            line.append(": ").append(call.error->name()).append(": ").append(call.error->message);
        log(level, line);
    }

    void say(const char* type, std::string message) {
        proto::Event event;
        event.type = type;
        event.step = board.read()->status.step;
        event.time = board.read()->status.time;
        event.message = std::move(message);
        events.add(std::move(event));
    }

    // ---- service thread ----
    void serve() {
        while (!stop_wanted) {
            try {
                take_turn();
            } catch (const std::exception& failure) {
                // One request must not end the service of all.
                log(LogLevel::error, std::string("service: ") + failure.what());
                say("server.problem", std::string("service: ") + failure.what());
            }
        }
        wind_up();
        ended_bell.ring();
    }

    void take_turn() {
        const std::array descriptors{outbox.doorbell().fd(), events_bell.fd(), stop_bell.fd()};
        auto deadline = context.waiters.next_deadline();
        if (const auto early = context.pending.next_deadline(); early && (!deadline || *early < *deadline))
            deadline = early;
        socket->wait(descriptors, deadline);
        receive(kMessagesPerTurn,
                [this](std::string_view text, ReplySink sink) { table.handle(text, std::move(sink)); });
        for (const Outcome& outcome : outbox.take()) context.pending.resolve(outcome);
        if (const std::uint64_t last = events.last_seq(); last != seen_events) {
            events_bell.quiet();
            seen_events = last;
            context.waiters.retry();
        }
        context.waiters.expire(std::chrono::steady_clock::now());
        context.pending.expire(std::chrono::steady_clock::now());
    }

    void receive(std::size_t limit, const CommandSocket::OnRequest& on_request) {
        const std::size_t count = socket->receive(limit, on_request, [this](std::size_t parts, const ReplySink& sink) {
            table.refuse("",
                         {ErrorCode::invalid_request,
                          "a request is one message part, this message has " + std::to_string(parts), "", ""},
                         sink);
        });
        if (const std::uint64_t dropped = socket->dropped_replies(); count > 0 && dropped != seen_dropped) {
            log(LogLevel::warn, std::to_string(dropped - seen_dropped) + " replies had no reader");
            seen_dropped = dropped;
        }
    }

    // The end: everyone who waits is answered, and the recordings are whole before the sockets close.
    void wind_up() {
        const proto::Error refusal{ErrorCode::shutting_down, "the server is ending", "", ""};
        say("server.stopping", "the server ends");
        context.waiters.retry();
        context.waiters.refuse_all(refusal);
        simulation.stop();
        for (const Outcome& outcome : outbox.take()) context.pending.resolve(outcome);  // recordings get their commands
        publisher.stop();
        for (const Outcome& outcome : outbox.take()) context.pending.resolve(outcome);
        context.pending.refuse_all(refusal);
        receive(kMessagesAtTheEnd,
                [&](std::string_view text, const ReplySink& sink) { table.refuse(text, refusal, sink); });
        socket->set_linger(kLingerAtTheEnd);
        socket.reset();
    }

    // Declared in the order in which they are made; they go in the opposite one.
    Log log;
    Endpoints endpoints;
    std::optional<IpcLock> lock;
    std::uint64_t session_number;
    std::string session;
    int threads;
    fs::path data_folder;
    zmq::context_t zmq;
    Doorbell events_bell, stop_bell, ended_bell;
    Outbox outbox;
    EventLog events;
    JobBoard jobs;
    StatusBoard board;
    ProbeBoard probes;
    publish::FrameHub hub;
    std::unique_ptr<CommandSocket> socket;
    Simulation simulation;
    publish::Publisher publisher;
    CommandContext context;
    CommandTable table;
    std::string control_endpoint{socket->endpoint()};
    std::uint64_t seen_events{0};
    std::uint64_t seen_dropped{0};
    std::atomic<bool> stop_wanted{false};
    std::thread thread;
};

Server::Server(const ServerOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Server::~Server() {
    stop();
}

void Server::start() {
    impl_->simulation.start();
    impl_->publisher.start();
    impl_->say("server.started",
               "headraced " + std::string(proto::kProgramVersion) + " listens on " + impl_->control_endpoint);
    impl_->thread = std::thread([this] { impl_->serve(); });
}

void Server::stop() {
    impl_->stop_wanted = true;
    impl_->stop_bell.ring();
    if (impl_->thread.joinable()) impl_->thread.join();
}

int Server::ended_fd() const {
    return impl_->ended_bell.fd();
}
const std::string& Server::control_endpoint() const {
    return impl_->control_endpoint;
}
const std::string& Server::events_endpoint() const {
    return impl_->publisher.events_endpoint();
}
const std::string& Server::frames_endpoint() const {
    return impl_->publisher.frames_endpoint();
}
const std::string& Server::data_endpoint() const {
    return impl_->publisher.data_endpoint();
}
const std::string& Server::session() const {
    return impl_->session;
}

}  // namespace headrace::server
