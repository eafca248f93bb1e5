// sim.inspect: one particle explained by the model.
#pragma once

#include <cstdint>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/scene/run.h"

namespace headrace::server {

// Errors: particle_not_found; invalid_params when the model cannot tell.
proto::Result<proto::SimInspectReply> inspect_particle(const scene::Run& run, std::uint32_t id);

}  // namespace headrace::server
