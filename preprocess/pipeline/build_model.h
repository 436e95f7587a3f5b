// `gnomon build` from a MeshSource to a .gnm: the phases in the order in which they run.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/process_team.h"
#include "preprocess/read/mesh_source.h"

#include <string>
#include <vector>

namespace gnomon::pipeline {

struct BuildPhase {
    std::string name;
    double seconds = 0;
    std::uint64_t bytesRead = 0;
    std::uint64_t bytesWritten = 0;
    TeamShare team; // where many processes build
};

/// What was binned for a round after the first.
struct RoundReport {
    std::uint64_t nodes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t locked = 0;       // positions
    std::uint64_t lockedBefore = 0; // of these, in the round before as well
};

struct BuildReport {
    hierarchy::ModelSummary summary; // as it stands in the file
    std::uint64_t pages = 0;
    std::uint64_t stuckTriangles = 0;
    std::uint64_t fileBytes = 0;
    std::uint64_t temporaryBytes = 0; // at their peak
    std::uint64_t scratchRead = 0;    // bytes of temporary files, by this process
    std::uint64_t scratchWritten = 0;
    std::uint64_t tableBytes = 0; // at most, of what is known of each vertex, by this process
    double seconds = 0;
    std::vector<BuildPhase> phases;
    std::vector<RoundReport> rounds;
    std::string contentHash;
    std::vector<ProcessReport> processes; // where they are many
    Box strays;                           // of corners beyond the grid's range
    double medianEdge = 0;                // of the source
    std::uint64_t badNormals = 0;         // of the source, if its summary does not count them
};

/// Builds `options.output` from `source`, out of core: whatever the source's size, memory stays below `memory`. The
/// bytes are the same for any memory, threads and place of the temporary files, resumed or not. A resumed build starts
/// anew if temporary data are damaged. Throws Error for what the source or the output refuses, for a model without
/// triangles, for a `memory` that is too small (naming the one that would do), for a resumed build of another input or
/// with other options, for damaged temporary data, and where more than `maxStuckPercent` of the triangles stay stuck at
/// full detail; then nothing is left under the output's name.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, Progress& progress);

/// The same by many processes.
BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, ProcessTeam& team, Progress& progress);

} // namespace gnomon::pipeline
