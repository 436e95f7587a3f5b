// The result of a verification. It has one entry per check.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// A uniform cut and its sampled distances to the source. Distances and errors are in world units.
struct SampledCut {
    std::uint64_t triangles = 0;
    double stored = 0;         // largest stored error of the cut's clusters
    double sampledRms = 0;     // RMS of the distances from sampled source points to the cut
    double sampledLargest = 0; // largest sampled distance, from the source to the cut or from the cut to the source
};

/// The result of one check: the number of tests, the number of failures, the worst value and a description of the first
/// failure.
struct Check {
    std::string name;
    std::uint64_t tested = 0;
    std::uint64_t failed = 0;
    double worst = 0;
    std::string detail = {};
    std::optional<double> tightness = {}; // only of error_bound: median of stored error / sampled error
    std::vector<SampledCut> cuts = {};    // only of error_bound: the compared cuts, finest first

    /// Counts one test, which failed if `holds` is false. The function calls `words` only for the first failure, to
    /// describe it.
    template <class Words>
    void test(bool holds, const Words& words) {
        ++tested;
        if (holds) return;
        if (failed++ == 0) detail = words();
    }

    /// Adds the tests of a part of the model. Parts must be added in order, so that `detail` describes the first
    /// failure.
    void add(const Check& part) {
        if (failed == 0 && part.failed > 0) detail = part.detail;
        tested += part.tested;
        failed += part.failed;
        worst = std::max(worst, part.worst);
    }
};

/// The results of all checks of a model.
struct Verification {
    std::vector<Check> checks;

    bool ok() const {
        return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.failed == 0; });
    }
};

} // namespace gnomon::verify
