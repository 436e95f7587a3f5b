// Random integers with the same sequence on each machine.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <random>

namespace gnomon::exact {

class RandomWholes {
public:
    explicit RandomWholes(std::uint64_t seed) : engine_(seed) {}

    /// Returns an integer from `min` to `max`, both included.
    std::int64_t whole(std::int64_t min, std::int64_t max) {
        const auto count = static_cast<std::uint64_t>(max - min) + 1;
        return min + static_cast<std::int64_t>(engine_() % count);
    }

    double real(double min, double max) { return min + (max - min) * static_cast<double>(engine_() >> 11U) * 0x1p-53; }

    glm::i64vec3 point(std::int64_t min, std::int64_t max) {
        const std::int64_t x = whole(min, max);
        const std::int64_t y = whole(min, max);
        return {x, y, whole(min, max)};
    }

private:
    std::mt19937_64 engine_;
};

} // namespace gnomon::exact
