#include "app/view/model_cache.h"

#include "preprocess/pipeline/build_model.h"
#include "preprocess/read/open_mesh_sources.h"

#include <chrono>
#include <filesystem>

namespace gnomon::app::view {

/// Passes progress on to the status, and the wish to stop back.
class CacheBuild::Watch final : public Progress {
public:
    explicit Watch(CacheBuild& build) : build_(&build), start_(std::chrono::steady_clock::now()) {}

    void stage(std::string_view name, std::string_view unit, std::uint64_t total) override {
        const std::scoped_lock lock(build_->mutex_);
        build_->status_ = {std::string(name), std::string(unit), 0, total, seconds()};
    }

    void advance(std::uint64_t count) override {
        if (build_->isStopped_) throw Interrupted{};
        const std::scoped_lock lock(build_->mutex_);
        build_->status_.done += count;
        build_->status_.seconds = seconds();
    }

private:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

    CacheBuild* build_;
    std::chrono::steady_clock::time_point start_;
};

bool isModelPath(const std::string& path) {
    return std::filesystem::path(path).extension() == ".gnm";
}

std::string cachePath(const std::string& meshPath) {
    return meshPath + ".gnm";
}

bool isCacheFresh(const std::string& meshPath) {
    std::error_code error;
    const auto built = std::filesystem::last_write_time(cachePath(meshPath), error);
    if (error) return false;
    const auto made = std::filesystem::last_write_time(meshPath, error);
    return !error && built >= made;
}

CacheBuild::CacheBuild(std::string meshPath, Bytes memory, int threads)
    : meshPath_(std::move(meshPath)), thread_([this, memory, threads] { run(memory, threads); }) {}

CacheBuild::~CacheBuild() {
    isStopped_ = true;
    thread_.join();
}

BuildStatus CacheBuild::status() const {
    const std::scoped_lock lock(mutex_);
    return status_;
}

void CacheBuild::run(Bytes memory, int threads) {
    try {
        Watch watch(*this);
        preprocess::BuildOptions options;
        options.output = cachePath(meshPath_);
        options.memory = memory;
        options.threads = threads;
        const auto source = preprocess::openMeshSources({meshPath_}, memory);
        preprocess::buildModel(*source, options, watch);
    } catch (const Interrupted&) {
        failure_ = "stopped";
    } catch (const std::exception& error) {
        failure_ = error.what();
    }
    isDone_ = true;
}

} // namespace gnomon::app::view
