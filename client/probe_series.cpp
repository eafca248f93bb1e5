#include "client/probe_series.h"

#include "client/call.h"

namespace headrace::client {

proto::Result<proto::ProbeSeries> fetch_series(Connection& connection, const std::string& name) {
    proto::ProbeSeries whole;
    proto::ProbesGet query;
    query.name = name;
    for (;;) {
        auto reply = call<proto::ProbesGetReply>(connection, "probes.get", query);
        if (!reply) return reply.error();
        if (reply->probes.empty()) return whole;
        proto::ProbeSeries& part = reply->probes.front();
        if (!query.since) whole = {part.name, part.columns, {}, part.dropped};
        whole.rows.insert(whole.rows.end(), part.rows.begin(), part.rows.end());
        if (part.rows.empty() || !reply->complete_to) return whole;
        query.since = reply->complete_to;
    }
}

}  // namespace headrace::client
