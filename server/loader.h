// Builds a scene on a worker thread: a million particles must not block a query, and loading can be cancelled.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <thread>

#include "proto/result.h"
#include "server/scene/run.h"

namespace headrace::server {

// Owner: the simulation thread. One load at a time.
class Loader {
  public:
    using Deliver = std::function<void(proto::Result<std::shared_ptr<scene::Run>>)>;

    ~Loader();  // cancels and joins

    // Precondition: !is_loading(). `deliver` is called once, on the worker thread. `threads` is its OpenMP team.
    void start(const proto::SceneDesc& scene, int threads, const std::filesystem::path& data_folder, Deliver deliver);
    void cancel();  // the outcome, error `cancelled`, is still delivered
    void finish();  // joins the worker after its delivery

    bool is_loading() const { return worker_.joinable(); }
    double progress() const { return control_ ? control_->progress.load() : 0.0; }

  private:
    std::shared_ptr<scene::BuildControl> control_;
    std::thread worker_;
};

}  // namespace headrace::server
