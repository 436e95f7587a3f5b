// `gnomon build` from a MeshSource to a .gnm: the phases in the order in which they run.
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "preprocess/build/level.h"
#include "preprocess/read/mesh_source.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::preprocess {

struct BuildOptions {
    std::string output;
    Bytes memory = gibibytes(2); // the peak resident size of the process
    LevelOptions level;
    std::optional<double> maxStuckPercent;
    int threads = 0; // 0: all
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
    double seconds = 0;
    std::vector<BuildPhase> phases;
    std::string contentHash;
};

/// The memory that building `source` takes at its peak, from the counts of its header.
Bytes memoryToBuild(const MeshSummary& source);

/// Builds `options.output` from `source`. Throws Error for what the source or the output refuses, for a model without
/// triangles, for a `memory` that is too small (naming the one that would do), and where more than `maxStuckPercent` of
/// the triangles stay stuck at full detail; then nothing is left under the output's name.
BuildReport buildModel(MeshSource& source, const BuildOptions& options, Progress& progress);

} // namespace gnomon::preprocess
