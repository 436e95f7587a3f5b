// Random integers with the same sequence on each machine.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <random>

namespace gnomon::exact {

class RandomWholes {
public:
    explicit RandomWholes(std::uint64_t seed) : engine_(seed) {}

    /// Returns an integer from `least` to `most`, both included.
    std::int64_t whole(std::int64_t least, std::int64_t most) {
        const auto count = static_cast<std::uint64_t>(most - least) + 1;
        return least + static_cast<std::int64_t>(engine_() % count);
    }

    double real(double least, double most) {
        return least + (most - least) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
    }

    glm::i64vec3 point(std::int64_t least, std::int64_t most) {
        const std::int64_t x = whole(least, most);
        const std::int64_t y = whole(least, most);
        return {x, y, whole(least, most)};
    }

private:
    std::mt19937_64 engine_;
};

} // namespace gnomon::exact
