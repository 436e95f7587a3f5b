// What a verification finds: one row a check.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::preprocess {

/// One check: how much was tested, how much of it failed, the worst value met and the first failure in words.
struct Check {
    std::string name;
    std::uint64_t tested = 0;
    std::uint64_t failed = 0;
    double worst = 0;
    std::string detail = {};
    std::optional<double> tightness = {}; // of error_bound: the median of stored / sampled error

    /// Counts one test; `words` is called for the first failure only.
    template <class Words>
    void test(bool holds, const Words& words) {
        ++tested;
        if (holds) return;
        if (failed++ == 0) detail = words();
    }
};

struct Verification {
    std::vector<Check> checks;

    bool ok() const {
        return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.failed == 0; });
    }
};

} // namespace gnomon::preprocess
