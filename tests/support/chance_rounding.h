// Random rounding modes. The program under test is compiled with calls at the start and end of each function
// (-finstrument-functions). Each call sets a rounding mode from a seeded sequence. Even the addition of two vectors is
// a function.
#pragma once

#include <cstdint>

namespace gnomon::tests {

/// Activates random rounding during its lifetime. Only one object can exist at a time.
class ChanceRounding {
public:
    explicit ChanceRounding(std::uint64_t seed);
    ~ChanceRounding();

    ChanceRounding(const ChanceRounding&) = delete;
    ChanceRounding& operator=(const ChanceRounding&) = delete;
    ChanceRounding(ChanceRounding&&) = delete;
    ChanceRounding& operator=(ChanceRounding&&) = delete;

    /// Returns how many times a mode was set by all objects.
    static std::uint64_t count();
};

} // namespace gnomon::tests
