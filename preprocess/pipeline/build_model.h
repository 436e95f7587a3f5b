// Builds a .gnm model from a MeshSource: the phases of `gnomon build` in order.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/process_team.h"
#include "preprocess/read/mesh_source.h"

#include <string>
#include <vector>

namespace gnomon::pipeline {

/// The time and the I/O of one phase.
struct BuildPhase {
    std::string name;
    double seconds = 0;
    std::uint64_t bytesRead = 0;
    std::uint64_t bytesWritten = 0;
    TeamShare team; // used if several processes build
};

/// The size of a round after the first.
struct RoundReport {
    std::uint64_t nodes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t locked = 0;       // locked positions
    std::uint64_t lockedBefore = 0; // positions of these that were also locked in the round before
};

/// The result and the costs of a build.
struct BuildReport {
    hierarchy::ModelSummary summary; // the summary in the file
    std::uint64_t pages = 0;
    std::uint64_t irreducibleTriangles = 0;
    std::uint64_t fileBytes = 0;
    std::uint64_t temporaryBytes = 0; // peak size
    std::uint64_t scratchRead = 0;    // bytes of temporary files, read by this process
    std::uint64_t scratchWritten = 0;
    std::uint64_t tableBytes = 0; // peak size of the per-vertex tables of this process
    double seconds = 0;
    std::vector<BuildPhase> phases;
    std::vector<RoundReport> rounds;
    std::string contentHash;
    std::vector<ProcessReport> processes; // where they are many
    Box strays;                           // of corners beyond the grid's range
    double medianEdge = 0;                // of the source
    std::uint64_t badNormals = 0;         // of the source, if its summary does not count them
};

/// Builds `options.output` from `source` out of core: the memory stays below `memory` for any size of the source. The
/// bytes of the model do not depend on the memory, the threads, the place of the temporary files, or a resume. A
/// resumed build starts from the beginning if temporary data are damaged.
///
/// Throws Error
/// - if the source or the output fails,
/// - if the model has no triangles,
/// - if `memory` is too small (the message names the required memory),
/// - if a resumed build has another input or other options,
/// - if temporary data are damaged,
/// - if more than `maxIrreduciblePercent` of the triangles of level 0 are irreducible.
/// After an error there is no file with the name of the output.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, Progress& progress);

/// Builds a model with several processes. Arguments, result and errors are identical.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, ProcessTeam& team, Progress& progress);

} // namespace gnomon::pipeline
