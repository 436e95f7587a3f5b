// The colours of an OFF file. Their numeric range is known only after all colours are read.
#pragma once

#include "core/units.h"
#include "preprocess/read/memory_source.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::read {

/// Collects the colours of all vertices or of all faces. A vertex or face can have no colour. Full intensity is 1 if no
/// channel exceeds 1, and 255 otherwise. The same rule applies separately to alpha.
class OffColors {
public:
    /// Adds the colour of vertex or face `row`. `channels` are red, green, blue and optionally alpha. Rows must come in
    /// ascending order.
    void add(std::uint64_t row, std::span<const double> channels);

    /// Returns the number of vertices or faces that have a colour.
    std::uint64_t count() const { return colors_.size(); }

    /// Returns true if the collected values can be colours: there is at least one value, and none is negative.
    bool areColors() const { return !colors_.empty() && !isBelowZero_; }

    /// Returns the number of colours that are not opaque.
    std::uint64_t clearCount() const;

    /// Returns RGBA8 colours for `rows` vertices or faces. Those without a colour become white.
    std::vector<std::uint32_t> packed(std::uint64_t rows) const;

    /// Returns a note for the user about the numeric range of the colours. `ofWhat` says whose colours they are. The
    /// note is empty for integers up to 255, which are usual.
    std::string remark(const std::string& ofWhat) const;

private:
    struct Color {
        std::uint64_t row;
        glm::vec4 channels; ///< red, green, blue and alpha; a negative alpha means "no alpha"
    };

    std::uint32_t packed(const Color& color) const;

    std::vector<Color> colors_;
    double max_ = 0; ///< max value of red, green and blue
    double maxAlpha_ = 0;
    bool isBelowZero_ = false;
    bool areIntegers_ = true;
};

/// The colours of the vertices and the faces of an OFF file.
struct OffRowColors {
    OffColors vertices;
    OffColors faces;
};

/// Returns `mesh` with vertex colours. They come from the vertices or, if no vertex has a colour, from the faces.
/// `isAnnounced` says whether the file's keyword announces vertex colours. Counts the data that are not used. Throws
/// Error, which names `path`, if this needs more memory than `memoryLimit`.
MemoryMesh withOffColors(
    MemoryMesh mesh, const OffRowColors& colors, bool isAnnounced, const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
