// Opens meshes without an explicit build: a cached model next to the mesh, and the thread that builds it.
#pragma once

#include "core/progress.h"
#include "core/units.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace gnomon::viewer {

/// Returns true if `path` ends like the path of a model (.gnm). All other files are meshes.
bool isModelPath(const std::string& path);

/// Returns the path of a mesh's cache: "scan.ply.gnm" for "scan.ply". It does not collide with names that users choose
/// for models.
std::string cachePath(const std::string& meshPath);

/// The options of a cache.
struct CacheOptions {
    Bytes memory; // max resident size of the build
    int threads = 0;
    std::string sourceRoot{}; // folder that files of the mesh may come from; empty: the folder of the mesh
};

/// Returns true if the cache is up to date, so that a build would write the same file. The record (CACHE.json) must
/// contain the same version, options and model, the same size and time of change of each file that was read, and the
/// same names of libraries or textures in the folder of the mesh.
bool isCacheFresh(const std::string& meshPath, const CacheOptions& options);

/// The progress of a build.
struct BuildStatus {
    std::string stage;
    std::string unit;
    std::uint64_t done = 0;
    std::uint64_t total = 0; // 0: unknown
    double seconds = 0;      // since the start of the build
};

/// Builds the cache of a mesh in a separate thread, and writes the record for `isCacheFresh`. The destructor stops the
/// build and waits for the thread.
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

    /// Returns the reason of a failure after the end, or nothing if there is a model.
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
    std::thread thread_; // the last member, so that the thread starts after all others are initialised
};

} // namespace gnomon::viewer
