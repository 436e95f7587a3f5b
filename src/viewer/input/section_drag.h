// Section planes by mouse and key: the one under the cursor follows it, and a box of six.
#pragma once

#include "core/box.h"
#include "core/camera.h"
#include "settings/settings.h"
#include "viewer/input/steering.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// Six sections around `bounds` (world space), which cut nothing off until they are moved.
std::vector<settings::Section> sectionBox(const Box& bounds);

/// What a section cuts off a model within `bounds`, for people.
std::string sectionInWords(const settings::Section& section, const Box& bounds);

/// The drag of a section plane along its normal.
class SectionDrag {
public:
    /// Where a drag begins, takes hold of the plane that is nearest to what is under the cursor, or of the last one;
    /// then moves it so that what was taken hold of stays under the cursor, as far as the normal leads there. A plane
    /// seen from straight ahead moves towards its normal as the cursor moves up. It stays within `bounds`.
    /// `sections` are not empty, `size` is that of the picture in pixels.
    void drag(
        const Drag& drag,
        const DragScene& scene,
        const Camera& camera,
        const glm::ivec2& size,
        const Box& bounds,
        std::vector<settings::Section>& sections);

    /// The plane that is held, by its place.
    std::size_t held() const { return held_; }

private:
    double alongNormal(const glm::dvec2& cursor, const Camera& camera, const glm::ivec2& size) const;

    std::size_t held_ = 0;
    settings::Section start_;
    glm::dvec3 grip_{0};
    glm::dvec2 cursorAtStart_{0};
};

} // namespace gnomon::viewer
