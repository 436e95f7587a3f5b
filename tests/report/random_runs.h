// Random runs for tests of the report.
#pragma once

#include "core/random.h"
#include "report/accuracy_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::report {

/// Sets random errors of `run`. If not `knowsAll`, some are missing.
inline void setRandomErrors(Random& random, RunSummary& run, bool knowsAll) {
    for (const ErrorKind kind : kErrorKinds)
        if (knowsAll || random.below(4) != 0) run.errors[kind] = static_cast<double>(random.below(12)) / 8;
    if (run.settings.contains("cells") && random.below(4) != 0) run.errors[ErrorKind::WrongPixels] = 0;
    if (random.below(12) == 0) run.errors[ErrorKind::WrongPixels] = std::numeric_limits<double>::quiet_NaN();
}

/// Returns runs with few, often equal values. Several have the same number of maps, some have other settings, some
/// draw exact shadows, and some lack errors.
inline std::vector<RunSummary> anyRuns(Random& random) {
    std::vector<RunSummary> runs(random.below(9));
    const bool knowsAll = random.below(2) == 0;
    for (RunSummary& run : runs) {
        run.shadowMaps = static_cast<int>(random.below(9));
        run.p50Ms = static_cast<double>(1 + random.below(30)) * 10;
        if (random.below(4) != 0) run.noise = random.below(8) == 0 ? 1.0 : random.uniform(0, 0.3);
        run.settings = {
            {"warp", random.below(5) == 0 ? "none" : "auto"},
            {"error_pixels", random.below(6) == 0 ? "2" : "1"},
            {"shadow_maps", std::to_string(run.shadowMaps)},
            {"z_partitions", std::to_string(run.shadowMaps)}};
        if (run.shadowMaps == 0 && random.below(3) != 0) run.settings["cells"] = "map+w";
        setRandomErrors(random, run, knowsAll);
    }
    return runs;
}

inline bool knows(const RunSummary& run, ErrorKind kind) {
    const auto found = run.errors.find(kind);
    return found != run.errors.end() && std::isfinite(found->second);
}

inline bool allKnow(const std::vector<RunSummary>& runs, ErrorKind kind) {
    return std::all_of(runs.begin(), runs.end(), [&](const RunSummary& run) { return knows(run, kind); });
}

} // namespace gnomon::report
