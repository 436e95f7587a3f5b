// The options of `gnomon path`.
#pragma once

#include "path/walk.h"

#include <string>

namespace gnomon::settings {

/// The options of `gnomon path`: the kind of camera path, and the options of a walk.
struct PathOptions {
    std::string kind; // "walk", "orbit", "flyby", "approach" or "source"
    path::WalkOptions walk;
};

/// Throws UsageError in these cases:
/// - the kind of path is unknown,
/// - an option of a walk is given for another kind,
/// - the storey is negative, or the eye height is not finite and above 0.
void checkPathOptions(const PathOptions& options);

} // namespace gnomon::settings
