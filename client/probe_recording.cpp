#include "client/probe_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "client/call.h"

namespace headrace::client {

namespace {

// Rows of all probes as instants, in the order of time.
std::map<double, proto::ProbeSamples> instants_of(const proto::ProbesGetReply& reply) {
    std::map<double, proto::ProbeSamples> instants;
    for (const proto::ProbeSeries& series : reply.probes)
        for (const proto::ProbeRow& row : series.rows) {
            if (row.size() != series.columns.size() || row.empty() || !row[0]) continue;  // no row of ours
            proto::ProbeSamples& instant = instants[*row[0]];
            instant.time = *row[0];
            instant.samples.push_back(
                {series.name, {series.columns.begin() + 1, series.columns.end()}, {row.begin() + 1, row.end()}});
        }
    return instants;
}

}  // namespace

ProbeRecording::ProbeRecording(Connection& connection, proto::RecordingWriter& writer, double from)
    : connection_(connection),
      writer_(writer),
      since_(std::nextafter(from, -std::numeric_limits<double>::infinity())) {}

proto::Status ProbeRecording::take(double end) {
    const double slack = 1e-9 * std::max(1.0, std::abs(end));  // times are sums of rounded time steps
    while (has_probes_) {
        proto::ProbesGet query;
        query.since = since_;
        auto reply = call<proto::ProbesGetReply>(connection_, "probes.get", query);
        if (!reply) {
            has_probes_ = reply.error().code != proto::ErrorCode::method_not_found;
            if (has_probes_) return reply.error();
            break;
        }
        for (const auto& [time, instant] : instants_of(*reply))
            if (time <= end + slack)
                if (auto written = writer_.write_probes(instant); !written) return written;
        if (!reply->complete_to || *reply->complete_to <= since_) break;
        since_ = *reply->complete_to;
    }
    return proto::Done{};
}

}  // namespace headrace::client
