// The probes of a case's scene, read whenever the case wants.
#pragma once

#include <memory>
#include <string>

#include "server/probes/probe.h"
#include "server/scene/run.h"

namespace headrace::validation {

class Gauge {
  public:
    // Precondition: the scene has a probe of this name.
    Gauge(const scene::Run& run, const std::string& name);

    double read(const scene::Run& run) const;  // first column; 0 where there is no fluid to measure

  private:
    std::shared_ptr<probes::Probe> probe_;
};

}  // namespace headrace::validation
