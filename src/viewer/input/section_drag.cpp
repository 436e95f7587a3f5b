#include "viewer/input/section_drag.h"

#include "core/formatted.h"

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

namespace {

/// The range of positions of a box along a direction.
struct Reach {
    double min = 0;
    double max = 0;

    Reach(const Box& bounds, const glm::dvec3& direction) {
        const double half = 0.5 * glm::dot(glm::abs(direction), bounds.extent());
        const double middle = glm::dot(direction, bounds.center());
        min = middle - half;
        max = middle + half;
    }
};

glm::dvec3 unitNormal(const settings::Section& section) {
    return glm::normalize(section.normal);
}

double distanceOf(const settings::Section& section, const glm::dvec3& point) {
    return glm::dot(unitNormal(section), point - section.point);
}

} // namespace

std::vector<settings::Section> sectionBox(const Box& bounds) {
    // Distance of new section planes from the model's bounds, as a share of the model's size. Faces of the model on
    // its bounds thus remain uncut.
    constexpr double kAside = 1e-3;
    std::vector<settings::Section> sections;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            settings::Section section{bounds.center(), glm::dvec3(0)};
            section.normal[axis] = side;
            section.point[axis] += side * (0.5 * bounds.extent()[axis] + kAside * glm::length(bounds.extent()));
            sections.push_back(section);
        }
    return sections;
}

std::string sectionInWords(const settings::Section& section, const Box& bounds) {
    const glm::dvec3 normal = unitNormal(section);
    const Reach reach(bounds, normal);
    const double left = std::clamp(glm::dot(normal, section.point) - reach.min, 0.0, reach.max - reach.min);
    return formatted("section: %.4g of %.4g left", left, reach.max - reach.min);
}

/// Returns where a dragged section plane must go: the point nearest to the line of sight through `cursor`, on the line
/// along the plane's normal through the grabbed point. The result is the distance from the grabbed point in world
/// units.
double SectionDrag::alongNormal(const glm::dvec2& cursor, const Camera& camera, const glm::ivec2& size) const {
    constexpr double kStraightAhead = 0.02; // min squared sine between the normal and the line of sight
    const CameraBasis basis = cameraBasis(camera);
    const double depth = toCamera(basis, grip_ - camera.eye).z;
    const double high = camera.isParallel() ? halfHeightAtTarget(camera) : std::tan(camera.fovYRadians / 2) * depth;
    const double perPixel = 2 * high / std::max(size.y, 1);
    const glm::dvec3 at = camera.eye + toWorld(
                                           basis,
                                           {(cursor.x - 0.5 * size.x) * perPixel,
                                            (0.5 * size.y - cursor.y) * perPixel,
                                            depth}); // on the line of sight
    const glm::dvec3 normal = unitNormal(start_);
    const glm::dvec3 sight = camera.isParallel() ? basis.view : glm::normalize(at - camera.eye);
    const double slope = glm::dot(normal, sight);
    const double slopeAtGrip =
        camera.isParallel() ? slope : glm::dot(normal, glm::normalize(grip_ - camera.eye)); // constant during a drag
    if (1 - slopeAtGrip * slopeAtGrip < kStraightAhead) return (cursorAtStart_.y - cursor.y) * perPixel;
    return (slope * glm::dot(sight, grip_ - at) - glm::dot(normal, grip_ - at)) /
           std::max(1 - slope * slope, kStraightAhead);
}

void SectionDrag::drag(
    const Drag& drag,
    const DragScene& scene,
    const Camera& camera,
    const glm::ivec2& size,
    const Box& bounds,
    std::vector<settings::Section>& sections) {
    if (drag.hasBegun || held_ >= sections.size()) {
        const std::optional<glm::dvec3> under = scene.pick(glm::ivec2(scene.cursor));
        held_ = sections.size() - 1;
        for (std::size_t i = 0; under && i < sections.size(); ++i)
            if (std::abs(distanceOf(sections[i], *under)) < std::abs(distanceOf(sections[held_], *under))) held_ = i;
        start_ = sections[held_];
        const glm::dvec3 grip = under.value_or(camera.target);
        grip_ = under ? grip : grip - unitNormal(start_) * distanceOf(start_, grip);
        cursorAtStart_ = scene.cursor - drag.moved;
    }
    const double moved = alongNormal(scene.cursor, camera, size) - alongNormal(cursorAtStart_, camera, size);
    const glm::dvec3 normal = unitNormal(start_);
    const Reach reach(bounds, normal);
    const double at = glm::dot(normal, start_.point);
    const double aside = 1e-2 * (reach.max - reach.min);
    const double wanted = std::clamp(at + moved, reach.min - aside, reach.max + aside);
    sections[held_].point = start_.point + normal * (wanted - at);
}

} // namespace gnomon::viewer
