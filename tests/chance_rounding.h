// Rounding by chance: in a program that is compiled with calls where functions begin and end (-finstrument-functions),
// each such place sets a mode that is drawn from a seeded sequence. An addition of vectors is a function.
#pragma once

#include <cstdint>

namespace gnomon::tests {

/// As long as it lives; one at a time.
class ChanceRounding {
public:
    explicit ChanceRounding(std::uint64_t seed);
    ~ChanceRounding();

    ChanceRounding(const ChanceRounding&) = delete;
    ChanceRounding& operator=(const ChanceRounding&) = delete;
    ChanceRounding(ChanceRounding&&) = delete;
    ChanceRounding& operator=(ChanceRounding&&) = delete;

    /// How often a mode was set, by all of them.
    static std::uint64_t count();
};

} // namespace gnomon::tests
