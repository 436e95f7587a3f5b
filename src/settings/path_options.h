// What `gnomon path` is asked for.
#pragma once

#include "path/walk.h"

#include <string>

namespace gnomon::settings {

inline constexpr const char* kPathKindHelp =
    "walk, orbit, flyby, approach or source. A walk goes over floors at eye height, 1.4 m/s, for a minute at most: "
    "through rooms, doors and stairs, or around a thing that has no floor. Orbit, flyby and approach take 12 s. Source "
    "writes the cameras of the source, a glTF, a second apart";

struct PathOptions {
    std::string kind;
    path::WalkOptions walk;
};

/// Throws UsageError where there is no such kind of path, where options of a walk are given with another one, or where
/// they are no storey (0 or more) or height (finite, above 0).
void checkPathOptions(const PathOptions& options);

} // namespace gnomon::settings
