#include "viewer/model_cache.h"

#include "core/file.h"
#include "core/json_file.h"
#include "core/printable.h"
#include "core/stopwatch.h"
#include "hierarchy/model_file.h"
#include "hierarchy/source/open_source.h"
#include "preprocess/pipeline/build_key.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/pipeline/source_up.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/words.h"
#include "telemetry/json_text.h"

#include <filesystem>
#include <set>
#include <vector>

namespace gnomon::viewer {

/// Forwards the progress of the build to its status, and interrupts the build when it is stopped.
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
    return hierarchy::isAddress(path) || std::filesystem::path(path).extension() == ".gnm";
}

std::string cachePath(const std::string& meshPath) {
    return meshPath + ".gnm";
}

namespace {

namespace fs = std::filesystem;

/// Returns the path of the record, a file that describes from which files the cached model was built.
std::string recordPath(const std::string& meshPath) {
    return cachePath(meshPath) + ".json";
}

/// Returns the size and the time of change of a file as JSON. They differ if the content changes. Returns null if there
/// is no such file.
nlohmann::ordered_json factsOf(const fs::path& path) {
    std::error_code failure;
    if (!fs::is_regular_file(path, failure)) return nullptr;
    const std::uintmax_t bytes = fs::file_size(path, failure);
    const fs::file_time_type changed = fs::last_write_time(path, failure);
    if (failure) return nullptr;
    return {{"bytes", bytes}, {"changed_ns", changed.time_since_epoch().count()}};
}

/// Returns the names of libraries or textures in the folder of the mesh and its subfolders. If such a file appears
/// later, the cached model is outdated, because the mesh may use a file that was missing during the build.
std::set<std::string> namesInFolder(const fs::path& mesh) {
    constexpr std::size_t kMaxEntries = 10'000;
    const std::string format = read::loweredSuffix(mesh.string());
    const std::set<std::string> suffixes = format == ".obj"    ? std::set<std::string>{".mtl"}
                                           : format == ".gltf" ? std::set<std::string>{".png", ".jpg", ".jpeg", ".webp"}
                                                               : std::set<std::string>();
    std::set<std::string> names;
    if (suffixes.empty()) return names;
    const fs::path folder = mesh.has_parent_path() ? mesh.parent_path() : fs::path(".");
    std::error_code failure;
    std::size_t entries = 0;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, failure);
    for (const fs::recursive_directory_iterator end; !failure && it != end && entries < kMaxEntries; ++entries) {
        if (it.depth() > 0) it.disable_recursion_pending();
        if (suffixes.contains(read::loweredSuffix(it->path().string())))
            names.insert(it->path().lexically_relative(folder).string());
        it.increment(failure);
    }
    return names;
}

pipeline::BuildOptions buildOptionsOf(const std::string& meshPath, const CacheOptions& cache) {
    pipeline::BuildOptions options;
    options.output = cachePath(meshPath);
    options.memory = cache.memory;
    options.threads = cache.threads;
    return options;
}

/// Returns the record of a cached model: the program version, the options that affect its bytes, the size and time of
/// change of each of `files`, and the names from namesInFolder. File names are relative to the folder of the mesh.
nlohmann::ordered_json recordOf(
    const std::string& meshPath, const std::vector<std::string>& files, const CacheOptions& options) {
    nlohmann::ordered_json record = {
        {"version", GNOMON_VERSION},
        {"options", pipeline::keyOf(buildOptionsOf(meshPath, options))},
        {"source_root", options.sourceRoot},
        {"files", nlohmann::ordered_json::array()},
        {"beside", namesInFolder(meshPath)}};
    for (const std::string& name : files)
        record["files"].push_back({{"name", name}, {"facts", factsOf(fs::path(meshPath).parent_path() / name)}});
    return record;
}

} // namespace

bool isCacheFresh(const std::string& meshPath, const CacheOptions& options) {
    try {
        const nlohmann::ordered_json stored = readJsonFile(recordPath(meshPath));
        std::vector<std::string> files;
        for (const auto& file : stored.at("files"))
            files.push_back(file.at("name"));
        nlohmann::ordered_json now = recordOf(meshPath, files, options);
        now["model"] = hierarchy::ModelFile(cachePath(meshPath)).contentHash();
        return now == stored;
    } catch (const std::exception&) {
        return false; // no record, another version, or damage; a build then reports errors of the mesh
    }
}

CacheBuild::CacheBuild(std::string meshPath, const CacheOptions& options)
    : meshPath_(std::move(meshPath)), thread_([this, options] { run(options); }) {}

CacheBuild::~CacheBuild() {
    isStopped_ = true;
    thread_.join();
}

BuildStatus CacheBuild::status() const {
    const std::scoped_lock lock(mutex_);
    return status_;
}

void CacheBuild::run(const CacheOptions& options) {
    try {
        Watch watch(*this);
        const fs::path folder = fs::path(meshPath_).parent_path();
        std::vector<std::string> files = {fs::path(meshPath_).filename().string()};
        const nlohmann::ordered_json before = recordOf(meshPath_, files, options);
        pipeline::BuildOptions build = buildOptionsOf(meshPath_, options);
        pipeline::askForUpOfSources(build, {meshPath_});
        const auto source =
            read::openMeshSources({meshPath_}, options.memory, {}, read::Textures::Bake, options.sourceRoot);
        for (const std::string& path : source->summary().additionalFiles)
            files.push_back(fs::path(path).lexically_proximate(folder).string());
        nlohmann::ordered_json record = recordOf(meshPath_, files, options);
        pipeline::buildModel(*source, build, watch);
        // If a source file changed during the build, the content that was read is unknown. The next window must then
        // build the model again.
        const bool isSame = record == recordOf(meshPath_, files, options) && record["files"][0] == before["files"][0];
        record["model"] = hierarchy::ModelFile(build.output).contentHash();
        if (isSame) writeTextFile(recordPath(meshPath_), telemetry::jsonText(record, 1) + "\n");
    } catch (const Interrupted&) {
        failure_ = "stopped";
    } catch (const std::exception& error) {
        failure_ = inWords(error);
    }
    isDone_ = true;
}

} // namespace gnomon::viewer
