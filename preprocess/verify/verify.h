// Implements `gnomon verify`: checks that a model file is complete and that its stored bounds are true.
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "preprocess/verify/check.h"

#include <string>
#include <vector>

namespace gnomon::verify {

/// The options of `gnomon verify`.
struct VerifyOptions {
    std::string model;
    std::vector<std::string> source; // paths of the source files; if empty, the source is not compared
    std::uint64_t cuts = 100;
    std::uint64_t seed = 1;
    Bytes memory = gibibytes(2); // max resident size of the process
    std::string sourceRoot{};    // the folder of --source-root, as for a build
};

/// Runs all checks of a model: checksums, structure, nesting, monotone_error, cracks and, if a source is given,
/// error_bound. If an earlier check fails, a check that depends on it is skipped with a note. The properties of all
/// groups are in memory, about 300 MB for a model of a billion triangles. Pages use the rest of `memory`. With a
/// source, the whole model and the whole source are in memory. Throws Error only if a file cannot be opened, if the
/// source cannot be read, or if `memory` is too small. In the last case the message names the required memory.
Verification verifyModel(const VerifyOptions& options, Progress& progress);

} // namespace gnomon::verify
