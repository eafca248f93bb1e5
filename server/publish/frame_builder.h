// Copies chosen particle fields into a capture.
#pragma once

#include <memory>

#include "server/publish/frame_hub.h"
#include "server/solver/particles.h"

namespace headrace::publish {

// Rows ascend by particle id. Precondition: the ids are 0 .. N-1, each once.
std::shared_ptr<const Capture> copy_fields(const solver::Particles& particles, proto::FieldSet fields,
                                           proto::Precision precision, const Moment& now, std::uint64_t generation);

}  // namespace headrace::publish
