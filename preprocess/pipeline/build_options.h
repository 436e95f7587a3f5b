// The options of a build of a .gnm model.
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

/// The default max number of triangles per chunk, which is a part of the source that is built separately. This number
/// is a constant of the format, because it affects the bytes of the model. Borders between chunks stay at full detail
/// for one round, so larger chunks reduce the number of triangles in a view. The memory of an ordinary machine is
/// sufficient for two such chunks at a time.
constexpr std::uint32_t kChunkTriangles = 1U << 20U;

/// The output path, the limits and the format options of a build.
struct BuildOptions {
    std::string output;
    Bytes memory = gibibytes(2); // max resident memory of the process
    levels::LevelOptions level;
    std::uint32_t chunkTriangles = kChunkTriangles;
    std::optional<double> maxIrreduciblePercent;
    int threads = 0;                     // number of threads; 0: all threads of the machine
    std::string temporaryFolder;         // folder for temporary files; empty: next to the output
    bool isInMemory = false;             // whether temporary files are in memory
    std::optional<hierarchy::UpAxis> up; // up axis; nullopt: guess it from the shape of the mesh (hierarchy/up_guess.h)
    std::string upBecause = "as asked";  // text that explains the up axis, if `up` is given
    hierarchy::UpVotes upVotes{};        // votes for the guess of the up axis, from the kind of the source file
    hierarchy::Unit unit = hierarchy::Unit::Metre;
    // whether the grid includes triangles far outside the main part of the source (chunk/survey.h)
    bool keepsStrays = false;
    std::vector<std::string> fields; // names of the fields (scalar vertex properties) of the source, in order
    bool isResumed = false;          // whether to continue the work of an interrupted build, if there is any
    std::string inputKey;            // identifies the input files for a resumed build (fingerprint.h)

    // Max rate of reading and writing temporary files, in bytes per second per process. 0 means no limit.
    std::uint64_t scratchBytesPerSecond = 0;

    /// This function is called before a resumed build starts from the beginning because temporary data are damaged. Its
    /// argument describes the damage.
    std::function<void(const std::string&)> onDamage = {};

    /// This function is called if the folder of temporary files cannot be removed because it contains other files. Its
    /// argument is the path of the folder.
    std::function<void(const std::string&)> onKeptFolder = {};
};

} // namespace gnomon::pipeline
