// Recordings written by the server: lossless consumers inside the process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "proto/recording.h"
#include "proto/result.h"
#include "server/event_log.h"
#include "server/probe_board.h"
#include "server/publish/frame_hub.h"
#include "server/status.h"

namespace headrace::publish {

// Owner: the publisher thread.
class Recorder {
  public:
    static constexpr std::size_t kMost = 16;

    // Where it gets what it writes; all outlive it.
    struct Sources {
        FrameHub& hub;
        server::EventLog& events;
        const server::StatusBoard& board;
        server::ProbeBoard& probes;
    };
    Recorder(const Sources& sources, std::uint64_t session, std::filesystem::path data_folder)
        : hub_(sources.hub),
          events_(sources.events),
          board_(sources.board),
          probes_(sources.probes),
          session_(session),
          data_folder_(std::move(data_folder)) {}

    proto::Result<proto::RecordStartReply> start(const proto::RecordStart& request);
    proto::Result<proto::RecordStopReply> stop(const std::optional<std::string>& recording);
    void stop_all(const std::string& why);
    std::size_t size() const { return recordings_.size(); }

    bool deliver(const CaptureFor& capture);             // false: not for one of ours
    bool fail(DemandId demand, const std::string& why);  // false: not one of ours
    void take_probes();                                  // writes the samples that wait
    void write_event(const proto::Event& event);
    void write_command(const std::string& json, double time);

  private:
    struct Recording {
        std::string file;  // as asked for
        proto::FieldSet fields;
        DemandId demand{};
        std::unique_ptr<proto::RecordingWriter> writer;
        std::uint64_t seq{0};
        std::uint64_t generation{0};
        std::uint64_t first_event{0};    // events after this number belong to the recording
        std::uint64_t first_instant{0};  // likewise samples of probes
    };
    using Place = std::map<std::string, Recording>::iterator;
    proto::Result<std::filesystem::path> resolve(const std::string& file) const;
    proto::RecordStopReply finish(Place place, const std::string& why);
    void fail(Place place, const proto::Error& error);
    void forget(Place place);
    Place find(DemandId demand);
    void report(const std::string& type, const std::string& recording, const std::string& message) const;

    FrameHub& hub_;
    server::EventLog& events_;
    const server::StatusBoard& board_;
    server::ProbeBoard& probes_;
    std::uint64_t session_;
    std::filesystem::path data_folder_;
    std::map<std::string, Recording> recordings_;  // by id
    std::uint64_t started_{0};
};

}  // namespace headrace::publish
