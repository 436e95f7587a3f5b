// The options of a build.
#pragma once

#include "core/units.h"
#include "hierarchy/up_guess.h"
#include "hierarchy/world_frame.h"
#include "preprocess/levels/level.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::pipeline {

/// The default max number of triangles per chunk. It is a constant of the format, because it affects the bytes of the
/// model. Borders between chunks stay at full detail for one round. Larger chunks therefore reduce the triangles of a
/// view. Two chunks at a time fit into the memory of an ordinary machine.
constexpr std::uint32_t kChunkTriangles = 1U << 20U;

/// The input, the limits and the format of a build.
struct BuildOptions {
    std::string output;
    Bytes memory = gibibytes(2); // max resident size of the process
    levels::LevelOptions level;
    std::uint32_t chunkTriangles = kChunkTriangles;
    std::optional<double> maxIrreduciblePercent;
    int threads = 0;                     // 0: all threads
    std::string temporaryFolder;         // folder for temporary files; empty: next to the output
    bool isInMemory = false;             // whether temporary files are in memory
    std::optional<hierarchy::UpAxis> up; // nothing: guess the axis from the shape of the mesh (hierarchy/up_guess.h)
    std::string upBecause = "as asked";  // origin of a given axis
    hierarchy::UpVotes upVotes{};        // votes for a guessed axis from the kind of the source
    hierarchy::Unit unit = hierarchy::Unit::Metre;
    bool keepsStrays = false;        // extend the grid's range to triangles far outside the main part (chunk/survey.h)
    std::vector<std::string> fields; // names of the fields with which the source was opened, in order
    bool isResumed = false;          // continue the work of a killed build if there is any
    std::string inputKey;            // identifies the input for a resumed build (fingerprint.h)

    // Max rate of reading and writing of temporary files per process; 0: no limit.
    std::uint64_t scratchBytesPerSecond = 0;

    /// Receives the description of damaged temporary data before a resumed build starts from the beginning.
    std::function<void(const std::string&)> onDamage = {};

    /// Receives the folder of temporary files if it cannot be removed because it contains other files.
    std::function<void(const std::string&)> onKeptFolder = {};
};

} // namespace gnomon::pipeline
