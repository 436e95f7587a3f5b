// The result of `gnomon verify`, with one entry per check.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// A uniform cut (one level of detail of the whole model) and its sampled distances to the source mesh. Distances and
/// errors are in world units.
struct SampledCut {
    std::uint64_t triangles = 0;
    double stored = 0;         // largest stored error of the clusters of this cut
    double sampledRms = 0;     // RMS distance from sampled points of the source to the cut
    double sampledLargest = 0; // largest sampled distance, from source to cut or from cut to source
};

/// The result of one check of a model: the number of tests, the number of failed tests, the worst value, and a
/// description of the first failure.
struct Check {
    std::string name;
    std::uint64_t tested = 0;
    std::uint64_t failed = 0;
    double worst = 0;
    std::string detail = {};
    std::optional<double> tightness = {}; // only for error_bound: median of stored error / sampled error
    std::vector<SampledCut> cuts = {};    // only for error_bound: the compared cuts, finest first

    /// Counts one test, which fails if `holds` is false. For the first failure, the function calls `words` to get its
    /// description.
    template <class Words>
    void test(bool holds, const Words& words) {
        ++tested;
        if (holds) return;
        if (failed++ == 0) detail = words();
    }

    /// Adds the tests of one part of the model, such as a page. Parts must be added in order, so that `detail`
    /// describes the first failure.
    void add(const Check& part) {
        if (failed == 0 && part.failed > 0) detail = part.detail;
        tested += part.tested;
        failed += part.failed;
        worst = std::max(worst, part.worst);
    }
};

/// The results of all checks of one model.
struct Verification {
    std::vector<Check> checks;

    bool ok() const {
        return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.failed == 0; });
    }
};

} // namespace gnomon::verify
