// The templates of messages_json.h, for every message, and the functions from text to text.
#include "proto/messages_json.h"

#include <nlohmann/json.hpp>

#include "proto/json_describe.h"
#include "proto/json_visitors.h"

namespace headrace::proto {

namespace {

template <class Message>
void visit_as(Visitor& visitor, void* message) {
    visitor.visit(*static_cast<Message*>(message), {});
}

}  // namespace

template <class Message>
constexpr Strictness kStrictness = Strictness::strict;

// Title of the schema.
template <class Message>
constexpr std::string_view kTitle = "";

template <class Message>
Result<Message> from_json(const Json& json, std::string_view path) {
    Message message;
    if (auto error = read_message(json, path, kStrictness<Message>, {&message, &visit_as<Message>})) return *error;
    return message;
}

template <class Message>
Json to_json(const Message& message) {
    Message copy = message;  // the visitors take what they may also fill
    return write_message({&copy, &visit_as<Message>});
}

template <class Message>
Json json_schema() {
    Message defaults;
    return message_schema(kTitle<Message>, {&defaults, &visit_as<Message>});
}

// A specialisation must precede the instantiation: both in one place for each message.
#define HEADRACE_MESSAGE(T, STRICTNESS)                                       \
    template <>                                                               \
    constexpr Strictness kStrictness<T> = Strictness::STRICTNESS;             \
    template <>                                                               \
    constexpr std::string_view kTitle<T> = #T;                                \
    template Result<T> from_json<T>(const Json& json, std::string_view path); \
    template Json to_json<T>(const T& message);                               \
    template Json json_schema<T>();
#define HEADRACE_REQUEST(T) HEADRACE_MESSAGE(T, strict)
#define HEADRACE_REPLY(T) HEADRACE_MESSAGE(T, tolerant)

HEADRACE_REQUEST(SceneDesc)
HEADRACE_REQUEST(ObjectDesc)
HEADRACE_REQUEST(ProbeDesc)
HEADRACE_REQUEST(Hello)
HEADRACE_REQUEST(Describe)
HEADRACE_REQUEST(SceneLoad)
HEADRACE_REQUEST(SceneGet)
HEADRACE_REQUEST(SceneList)
HEADRACE_REQUEST(SimStep)
HEADRACE_REQUEST(RunUntil)
HEADRACE_REQUEST(SimRun)
HEADRACE_REQUEST(JobWait)
HEADRACE_REQUEST(SimPause)
HEADRACE_REQUEST(SimResume)
HEADRACE_REQUEST(SimCancel)
HEADRACE_REQUEST(SimReset)
HEADRACE_REQUEST(SimStatus)
HEADRACE_REQUEST(SimInspect)
HEADRACE_REQUEST(ParamsGet)
HEADRACE_REQUEST(ParamsSet)
HEADRACE_REQUEST(ObjectsList)
HEADRACE_REQUEST(ObjectsAdd)
HEADRACE_REQUEST(ObjectsMove)
HEADRACE_REQUEST(ObjectsRemove)
HEADRACE_REQUEST(ProbesList)
HEADRACE_REQUEST(ProbesGet)
HEADRACE_REQUEST(ProbesAdd)
HEADRACE_REQUEST(ProbesRemove)
HEADRACE_REQUEST(FrameGet)
HEADRACE_REQUEST(StreamOpen)
HEADRACE_REQUEST(StreamAck)
HEADRACE_REQUEST(StreamClose)
HEADRACE_REQUEST(RecordStart)
HEADRACE_REQUEST(RecordStop)
HEADRACE_REQUEST(EventsSince)
HEADRACE_REQUEST(ServerShutdown)

HEADRACE_REPLY(HelloReply)
HEADRACE_REPLY(SceneLoadReply)
HEADRACE_REPLY(SceneSummary)
HEADRACE_REPLY(SceneListReply)
HEADRACE_REPLY(JobReply)
HEADRACE_REPLY(Applied)
HEADRACE_REPLY(StateHash)
HEADRACE_REPLY(PlanStage)
HEADRACE_REPLY(FaultReport)
HEADRACE_REPLY(Diagnostics)
HEADRACE_REPLY(SimStatusReply)
HEADRACE_REPLY(SimInspectReply)
HEADRACE_REPLY(ParameterEntry)
HEADRACE_REPLY(ParamsGetReply)
HEADRACE_REPLY(ParamsSetReply)
HEADRACE_REPLY(ObjectsListReply)
HEADRACE_REPLY(ProbesListReply)
HEADRACE_REPLY(ProbesGetReply)
HEADRACE_REPLY(ProbeSamples)
HEADRACE_REPLY(FrameGetReply)
HEADRACE_REPLY(StreamOpenReply)
HEADRACE_REPLY(StreamAckReply)
HEADRACE_REPLY(StreamCloseReply)
HEADRACE_REPLY(RecordStartReply)
HEADRACE_REPLY(RecordStopReply)
HEADRACE_REPLY(Event)
HEADRACE_REPLY(EventsSinceReply)

#undef HEADRACE_REQUEST
#undef HEADRACE_REPLY
#undef HEADRACE_MESSAGE

namespace {

template <class Message>
Result<Message> parse_message(std::string_view text) {
    Result<Json> json = parse_json(text);
    if (!json) return json.error();
    return from_json<Message>(*json, {});
}

}  // namespace

Result<SceneDesc> parse_scene(std::string_view text) {
    return parse_message<SceneDesc>(text);
}
std::string scene_text(const SceneDesc& scene) {
    return json_text(to_json(scene), 2);
}

std::string event_text(const Event& event) {
    return json_text(to_json(event));
}
Result<Event> parse_event(std::string_view text) {
    return parse_message<Event>(text);
}

std::string probe_samples_text(const ProbeSamples& samples) {
    return json_text(to_json(samples));
}
Result<ProbeSamples> parse_probe_samples(std::string_view text) {
    return parse_message<ProbeSamples>(text);
}

std::string objects_text(const std::vector<ObjectDesc>& objects) {
    Json list = Json::array();
    for (const ObjectDesc& object : objects) list.push_back(to_json(object));
    return json_text(list);
}

Result<std::vector<ObjectDesc>> parse_objects(std::string_view text) {
    Result<Json> json = parse_json(text);
    if (!json) return json.error();
    std::vector<ObjectDesc> objects;
    if (auto error = read_message(*json, {}, Strictness::tolerant, {&objects, &visit_as<std::vector<ObjectDesc>>}))
        return *error;
    return objects;
}

Json error_json(const Error& error) {
    const ErrorInfo& info = error_info(error.code);
    Json json = Json::object();
    json["code"] = info.rpc_code;
    json["message"] = error.message;
    Json& data = json["data"];
    data["name"] = info.name;
    if (!error.path.empty()) data["path"] = error.path;
    if (!error.hint.empty()) data["hint"] = error.hint;
    data["retryable"] = info.retryable;
    return json;
}

namespace {

std::string text_member(const Json& json, const char* name) {
    const auto member = json.find(name);
    return member != json.end() && member->is_string() ? member->get<std::string>() : std::string();
}

}  // namespace

// By its stable name, else by its number; what a newer server may send besides is an internal_error here.
Error error_from_json(const Json& json) {
    Error error;
    if (!json.is_object()) return error;
    error.message = text_member(json, "message");
    std::string name;
    if (const auto data = json.find("data"); data != json.end() && data->is_object()) {
        name = text_member(*data, "name");
        error.path = text_member(*data, "path");
        error.hint = text_member(*data, "hint");
    }
    const auto number = json.find("code");
    for (const ErrorInfo& info : kErrors)
        if (number != json.end() && *number == info.rpc_code) error.code = info.code;
    for (const ErrorInfo& info : kErrors)
        if (info.name == name) error.code = info.code;
    return error;
}

}  // namespace headrace::proto
