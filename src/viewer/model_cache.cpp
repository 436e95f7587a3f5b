#include "viewer/model_cache.h"

#include "core/error.h"
#include "core/file.h"
#include "core/stopwatch.h"
#include "hierarchy/model_file.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/pipeline/source_up.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/ply/ply_source.h"
#include "storage/open_source.h"

#include <array>
#include <filesystem>

namespace gnomon::viewer {

/// Passes progress on to the status, and the wish to stop back.
class CacheBuild::Watch final : public Progress {
public:
    explicit Watch(CacheBuild& build) : build_(&build) {}

    void stage(std::string_view name, std::string_view unit, std::uint64_t total) override {
        const std::scoped_lock lock(build_->mutex_);
        build_->status_ = {std::string(name), std::string(unit), 0, total, seconds()};
    }

    void expect(std::uint64_t total) override {
        const std::scoped_lock lock(build_->mutex_);
        build_->status_.total = total;
    }

    void advance(std::uint64_t count) override {
        if (build_->isStopped_) throw Interrupted{};
        const std::scoped_lock lock(build_->mutex_);
        build_->status_.done += count;
        build_->status_.seconds = seconds();
    }

private:
    double seconds() const { return watch_.elapsed().count / 1000; }

    CacheBuild* build_;
    Stopwatch watch_;
};

bool isModelPath(const std::string& path) {
    return storage::isAddress(path) || std::filesystem::path(path).extension() == ".gnm";
}

std::string cachePath(const std::string& meshPath) {
    return meshPath + ".gnm";
}

namespace {

/// Whether `model` can have been built from the mesh: a PLY says without being read whole how many vertices and faces
/// it has.
bool canBeOf(const hierarchy::ModelSummary& model, const std::string& meshPath) {
    std::array<char, 4> start{};
    File(meshPath, File::Mode::Read).readSomeAt(0, std::as_writable_bytes(std::span(start)));
    const std::string_view line(start.data(), start.size());
    if (line != "ply\n" && line != "ply\r") return true;
    const read::MeshSummary mesh = read::openPly(meshPath)->summary();
    if (mesh.vertexCount != model.sourceVertices) return false;
    // A polygon is one triangle or more, and a strip any number.
    const auto none = model.dropped.find("not_a_polygon");
    const std::uint64_t most = model.sourceTriangles + (none == model.dropped.end() ? 0 : none->second);
    return mesh.faceCount <= most && (mesh.faceCount > 0 || mesh.stripCount > 0);
}

} // namespace

bool isCacheFresh(const std::string& meshPath) {
    std::error_code error;
    const auto built = std::filesystem::last_write_time(cachePath(meshPath), error);
    if (error) return false;
    const auto made = std::filesystem::last_write_time(meshPath, error);
    if (error || built < made) return false;
    try {
        return canBeOf(hierarchy::ModelFile(cachePath(meshPath)).summary(), meshPath);
    } catch (const Error&) {
        return false; // another version's, or damaged: a build makes it whole, or says what is wrong with the mesh
    }
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
        pipeline::BuildOptions options;
        options.output = cachePath(meshPath_);
        options.memory = memory;
        options.threads = threads;
        pipeline::askForUpOfSources(options, {meshPath_});
        const auto source = read::openMeshSources({meshPath_}, memory);
        pipeline::buildModel(*source, options, watch);
    } catch (const Interrupted&) {
        failure_ = "stopped";
    } catch (const std::exception& error) {
        failure_ = error.what();
    }
    isDone_ = true;
}

} // namespace gnomon::viewer
