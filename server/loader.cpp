#include "server/loader.h"

#include <omp.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace headrace::server {

namespace {

proto::Result<std::shared_ptr<scene::Run>> build(const proto::SceneDesc& scene,
                                                 const std::filesystem::path& data_folder,
                                                 scene::BuildControl& control) {
    try {
        auto run = scene::Run::build(scene, &control, data_folder);
        if (!run) return run.error();
        return std::shared_ptr<scene::Run>(std::move(*run));
    } catch (const std::bad_alloc&) {
        return proto::Error{proto::ErrorCode::limit_exceeded, "the server's memory is too small for this scene",
                            "scene.spacing", "enlarge scene.spacing"};
    } catch (const std::length_error& problem) {
        return proto::Error{proto::ErrorCode::limit_exceeded, problem.what(), "scene.objects",
                            "shrink scene.domain, to which walls at rest are cut, and objects that move, or enlarge "
                            "scene.spacing"};
    } catch (const std::exception& problem) {
        return proto::Error{proto::ErrorCode::internal_error, problem.what(), "scene", "report this as a bug"};
    }
}

}  // namespace

Loader::~Loader() {
    cancel();
    finish();
}

void Loader::start(const proto::SceneDesc& scene, int threads, const std::filesystem::path& data_folder,
                   Deliver deliver) {
    control_ = std::make_shared<scene::BuildControl>();
    worker_ = std::thread([scene, threads, data_folder, deliver = std::move(deliver), control = control_] {
        omp_set_num_threads(threads);
        deliver(build(scene, data_folder, *control));
    });
}

void Loader::cancel() {
    if (control_) control_->cancelled = true;
}

void Loader::finish() {
    if (worker_.joinable()) worker_.join();
    control_.reset();
}

}  // namespace headrace::server
