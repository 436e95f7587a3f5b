// Colours of an OFF, whose range is known when all of them are.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::read {

/// Collects the colours of vertices or faces, some of which may have none.
class OffColors {
public:
    /// The colour of row `row`, which is `values` long (3 or 4 channels); `isReal` if one is written as a real number.
    void add(std::uint64_t row, std::span<const double> values, bool isReal);

    /// Rows with a colour.
    std::uint64_t count() const { return count_; }

    /// Whether they can be colours: none is below 0.
    bool areColors() const { return count_ > 0 && !isBelowZero_; }

    /// Whether channels of real numbers range to 255.
    bool areRealsBytes() const;

    /// Returns RGBA8 for each of `rows` rows, white where a row has none.
    std::vector<std::uint32_t> take(std::uint64_t rows);

private:
    struct RealColor {
        std::uint64_t row;
        glm::vec4 channels; ///< the alpha is below 0 if there is none
    };

    std::vector<std::uint32_t> packed_;
    std::vector<RealColor> reals_;
    std::uint64_t count_ = 0;
    double maxReal_ = 0;
    bool isBelowZero_ = false;
};

/// Returns whether a number is written with a point or an exponent.
inline bool isWrittenAsReal(std::string_view word) {
    return word.find_first_of(".eE") != std::string_view::npos;
}

} // namespace gnomon::read
