// Whole models in a dam break.
#pragma once

#include <string>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/scene/run.h"
#include "tests/bench/speed_case.h"
#include "tests/bench/stage_seconds.h"

namespace headrace::bench {

// Water, container box, t = 0.2 to 0.4 s, at the model's defaults: a column 0.6 m long and 0.3 m high in a tank of
// 1.61 m by 0.6 m (in 3D 0.15 m wide), as Lobovsky et al. 2014. Windows of the thread counts take turns.
proto::Status time_dam_break(const std::string& model, int dimensions, const SpeedPlan& plan, const SpeedSink& sink);
proto::SceneDesc make_dam_break(const std::string& model, int dimensions);

// Seconds of the run's stages so far; no sort of its own.
StageSeconds stages_of(const scene::Run& run);

}  // namespace headrace::bench
