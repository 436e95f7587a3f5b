// The colours of an OFF file. Their range is known only after all of them are read.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Collects the colours of vertices or of faces. Some rows can have no colour. Full intensity is 1 if no channel
/// exceeds 1, and 255 otherwise. The same rule applies separately to alpha.
class OffColors {
public:
    /// Adds the colour of row `row` with three or four channels. Rows must come in ascending order.
    void add(std::uint64_t row, std::span<const double> channels);

    /// Returns the number of rows with a colour.
    std::uint64_t count() const { return colors_.size(); }

    /// Returns true if the values can be colours: there is at least one value, and none is negative.
    bool areColors() const { return !colors_.empty() && !isBelowZero_; }

    /// Returns the number of rows whose alpha is not opaque.
    std::uint64_t clearCount() const;

    /// Returns one RGBA8 colour per row for `rows` rows. Rows without a colour are white.
    std::vector<std::uint32_t> packed(std::uint64_t rows) const;

    /// Returns a note for the user about the range of the colours of `ofWhat`. Returns an empty text for integers up to
    /// 255, which are usual.
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

/// The colours of the vertices and the faces of an OFF file.
struct OffRowColors {
    OffColors vertices;
    OffColors faces;
};

/// Returns `mesh` with the colours of its vertices or, if there are none, of its faces. `isAnnounced` says whether the
/// keyword announces vertex colours. Counts the data that are not used. Throws Error, which names `path`, if this needs
/// more memory than `memoryLimit`.
MemoryMesh withOffColors(
    MemoryMesh mesh, const OffRowColors& colors, bool isAnnounced, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
