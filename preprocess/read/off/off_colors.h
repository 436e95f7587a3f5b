// Colours of an OFF: their range is known when all of them are read.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Collects the colours of vertices or faces, some of which may have none. One rule holds for all of them: channels
/// range to 1 if no channel exceeds 1, else to 255. The same rule holds for the alphas by themselves.
class OffColors {
public:
    /// Adds the colour of row `row`: three channels, or four. Rows come in ascending order.
    void add(std::uint64_t row, std::span<const double> channels);

    /// The number of rows with a colour.
    std::uint64_t count() const { return colors_.size(); }

    /// Returns whether they can be colours: none is below 0.
    bool areColors() const { return !colors_.empty() && !isBelowZero_; }

    /// The number of rows whose alpha is not opaque.
    std::uint64_t clearCount() const;

    /// Returns RGBA8 for each of `rows` rows, white if a row has no colour.
    std::vector<std::uint32_t> packed(std::uint64_t rows) const;

    /// Returns the range in words; an empty text for the usual integers, which range to 255.
    std::string remark(const std::string& ofWhat) const;

private:
    struct Color {
        std::uint64_t row;
        glm::vec4 channels; ///< the alpha is below 0 if there is none
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

/// Returns `mesh` with its colours: those of vertices, else those of faces. `isAnnounced` says that the keyword
/// announces colours of vertices. Counts the data that is not kept. Throws Error, which names `path`, if that takes
/// more than `memoryLimit`.
MemoryMesh withOffColors(
    MemoryMesh mesh, const OffRowColors& colors, bool isAnnounced, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
