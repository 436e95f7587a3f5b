#include "frame/drawn_point.h"

#include "render/view/image_projection.h"
#include "render/view/section_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::frame {

namespace {

/// A line of sight through a pixel, in grid cells relative to the origin of camera-relative space. Its parameter is the
/// depth from the eye in world units.
struct SightLine {
    glm::dvec3 start{0};
    glm::dvec3 direction{0};
    double minDepth = 0;

    glm::dvec3 at(double depth) const { return start + direction * depth; }
};

SightLine sightLine(const render::DrawInputs& drawing, const glm::ivec2& pixel) {
    const render::ImageProjection projection = render::imageProjection(drawing);
    const plan::View& view = drawing.plan->view;
    const glm::dvec2 size(view.width, view.height);
    const glm::dvec2 across = (glm::dvec2(pixel) + 0.5) / size * 2.0 - 1.0;
    const glm::dvec2 point(across.x, -across.y);
    const glm::dvec3 from = projection.visiblePoint(point, 0);
    const double step = drawing.space.step;
    return {
        (projection.eye + toWorld(projection.basis, from)) / step,
        toWorld(projection.basis, projection.visiblePoint(point, 1) - from) / step,
        projection.depth.isParallel ? projection.depth.clip.near : 0};
}

/// Returns true if a line of sight may intersect a box of grid cells. The test extends the box by one cell on each
/// side, so that rounding loses no intersection.
bool mayMeet(const SightLine& line, const glm::dvec3& low, const glm::dvec3& high) {
    double near = line.minDepth;
    double far = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double slow = (low[axis] - 1 - line.start[axis]) / line.direction[axis];
        const double quick = (high[axis] + 1 - line.start[axis]) / line.direction[axis];
        if (line.direction[axis] == 0) {
            if (line.start[axis] < low[axis] - 1 || line.start[axis] > high[axis] + 1) return false;
            continue;
        }
        near = std::max(near, std::min(slow, quick));
        far = std::min(far, std::max(slow, quick));
    }
    return near <= far;
}

struct Crossing {
    double depth = 0;
    // intersection in grid cells; `corners` are also in cells, but relative to the start of the line
    glm::dvec3 point{0};
    std::array<glm::dvec3, 3> corners{};
};

/// Returns the intersection of a line of sight with a triangle, whose corners are relative to the line's start. The
/// function uses the signed volume of the line and each edge. Two triangles with a common edge compute the same volume
/// with opposite signs. Therefore no line passes between them.
std::optional<Crossing> crossing(const SightLine& line, const std::array<glm::dvec3, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::dvec3 volumes(
        glm::dot(line.direction, glm::cross(b, c)),
        glm::dot(line.direction, glm::cross(c, a)),
        glm::dot(line.direction, glm::cross(a, b)));
    const bool isInside =
        glm::all(glm::greaterThanEqual(volumes, glm::dvec3(0))) || glm::all(glm::lessThanEqual(volumes, glm::dvec3(0)));
    const double whole = volumes.x + volumes.y + volumes.z;
    if (!isInside || whole == 0) return std::nullopt;
    const glm::dvec3 onTriangle = (volumes.x * a + volumes.y * b + volumes.z * c) / whole;
    const double depth = glm::dot(onTriangle, line.direction) / glm::dot(line.direction, line.direction);
    if (!(depth >= line.minDepth)) return std::nullopt;
    return Crossing{depth, line.start + onTriangle, corners};
}

/// Finds the first intersection of a line of sight with the drawn clusters. Parts that section planes remove do not
/// count.
class FirstCrossing {
public:
    FirstCrossing(const SightLine& line, const render::DrawInputs& drawing)
        : line_(line),
          sections_(render::sectionPlanes(drawing)),
          origin_(drawing.space.originCell.x, drawing.space.originCell.y, drawing.space.originCell.z) {}

    void add(const hierarchy::Page& page, const hierarchy::Cluster& cluster, double snapError) {
        if (!mayMeet(line_, placeOf(cluster.box.min), placeOf(cluster.box.max))) return;
        for (std::uint32_t i = 0; i < cluster.triangleCount; ++i) {
            std::array<glm::dvec3, 3> corners{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = cluster.firstVertex + page.triangles[cluster.firstTriangle + i][corner];
                corners[corner] = placeOf(page.vertices[vertex].position) - line_.start;
            }
            const std::optional<Crossing> found = crossing(line_, corners);
            if (!found || (first_ && first_->depth <= found->depth) || !isKept(found->point)) continue;
            first_ = found;
            error_ = cluster.refinement == hierarchy::kNone ? snapError : page.refinements[cluster.refinement].error;
        }
    }

    const std::optional<Crossing>& first() const { return first_; }

    /// Returns the max distance between the intersected cluster and the source mesh, in world units: the stored error,
    /// or on level 0 the error by rounding to the grid.
    double error() const { return error_; }

    /// Returns the line parameter at which the line enters the region that no section plane removes. Returns nullopt if
    /// the line starts in this region.
    std::optional<double> entry() const {
        std::optional<double> last;
        for (const Plane& plane : sections_) {
            const double along = glm::dot(plane.normal, line_.direction);
            const double depth = along > 0 ? -plane.signedDistance(line_.start) / along : line_.minDepth;
            if (depth > last.value_or(line_.minDepth)) last = depth;
        }
        return last;
    }

    glm::i64vec3 cell(const glm::dvec3& point) const { return glm::i64vec3(origin_) + glm::i64vec3(glm::round(point)); }

private:
    glm::dvec3 placeOf(const hierarchy::GridPoint& point) const {
        return glm::dvec3(point.x, point.y, point.z) - origin_;
    }

    bool isKept(const glm::dvec3& point) const {
        return std::all_of(
            sections_.begin(), sections_.end(), [&](const Plane& plane) { return plane.signedDistance(point) >= 0; });
    }

    SightLine line_;
    std::vector<Plane> sections_;
    glm::dvec3 origin_;
    std::optional<Crossing> first_;
    double error_ = 0;
};

/// Returns the corner of the intersected triangle that is nearest to the intersection, in grid cells.
glm::dvec3 nearestCorner(const Crossing& crossing, const SightLine& line) {
    const glm::dvec3 point = crossing.point - line.start;
    return line.start +
           *std::min_element(crossing.corners.begin(), crossing.corners.end(), [&](const auto& a, const auto& b) {
               return glm::length(a - point) < glm::length(b - point);
           });
}

} // namespace

std::optional<DrawnPoint> drawnPoint(
    const Renderer& renderer, const PreparedFrame& frame, const FrameOptions& options, const glm::ivec2& pixel) {
    const render::DrawInputs drawing = renderer.drawing(frame, options);
    const SightLine line = sightLine(drawing, pixel);
    const double snapError = drawing.grid.snapError();
    const hierarchy::ResidentPages resident = renderer.residency().resident();
    FirstCrossing found(line, drawing);
    for (const lod::ClusterRange& range : drawing.image->ranges) {
        const hierarchy::Page* page = resident[range.page];
        if (page == nullptr) return std::nullopt;
        for (std::uint32_t i = 0; i < range.clusterCount; ++i)
            found.add(*page, page->clusters[range.firstCluster + i], snapError);
    }
    const std::optional<double> entry = found.entry();
    if (entry) { // no triangle covers the cap of a section, so the depth buffer tells whether the pixel shows the cap
        const float seen = renderer.backend().viewDepth().at(pixel.x, pixel.y);
        const double depth = *entry - frame.plan.view.eyeMovedBack.value_or(0);
        if (std::abs(seen - depth) <= 1e-5 * std::abs(*entry))
            return DrawnPoint{{found.cell(line.at(*entry)), snapError}, std::nullopt};
    }
    if (!found.first()) return std::nullopt;
    DrawnPoint point;
    point.point = {found.cell(found.first()->point), found.error() + snapError};
    point.vertex = GridPlace{found.cell(nearestCorner(*found.first(), line)), found.error()};
    return point;
}

} // namespace gnomon::frame
