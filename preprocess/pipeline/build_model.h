// Builds a .gnm model from a source mesh. It runs the phases of `gnomon build` in order.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/process_team.h"
#include "preprocess/read/mesh_source.h"

#include <string>
#include <vector>

namespace gnomon::pipeline {

/// The duration of one build phase and the number of bytes that it read and wrote.
struct BuildPhase {
    std::string name;
    double seconds = 0;
    std::uint64_t bytesRead = 0;
    std::uint64_t bytesWritten = 0;
    TeamShare team; // work of each process in this phase, if several processes build
};

/// The number of nodes and triangles in one round of a build. Round 0 has no report.
struct RoundReport {
    std::uint64_t nodes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t locked = 0;       // number of locked positions
    std::uint64_t lockedBefore = 0; // number of positions that were locked both in this round and in the previous round
};

/// The result and the cost of a build.
struct BuildReport {
    hierarchy::ModelSummary summary; // the model summary that the file contains
    std::uint64_t pages = 0;
    std::uint64_t irreducibleTriangles = 0;
    std::uint64_t fileBytes = 0;
    std::uint64_t temporaryBytes = 0; // peak size of the temporary files in bytes
    std::uint64_t scratchRead = 0;    // bytes that this process read from temporary files
    std::uint64_t scratchWritten = 0;
    std::uint64_t tableBytes = 0; // peak size of the per-vertex tables of this process in bytes
    double seconds = 0;
    std::vector<BuildPhase> phases;
    std::vector<RoundReport> rounds;
    std::string contentHash;
    std::vector<ProcessReport> processes; // one report per process, if several processes build
    Box strays;                           // bounds of the triangle corners outside the range of the grid
    double medianEdge = 0;                // median edge length of the source mesh
    std::uint64_t badNormals = 0;         // number of invalid normals in the source, if its summary does not count them
};

/// Builds the model `options.output` from `source` out of core. The memory of the process stays below `memory` for any
/// size of the source. The bytes of the model do not depend on the memory limit, the number of threads, the place of
/// the temporary files, or an interruption with a resumed build. If temporary data are damaged, a resumed build starts
/// from the beginning. Throws Error
/// - if the source or the output fails,
/// - if the model has no triangles,
/// - if `memory` is too small (the message names the required memory),
/// - if a resumed build has another input or other options,
/// - if temporary data are damaged,
/// - if more than `maxIrreduciblePercent` of the triangles of level 0 are irreducible.
/// After an error there is no file with the name of the output.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, Progress& progress);

/// Builds a model with several processes, which are the members of `team`. The other arguments, the result and the
/// errors are those of the function with one process.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, ProcessTeam& team, Progress& progress);

} // namespace gnomon::pipeline
