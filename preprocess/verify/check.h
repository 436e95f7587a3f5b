// What a verification finds: one row a check.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::verify {

/// A uniform cut as far as it was sampled against the source; errors in world units.
struct SampledCut {
    std::uint64_t triangles = 0;
    double stored = 0;         // the largest stored error that it allows
    double sampledRms = 0;     // of the distances from points of the source to the cut
    double sampledLargest = 0; // of the distances both ways
};

/// One check: how much was tested, how much of it failed, the worst value met and the first failure in words.
struct Check {
    std::string name;
    std::uint64_t tested = 0;
    std::uint64_t failed = 0;
    double worst = 0;
    std::string detail = {};
    std::optional<double> tightness = {}; // of error_bound: the median of stored / sampled error
    std::vector<SampledCut> cuts = {};    // of error_bound: those that it compared, finest first

    /// Counts one test; `words` is called for the first failure only.
    template <class Words>
    void test(bool holds, const Words& words) {
        ++tested;
        if (holds) return;
        if (failed++ == 0) detail = words();
    }

    /// Counts the tests of a part, which comes after those before it.
    void add(const Check& part) {
        if (failed == 0 && part.failed > 0) detail = part.detail;
        tested += part.tested;
        failed += part.failed;
        worst = std::max(worst, part.worst);
    }
};

struct Verification {
    std::vector<Check> checks;

    bool ok() const {
        return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.failed == 0; });
    }
};

} // namespace gnomon::verify
