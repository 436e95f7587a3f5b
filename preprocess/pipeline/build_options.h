// What a build is asked for.
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

/// The most triangles of a chunk, unless told otherwise: a constant of the format, since it shapes the model's bytes.
/// Borders between chunks stay fine for a round, so the larger the fewer triangles a view has; two at a time
/// still fit well into the memory of an ordinary machine.
constexpr std::uint32_t kChunkTriangles = 1U << 20U;

struct BuildOptions {
    std::string output;
    Bytes memory = gibibytes(2); // the peak resident size of the process
    levels::LevelOptions level;
    std::uint32_t chunkTriangles = kChunkTriangles;
    std::optional<double> maxStuckPercent;
    int threads = 0;                     // 0: all
    std::string temporaryFolder;         // for temporary files; empty: beside the output
    bool isInMemory = false;             // temporary files in memory
    std::optional<hierarchy::UpAxis> up; // nothing: guessed from the mesh's shape (hierarchy/up_guess.h)
    std::string upBecause = "as asked";  // where it is given: who says so
    hierarchy::UpVotes upVotes{};        // where it is guessed: what the kind of the source says
    hierarchy::Unit unit = hierarchy::Unit::Metre;
    bool keepsStrays = false; // the grid's range includes triangles far outside of the main part (chunk/survey.h)
    std::vector<std::string> fields; // that the source was opened with, in order
    bool isResumed = false;          // go on with what a killed build left, if anything
    std::string inputKey;            // what tells this input from others, for a build that resumes (fingerprint.h)

    std::uint64_t scratchBytesPerSecond = 0; // each process reads and writes no more of temporary files; 0: no limit

    /// Told which temporary data are damaged, before a resumed build starts anew.
    std::function<void(const std::string&)> onDamage = {};

    /// Told the folder of temporary files if it stays, for what no build has written into it.
    std::function<void(const std::string&)> onKeptFolder = {};
};

} // namespace gnomon::pipeline
