// stream.*, frame.get, record.*
#include <string>
#include <utility>

#include "proto/envelope.h"
#include "server/service/commands.h"

namespace headrace::server {

using proto::ErrorCode;

namespace {

template <class Params>
void post_to_publisher(CommandContext& context, Params params, Responder& responder) {
    if (const auto token = context.pending.add(responder))
        context.to_publisher(*token, publish::PublisherRequest(std::move(params)));
}

// Asked for here, given on the data socket.
void refuse_socket(Responder& responder) {
    responder.fail(wrong_socket_error(responder.method()));
}

}  // namespace

void add_stream_commands(CommandTable& table, CommandContext& context) {
    table.add<proto::FrameGet>("frame.get", {{ErrorCode::wrong_state, ErrorCode::busy, ErrorCode::wrong_socket}},
                               [](proto::FrameGet, Responder& responder) { refuse_socket(responder); });
    table.add<proto::StreamOpen>("stream.open",
                                 {{ErrorCode::limit_exceeded, ErrorCode::stream_not_found, ErrorCode::wrong_socket}},
                                 [&context](proto::StreamOpen params, Responder& responder) {
                                     if (params.mode == proto::StreamMode::lossless) return refuse_socket(responder);
                                     post_to_publisher(context, std::move(params), responder);
                                 });
    table.add<proto::StreamAck>("stream.ack", {{ErrorCode::stream_not_found, ErrorCode::wrong_socket}},
                                [](proto::StreamAck, Responder& responder) { refuse_socket(responder); });
    table.add<proto::StreamClose>("stream.close", {{ErrorCode::limit_exceeded, ErrorCode::stream_not_found}},
                                  [&context](proto::StreamClose params, Responder& responder) {
                                      post_to_publisher(context, std::move(params), responder);
                                  });

    table.add<proto::RecordStart>(
        "record.start",
        {{ErrorCode::file_error, ErrorCode::limit_exceeded, ErrorCode::wrong_state, ErrorCode::busy}, true},
        [&context](proto::RecordStart params, Responder& responder) {
            post_to_publisher(context, std::move(params), responder);
        });
    table.add<proto::RecordStop>("record.stop", {{ErrorCode::limit_exceeded, ErrorCode::recording_not_found}},
                                 [&context](proto::RecordStop params, Responder& responder) {
                                     post_to_publisher(context, std::move(params), responder);
                                 });
}

}  // namespace headrace::server
