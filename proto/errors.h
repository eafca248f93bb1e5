// The closed list of errors that a peer can receive: a JSON-RPC code, a stable name, and the client's exit code.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace headrace::proto {

enum class ErrorCode {
    parse_error,
    invalid_request,
    method_not_found,
    invalid_params,
    internal_error,
    json_too_deep,
    duplicate_key,
    message_too_large,
    wrong_state,
    wrong_socket,
    busy,
    scene_not_found,
    scene_invalid,
    object_not_found,
    object_exists,
    parameter_not_found,
    job_not_found,
    stream_not_found,
    recording_not_found,
    particle_not_found,
    probe_not_found,
    probe_exists,
    limit_exceeded,
    file_error,
    cancelled,
    timed_out,
    faulted,
    shutting_down,
    connection_failed,  // client side only: no server answers
    protocol_mismatch,  // client side only: the server speaks another protocol number
    usage,              // client side only: the command line is off
};

struct ErrorInfo {
    ErrorCode code;
    int rpc_code;           // JSON-RPC 2.0 `error.code`
    std::string_view name;  // `error.data.name`, stable
    int exit_code;          // exit status of the `headrace` client
    bool retryable;         // the same request may succeed later unchanged
    std::string_view meaning;
};

// -32700 .. -32600 are JSON-RPC 2.0's own (section 5.1); -32001 .. -32099 are its range for servers.
// Exit codes: 2 usage or bad request, 3 connection, 4 not found, 5 wrong state, 6 files, 7 faulted, 8 timed out, 1
// rest.
inline constexpr std::array<ErrorInfo, 31> kErrors{{
    {ErrorCode::parse_error, -32700, "parse_error", 2, false, "not JSON, or a frame or file that cannot be parsed"},
    {ErrorCode::invalid_request, -32600, "invalid_request", 2, false, "JSON, but not a JSON-RPC 2.0 request object"},
    {ErrorCode::method_not_found, -32601, "method_not_found", 2, false, "there is no such method"},
    {ErrorCode::invalid_params, -32602, "invalid_params", 2, false, "wrong type, missing, unknown or out of range"},
    {ErrorCode::internal_error, -32603, "internal_error", 1, false, "a mistake of the program itself"},
    {ErrorCode::json_too_deep, -32001, "json_too_deep", 2, false, "nested deeper than 32"},
    {ErrorCode::duplicate_key, -32002, "duplicate_key", 2, false, "an object names a member twice"},
    {ErrorCode::message_too_large, -32003, "message_too_large", 2, false, "more than 16 MiB of JSON"},
    {ErrorCode::wrong_state, -32010, "wrong_state", 5, false,
     "not allowed in the present state; the hint tells what leads out of it"},
    {ErrorCode::wrong_socket, -32011, "wrong_socket", 2, false, "the method belongs to the other of control and data"},
    {ErrorCode::busy, -32012, "busy", 5, true, "a scene is loading; retry later"},
    {ErrorCode::scene_not_found, -32020, "scene_not_found", 4, false, "no scene of this name comes with the server"},
    {ErrorCode::scene_invalid, -32021, "scene_invalid", 2, false, "the document is well-formed and makes no sense"},
    {ErrorCode::object_not_found, -32022, "object_not_found", 4, false, "no object of this name"},
    {ErrorCode::object_exists, -32023, "object_exists", 5, false, "an object of this name is there already"},
    {ErrorCode::parameter_not_found, -32024, "parameter_not_found", 4, false, "the model has no such parameter"},
    {ErrorCode::job_not_found, -32025, "job_not_found", 4, false, "no such job, or it is forgotten"},
    {ErrorCode::stream_not_found, -32026, "stream_not_found", 4, false,
     "no such stream; it was closed, has failed, or belongs to an earlier session"},
    {ErrorCode::recording_not_found, -32027, "recording_not_found", 4, false, "no such recording"},
    {ErrorCode::particle_not_found, -32028, "particle_not_found", 4, false, "no particle of this id"},
    {ErrorCode::probe_not_found, -32029, "probe_not_found", 4, false, "no such probe, or it has no such value"},
    {ErrorCode::probe_exists, -32036, "probe_exists", 5, false, "a probe of this name is there already"},
    {ErrorCode::limit_exceeded, -32030, "limit_exceeded", 5, false,
     "more than the server holds; the message names the limit"},
    {ErrorCode::file_error, -32031, "file_error", 6, false, "a file or folder cannot be read or written"},
    {ErrorCode::cancelled, -32032, "cancelled", 5, true, "ended by sim.cancel, or interrupted"},
    {ErrorCode::timed_out, -32033, "timed_out", 8, true, "not done in the time given"},
    {ErrorCode::faulted, -32034, "faulted", 7, false, "the run stopped by one of the criteria of sim.faulted"},
    {ErrorCode::shutting_down, -32035, "shutting_down", 3, false, "the server is ending"},
    {ErrorCode::connection_failed, -32090, "connection_failed", 3, true, "client only: no server answers"},
    {ErrorCode::protocol_mismatch, -32091, "protocol_mismatch", 3, false,
     "client only: the server speaks another protocol number"},
    {ErrorCode::usage, -32092, "usage", 2, false, "client only: the command line is off"},
}};

constexpr const ErrorInfo& error_info(ErrorCode code) {
    return kErrors[static_cast<std::size_t>(code)];
}

static_assert([] {
    for (std::size_t k = 0; k < kErrors.size(); ++k)
        if (kErrors[k].code != static_cast<ErrorCode>(k)) return false;
    return true;
}());

// An expected failure, as data.
struct Error {
    ErrorCode code{ErrorCode::internal_error};
    std::string message;  // for a person, one sentence
    std::string path;     // where: JSON path such as `params.name`, or a file name; may be empty
    std::string hint;     // the remedy; may be empty

    std::string_view name() const { return error_info(code).name; }
};

}  // namespace headrace::proto
