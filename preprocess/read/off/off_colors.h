// The colours of an OFF, whose range is known only after all of them are read.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Collects the colours of vertices or of faces; some rows can have none. Channels range to 1 if no channel exceeds 1,
/// else to 255. The same rule applies to alphas separately.
class OffColors {
public:
    /// Adds the colour of row `row` with three or four channels. Rows must come in ascending order.
    void add(std::uint64_t row, std::span<const double> channels);

    /// Returns the number of rows with a colour.
    std::uint64_t count() const { return colors_.size(); }

    /// Returns whether the values can be colours: there is at least one, and none is negative.
    bool areColors() const { return !colors_.empty() && !isBelowZero_; }

    /// Returns the number of rows whose alpha is not opaque.
    std::uint64_t clearCount() const;

    /// Returns RGBA8 for each of `rows` rows, white if a row has no colour.
    std::vector<std::uint32_t> packed(std::uint64_t rows) const;

    /// Returns the range of the colours `ofWhat` in words, for the user. Returns an empty text for the usual integers,
    /// which range to 255.
    std::string remark(const std::string& ofWhat) const;

private:
    struct Color {
        std::uint64_t row;
        glm::vec4 channels; ///< the alpha is negative if there is none
    };

    std::uint32_t packed(const Color& color) const;

    std::vector<Color> colors_;
    double max_ = 0; ///< of red, green and blue
    double maxAlpha_ = 0;
    bool isBelowZero_ = false;
    bool areIntegers_ = true;
};

/// The colours of the rows of an OFF.
struct OffRowColors {
    OffColors vertices;
    OffColors faces;
};

/// Returns `mesh` with the colours of vertices or, if there are none, of faces. `isAnnounced` means that the keyword
/// announces vertex colours. Counts the data that is not used. Throws Error, which names `path`, if this needs more
/// than `memoryLimit`.
MemoryMesh withOffColors(
    MemoryMesh mesh, const OffRowColors& colors, bool isAnnounced, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
