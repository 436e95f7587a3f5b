// `gnomon build` from a MeshSource to a .gnm: the phases in the order in which they run.
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "preprocess/levels/level.h"
#include "preprocess/read/mesh_source.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::pipeline {

/// The most triangles of a chunk, unless told otherwise: a constant of the format, since it shapes the model's bytes.
/// Borders between chunks stay fine until the chunks meet, so the larger the fewer triangles a view has; two at a time
/// still fit well into the memory of an ordinary machine.
constexpr std::uint32_t kChunkTriangles = 1U << 20U;

struct BuildOptions {
    std::string output;
    Bytes memory = gibibytes(2); // the peak resident size of the process
    levels::LevelOptions level;
    std::uint32_t chunkTriangles = kChunkTriangles;
    std::optional<double> maxStuckPercent;
    int threads = 0;             // 0: all
    std::string temporaryFolder; // for temporary files; empty: beside the output
    bool isInMemory = false;     // temporary files in memory
    bool isResumed = false;      // go on with what a killed build left, if anything
    std::string inputKey;        // what tells this input from others, for a build that resumes (fingerprint.h)

    /// Told the folder of temporary files if it stays, for what no build has written into it.
    std::function<void(const std::string&)> onKeptFolder = {};
};

struct BuildPhase {
    std::string name;
    double seconds = 0;
    std::uint64_t bytesRead = 0;
    std::uint64_t bytesWritten = 0;
};

struct BuildReport {
    std::uint64_t sourceTriangles = 0;
    std::uint64_t sourceVertices = 0;
    std::map<std::string, std::uint64_t> dropped;
    std::uint64_t clusters = 0;
    std::uint64_t groups = 0;
    std::uint64_t levelCount = 0;
    std::uint64_t pages = 0;
    std::uint64_t stuckTriangles = 0;
    std::uint64_t coarsestTriangles = 0;
    std::uint64_t fileBytes = 0;
    std::uint64_t temporaryBytes = 0; // at their peak
    double seconds = 0;
    std::vector<BuildPhase> phases;
    std::string contentHash;
};

/// Builds `options.output` from `source`, out of core: whatever the source's size, memory stays below `memory`. The
/// bytes are the same for any memory, threads and place of the temporary files, resumed or not. Throws Error for what
/// the source or the output refuses, for a model without triangles, for a `memory` that is too small (naming the one
/// that would do), for a resumed build of another input or with other options, and where more than `maxStuckPercent` of
/// the triangles stay stuck at full detail; then nothing is left under the output's name.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, Progress& progress);

} // namespace gnomon::pipeline
