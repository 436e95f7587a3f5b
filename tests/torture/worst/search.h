// Hill climbing with restarts over genes: seeded, and the same for the same seed and number of steps.
#pragma once

#include "objectives.h"

#include <cstdint>
#include <functional>

namespace gnomon::torture {

struct SearchOptions {
    std::uint64_t seed = 1;
    std::uint64_t steps = 1000;    // evaluations in all
    std::uint64_t stepsAClimb = 0; // 0: as many as genes, times 12
    std::function<bool()> isOver;  // asked before each step but the first; where it is so the search ends, early
};

struct Found {
    std::vector<double> genes;
    double value = 0;
    bool operator==(const Found&) const = default;
};

struct SearchResult {
    Found worst;              // of all that were looked at
    std::vector<Found> finds; // above the bar, each of another climb, shrunk
    std::uint64_t climbs = 0;
    std::uint64_t steps = 0; // that were made
    std::uint64_t stepOfWorst = 0;
    bool operator==(const SearchResult&) const = default;
};

/// Looks for the largest score: from random genes on, changes that make it no smaller are kept, and a climb ends above
/// the bar or after so many steps.
SearchResult search(const Objective& objective, const SearchOptions& options);

/// `found` with as many genes as can be at 0, a half or 1 without falling to the bar.
Found shrunk(const Objective& objective, Found found);

} // namespace gnomon::torture
