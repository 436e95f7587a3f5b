#include "preprocess/build/build.h"

#include "core/error.h"
#include "hierarchy/model_writer.h"
#include "preprocess/build/page_layout.h"
#include "preprocess/build/source_mesh.h"
#include "preprocess/build/weld.h"

#include <tbb/global_control.h>

#include <chrono>
#include <cstdio>
#include <utility>

namespace gnomon::preprocess {

namespace {

constexpr double kLeastProgress = 0.95; // a level of more than this share of the one below is not worth having

class Stopwatch {
public:
    /// Seconds since the last call, or since construction.
    double lap() {
        const auto now = Clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

/// Simplifies level after level until one cluster is left, or nothing gets coarser any more.
std::vector<Level> buildLevels(const Mesh& mesh, const LevelOptions& options, Progress& progress) {
    std::vector<Level> levels;
    levels.push_back(firstLevel(mesh, options));
    for (std::uint32_t number = 0;; ++number) {
        Level& level = levels.back();
        const Level* below = number > 0 ? &levels[number - 1] : nullptr;
        formGroups(level, below, mesh.grid, options, number);
        if (level.clusters.size() == 1) break;
        progress.stage("level " + std::to_string(number), "clusters", level.clusters.size());
        Level next = simplifiedLevel(mesh, level, below, options, progress);
        if (static_cast<double>(next.triangles.size()) > kLeastProgress * static_cast<double>(level.triangles.size())) {
            for (LevelGroup& group : level.groups)
                group.error = std::numeric_limits<double>::infinity();
            break;
        }
        levels.push_back(std::move(next));
    }
    levels.back().errors = {};
    return levels;
}

std::uint64_t rootTriangles(const Level& level) {
    std::uint64_t count = 0;
    for (const LevelGroup& group : level.groups)
        if (group.error == std::numeric_limits<double>::infinity())
            for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
                count += level.clusters[c].triangleCount;
    return count;
}

const char* nameOf(Simplifier simplifier) {
    switch (simplifier) {
    case Simplifier::Meshopt:
        return "meshopt";
    case Simplifier::OpenMesh:
        return "openmesh";
    case Simplifier::Own:
        break;
    }
    return "own";
}

hierarchy::ModelSummary summaryOf(const Mesh& mesh, const std::vector<Level>& levels, const LevelOptions& options) {
    hierarchy::ModelSummary summary;
    summary.grid = mesh.grid;
    summary.bounds = mesh.bounds;
    summary.sourceTriangles = mesh.sourceTriangles;
    summary.sourceVertices = mesh.sourceVertices;
    summary.dropped = mesh.dropped;
    summary.hasNormals = mesh.hasNormals;
    summary.hasColors = mesh.hasColors;
    for (std::size_t number = 0; number < levels.size(); ++number) {
        const Level& level = levels[number];
        hierarchy::LevelInfo info;
        info.triangles = level.triangles.size();
        info.clusters = level.clusters.size();
        info.groups = level.groups.size();
        info.maxError = mesh.grid.snapError();
        for (const LevelCluster& cluster : level.clusters)
            if (cluster.refinement != hierarchy::kNone)
                info.maxError = std::max(info.maxError, levels[number - 1].groups[cluster.refinement].error);
        summary.levels.push_back(info);
        summary.coarsestTriangles += rootTriangles(level);
    }
    summary.options = {
        {"cluster_triangles", std::to_string(options.clusterTriangles)},
        {"error", options.isErrorMeasured ? "measured" : "estimated"},
        {"simplifier", nameOf(options.simplifier)},
    };
    return summary;
}

void requireFewStuck(const BuildReport& report, std::uint64_t triangles, double maxPercent) {
    const double percent = 100.0 * static_cast<double>(report.stuckTriangles) / static_cast<double>(triangles);
    if (percent <= maxPercent) return;
    const auto text = [](double value) {
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), "%.2f%%", value);
        return std::string(digits.data());
    };
    throw Error("--max-stuck", "too many triangles stay at full detail", "at most " + text(maxPercent), text(percent));
}

} // namespace

Bytes memoryToBuild(const MeshSummary& source) {
    // Measured: the source, its weld and two levels side by side at the widest moment, and what the program is anyway.
    constexpr std::uint64_t kBytesPerTriangle = 120;
    constexpr std::uint64_t kBytesPerVertex = 110;
    const std::uint64_t triangles = std::max(source.faceCount, source.stripCount > 0 ? 2 * source.vertexCount : 0);
    return {triangles * kBytesPerTriangle + source.vertexCount * kBytesPerVertex + mebibytes(64).count};
}

BuildReport buildModel(MeshSource& source, const BuildOptions& options, Progress& progress) {
    const MeshSummary& input = source.summary();
    if (const Bytes needed = memoryToBuild(input); needed > options.memory)
        throw Error(
            input.path,
            "too large to build in memory",
            "--memory " + std::to_string((needed.count >> 20U) + 1) + "M or more",
            readableBytes(options.memory));
    const tbb::global_control threads(
        tbb::global_control::max_allowed_parallelism,
        options.threads > 0 ? static_cast<std::size_t>(options.threads)
                            : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    BuildReport report;
    Stopwatch watch;
    const auto phase = [&](const char* name, std::uint64_t bytesRead, std::uint64_t bytesWritten) {
        report.phases.push_back({name, watch.lap(), bytesRead, bytesWritten});
        report.seconds += report.phases.back().seconds;
    };
    hierarchy::ModelWriter writer(options.output);

    SourceMesh read = readSource(source, progress);
    phase("read", input.fileBytes, 0);

    const Mesh mesh = weld(std::move(read));
    if (mesh.triangles.empty()) throw Error(input.path, "no triangles", "at least 1", "0");
    phase("weld", 0, 0);

    const std::vector<Level> levels = buildLevels(mesh, options.level, progress);
    phase("levels", 0, 0);

    report.sourceTriangles = mesh.sourceTriangles;
    report.sourceVertices = mesh.sourceVertices;
    report.dropped = mesh.dropped;
    report.levelCount = levels.size();
    report.stuckTriangles = rootTriangles(levels.front());
    if (levels.size() == 1 && levels.front().clusters.size() == 1) report.stuckTriangles = 0; // nothing to make coarser
    for (const Level& level : levels) {
        report.clusters += level.clusters.size();
        report.groups += level.groups.size();
    }
    if (options.maxStuckPercent) requireFewStuck(report, mesh.triangles.size(), *options.maxStuckPercent);

    report.pages = writePages(mesh, levels, writer, progress);
    const hierarchy::ModelSummary summary = summaryOf(mesh, levels, options.level);
    report.coarsestTriangles = summary.coarsestTriangles;
    report.contentHash = writer.finish(summary);
    report.fileBytes = writer.bytesWritten();
    phase("write", 0, report.fileBytes);
    return report;
}

} // namespace gnomon::preprocess
