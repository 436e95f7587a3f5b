// Moves section planes with the mouse, so that the plane under the cursor follows it. Also creates boxes of six
// sections.
#pragma once

#include "core/box.h"
#include "core/camera.h"
#include "settings/settings.h"
#include "viewer/input/steering.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// Returns six section planes around `bounds` (world space). They remove no geometry until the user moves them.
std::vector<settings::Section> sectionBox(const Box& bounds);

/// Returns a text that says where a section plane cuts a model with the bounds `bounds`.
std::string sectionInWords(const settings::Section& section, const Box& bounds);

/// A mouse drag that moves a section plane along its normal.
class SectionDrag {
public:
    /// Moves a section plane along its normal. At the start of a drag it selects the plane nearest to the surface point
    /// under the cursor, or the last plane if there is no surface. The selected point then follows the cursor, as far
    /// as the direction of the normal permits. If the camera looks along the normal, moving the cursor up moves the
    /// plane in the direction of its normal. The plane stays within `bounds`. `sections` must not be empty, and `size`
    /// is the image size in pixels.
    void drag(
        const Drag& drag,
        const DragScene& scene,
        const Camera& camera,
        const glm::ivec2& size,
        const Box& bounds,
        std::vector<settings::Section>& sections);

    /// Returns the index of the section plane that the drag moves.
    std::size_t held() const { return held_; }

private:
    double alongNormal(const glm::dvec2& cursor, const Camera& camera, const glm::ivec2& size) const;

    std::size_t held_ = 0;
    settings::Section start_;
    glm::dvec3 grip_{0};
    glm::dvec2 cursorAtStart_{0};
};

} // namespace gnomon::viewer
