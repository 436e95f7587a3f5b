// Meshes that are looked at without a build: the model in the cache beside them, and the thread that builds it.
#pragma once

#include "core/progress.h"
#include "core/units.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace gnomon::viewer {

/// Whether `path` is a model already, by its suffix; everything else is taken for a mesh.
bool isModelPath(const std::string& path);

/// The cache of a mesh: "scan.ply.gnm" beside "scan.ply", which is nobody's own name for a model.
std::string cachePath(const std::string& meshPath);

/// What a cache is built with.
struct CacheOptions {
    Bytes memory; // peak resident size of the build
    int threads = 0;
    std::string sourceRoot{}; // folder that files of the mesh may come from; empty: its own
};

/// Whether the cache of `meshPath` is the one that a build would write now: the file beside it (CACHE.json) names the
/// same version and options, the same model, the same size and time of change for each file that was read, and the same
/// libraries or pictures in the folder of the mesh.
bool isCacheFresh(const std::string& meshPath, const CacheOptions& options);

/// How far a build is.
struct BuildStatus {
    std::string stage;
    std::string unit;
    std::uint64_t done = 0;
    std::uint64_t total = 0; // 0: not known
    double seconds = 0;      // since the build began
};

/// Builds the cache of a mesh on a thread of its own, and writes the file beside it that `isCacheFresh` reads. Ends
/// with the thread: the destructor stops the build and waits.
class CacheBuild {
public:
    CacheBuild(std::string meshPath, const CacheOptions& options);
    ~CacheBuild();
    CacheBuild(const CacheBuild&) = delete;
    CacheBuild& operator=(const CacheBuild&) = delete;
    CacheBuild(CacheBuild&&) = delete;
    CacheBuild& operator=(CacheBuild&&) = delete;

    const std::string& meshPath() const { return meshPath_; }

    BuildStatus status() const;

    bool isDone() const { return isDone_; }

    /// Once done: why there is no model; nothing if there is one.
    const std::optional<std::string>& failure() const { return failure_; }

private:
    class Watch;

    void run(const CacheOptions& options);

    std::string meshPath_;
    mutable std::mutex mutex_;
    BuildStatus status_;
    std::atomic<bool> isStopped_ = false;
    std::atomic<bool> isDone_ = false;
    std::optional<std::string> failure_;
    std::thread thread_; // last, so that it starts with everything else ready
};

} // namespace gnomon::viewer
