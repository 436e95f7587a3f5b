// `gnomon verify`: is a model file whole, and is what it promises true?
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "preprocess/verify/check.h"

#include <string>
#include <vector>

namespace gnomon::verify {

struct VerifyOptions {
    std::string model;
    std::vector<std::string> source; // paths; empty: no comparison with the source
    std::uint64_t cuts = 100;
    std::uint64_t seed = 1;
    Bytes memory = gibibytes(2); // max resident size of the process
    std::string sourceRoot{};    // as --source-root of a build
};

/// Runs all checks: checksums, structure, nesting, monotone_error, cracks and, with a source, error_bound. Checks that
/// need what a failed one found broken are left out and say so. Holds facts of all groups in memory, of a model of a
/// billion triangles some 300 MB, and pages as `memory` has room for; with a source the whole model and the source.
/// Throws Error only if a file cannot be opened at all, if the source cannot be read, or if `memory` is too small; that
/// error names the memory that does.
Verification verifyModel(const VerifyOptions& options, Progress& progress);

} // namespace gnomon::verify
