// Opens meshes in the window without an explicit build. A thread builds a model next to the mesh, which is a cache for
// later sessions.
#pragma once

#include "core/progress.h"
#include "core/units.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace gnomon::viewer {

/// Returns true if `path` ends like the path of a model (.gnm). The window treats all other files as meshes.
bool isModelPath(const std::string& path);

/// Returns the path of the model that is built for a mesh: "scan.ply.gnm" for "scan.ply". Users are unlikely to choose
/// this name for a model of their own.
std::string cachePath(const std::string& meshPath);

/// The options with which a mesh is built into a cached model.
struct CacheOptions {
    Bytes memory; // max resident size of the build
    int threads = 0;
    std::string sourceRoot{}; // folder that files of the mesh may come from; empty: the folder of the mesh
};

/// Returns true if the cached model is up to date, so that a build would write the same file. The function compares the
/// record of the build (CACHE.json) with the present state. The version, the options, the model, the size and time of
/// change of each file that was read, and the names of libraries or textures in the folder of the mesh must be the
/// same.
bool isCacheFresh(const std::string& meshPath, const CacheOptions& options);

/// The progress of a running build of a cached model.
struct BuildStatus {
    std::string stage;
    std::string unit;
    std::uint64_t done = 0;
    std::uint64_t total = 0; // 0: unknown
    double seconds = 0;      // since the start of the build
};

/// Builds the cached model of a mesh in a separate thread. Also writes the record that `isCacheFresh` reads. The
/// destructor stops the build and waits for the thread.
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

    /// After the end of the build, returns the reason of its failure, or nullopt if it succeeded.
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
