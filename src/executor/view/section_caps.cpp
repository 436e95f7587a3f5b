#include "executor/view/section_caps.h"

#include "executor/frame_block.h"
#include "executor/view/closed_lines.h"
#include "executor/view/lens.h"
#include "executor/view/section_cut.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::executor {

namespace {

constexpr glm::vec3 kSolid{0.71F, 0.36F, 0.24F};    // of the displayed values
constexpr glm::vec3 kOutline{0.22F, 0.10F, 0.07F};  //
constexpr glm::vec3 kOpenEdge{0.83F, 0.21F, 0.13F}; //

/// A point on the edge from `a` to `b` where a plane is met; the same for both directions.
glm::dvec3 meeting(glm::dvec3 a, double atA, glm::dvec3 b, double atB) {
    const bool isTurned = std::array{b.x, b.y, b.z} < std::array{a.x, a.y, a.z};
    if (isTurned) {
        std::swap(a, b);
        std::swap(atA, atB);
    }
    return a + (b - a) * (atA / (atA - atB));
}

glm::dvec3 cellsFrom(const hierarchy::GridPoint& origin, const hierarchy::GridPoint& p) {
    return glm::dvec3(p.x, p.y, p.z) - glm::dvec3(origin.x, origin.y, origin.z);
}

/// Appends the line in which a plane meets a triangle whose corners lie at `cells`, at these distances from it.
void addLine(
    const std::array<glm::dvec3, 3>& cells, const std::array<double, 3>& sides, std::vector<SectionLine>& lines) {
    SectionLine line;
    bool isMet = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((sides.at(i) >= 0) == (sides.at(j) >= 0)) continue;
        // Around a triangle, against the clock as seen from outside, the plane is entered once and left once.
        (sides.at(i) >= 0 ? line.from : line.to) = meeting(cells.at(i), sides.at(i), cells.at(j), sides.at(j));
        isMet = true;
    }
    if (isMet) lines.push_back(line);
}

/// Appends those in which `plane` meets a cluster's triangles.
void addLinesOf(
    const hierarchy::Page& page,
    const hierarchy::Cluster& cluster,
    const hierarchy::GridPoint& origin,
    const Plane& plane,
    std::vector<SectionLine>& lines) {
    const Box box{cellsFrom(origin, cluster.box.min), cellsFrom(origin, cluster.box.max)};
    if (classify({{plane}}, box) != Containment::Intersecting) return;
    std::array<glm::dvec3, raster::kMaxClusterVertices> cells{};
    std::array<double, raster::kMaxClusterVertices> sides{};
    for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
        cells.at(v) = cellsFrom(origin, page.vertices[cluster.firstVertex + v].position);
        sides.at(v) = plane.signedDistance(cells.at(v));
    }
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        const hierarchy::Triangle& c = page.triangles[cluster.firstTriangle + t];
        addLine(
            {cells.at(c[0]), cells.at(c[1]), cells.at(c[2])}, {sides.at(c[0]), sides.at(c[1]), sides.at(c[2])}, lines);
    }
}

/// The lines in which `plane` (cells from draw space's origin) meets the triangles of `list`.
std::vector<SectionLine> linesIn(const FrameDrawing& frame, const selection::DrawList& list, const Plane& plane) {
    std::vector<std::vector<SectionLine>> parts(list.ranges.size());
    tbb::parallel_for(std::size_t{0}, list.ranges.size(), [&](std::size_t r) {
        const selection::ClusterRange& range = list.ranges[r];
        const hierarchy::Page& page = frame.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            addLinesOf(page, page.clusters[c], frame.space.originCell, plane, parts[r]);
    });
    std::vector<SectionLine> lines;
    for (const std::vector<SectionLine>& part : parts)
        lines.insert(lines.end(), part.begin(), part.end());
    return lines;
}

Rgb byteColor(const glm::vec3& color, float light) {
    Rgb rgb{};
    for (std::size_t c = 0; c < rgb.size(); ++c)
        rgb[c] = static_cast<std::uint8_t>(std::lround(255 * light * color[static_cast<int>(c)]));
    return rgb;
}

/// The image of lines: which pixels they pass, and how often those of closed ones go around each.
class LineImage {
public:
    LineImage(const glm::dmat4& clipFromCell, int width, int height)
        : clipFromCell_(clipFromCell),
          width_(width),
          height_(height),
          windings_(width + 1, height, 0),
          kinds_(width, height, CapKind::None) {}

    void add(const SectionLine& line) {
        const glm::dvec4 a = clipFromCell_ * glm::dvec4(line.from, 1);
        const glm::dvec4 b = clipFromCell_ * glm::dvec4(line.to, 1);
        if (line.isClosed) wind(a, b);
        draw(a, b, line.isClosed ? CapKind::Outline : CapKind::OpenEdge);
    }

    /// From differences along rows to numbers.
    void sum() {
        for (int y = 0; y < height_; ++y)
            for (int x = 1; x < width_; ++x)
                windings_.at(x, y) += windings_.at(x - 1, y);
    }

    CapKind at(int x, int y) const {
        const bool isInside = windings_.at(x, y) != 0;
        const CapKind line = kinds_.at(x, y);
        if (line == CapKind::None) return isInside ? CapKind::Solid : CapKind::None;
        return isInside ? CapKind::Outline : line; // what is open within what is solid ends nothing
    }

private:
    /// Counts the line at the pixels that lie, along their row, to one side of where it meets that row. A row is a line
    /// of the section plane, of which a part may lie behind the eye: what is met there, w < 0, lies to the other side.
    void wind(const glm::dvec4& a, const glm::dvec4& b) {
        int first = 0;
        int last = height_ - 1;
        if (a.w > 0 && b.w > 0) {
            const auto rowOf = [&](const glm::dvec4& p) { return (p.y / p.w * 0.5 + 0.5) * height_; };
            const auto [low, high] = std::minmax({rowOf(a), rowOf(b)});
            first = static_cast<int>(std::clamp(low - 1, 0.0, static_cast<double>(height_)));
            last = static_cast<int>(std::clamp(high + 1, -1.0, static_cast<double>(last)));
        }
        for (int y = first; y <= last; ++y) {
            const double row = (2 * y + 1.0) / height_ - 1;
            const double atA = a.y - row * a.w;
            const double atB = b.y - row * b.w;
            if ((atA >= 0) == (atB >= 0)) continue;
            const int sign = atA >= 0 ? 1 : -1;
            const glm::dvec4 met = a + (b - a) * (atA / (atA - atB));
            if (met.w == 0) continue;
            const double column = (met.x / met.w * 0.5 + 0.5) * width_ - 0.5;
            const int beyond = static_cast<int>(std::clamp(std::ceil(column), 0.0, static_cast<double>(width_)));
            windings_.at(beyond, y) += met.w > 0 ? sign : -sign;
            if (met.w < 0) windings_.at(0, y) += sign;
        }
    }

    void draw(glm::dvec4 a, glm::dvec4 b, CapKind kind) {
        constexpr double kLeastW = 1e-9;
        const double nearest = kLeastW * std::max(std::abs(a.w), std::abs(b.w));
        if (a.w <= nearest && b.w <= nearest) return;
        if (a.w <= nearest) a = glm::mix(a, b, (nearest - a.w) / (b.w - a.w));
        if (b.w <= nearest) b = glm::mix(b, a, (nearest - b.w) / (a.w - b.w));
        const auto pixel = [&](const glm::dvec4& p) {
            return glm::dvec2((p.x / p.w * 0.5 + 0.5) * width_, (p.y / p.w * 0.5 + 0.5) * height_);
        };
        glm::dvec2 from = pixel(a);
        glm::dvec2 to = pixel(b);
        const glm::dvec2 size(width_, height_);
        double first = 0;
        double last = 1;
        for (int axis = 0; axis < 2; ++axis) { // within the image
            const double way = to[axis] - from[axis];
            double enter = (0 - from[axis]) / way;
            double leave = (size[axis] - from[axis]) / way;
            if (way == 0) {
                if (from[axis] < 0 || from[axis] >= size[axis]) return;
                continue;
            }
            if (enter > leave) std::swap(enter, leave);
            first = std::max(first, enter);
            last = std::min(last, leave);
        }
        if (!(first <= last)) return;
        const glm::dvec2 way = to - from;
        to = from + way * last;
        from += way * first;
        const int steps = static_cast<int>(std::ceil(std::max(std::abs(to.x - from.x), std::abs(to.y - from.y))));
        for (int i = 0; i <= steps; ++i) {
            const glm::dvec2 at = glm::mix(from, to, steps > 0 ? static_cast<double>(i) / steps : 0);
            const int x = std::clamp(static_cast<int>(at.x), 0, width_ - 1);
            const int y = std::clamp(static_cast<int>(at.y), 0, height_ - 1);
            kinds_.at(x, y) = std::max(kinds_.at(x, y), kind);
        }
    }

    glm::dmat4 clipFromCell_;
    int width_;
    int height_;
    Raster<int> windings_;
    Raster<CapKind> kinds_;
};

/// Where a line of sight comes in through the plane with that number: nothing where others leave nothing of it.
std::optional<double> capDepth(
    const Lens& lens, const std::vector<Plane>& planes, std::size_t plane, const glm::dvec2& at) {
    const glm::dvec3 start = lens.seenAt(at, 0);
    const glm::dvec3 way = lens.seenAt(at, 1) - start;
    const double slope = glm::dot(planes[plane].normal, way);
    const double depth = -planes[plane].signedDistance(start) / slope;
    bool isShown = slope > 0 && (lens.depth.isParallel || depth > 0);
    for (std::size_t other = 0; other < planes.size(); ++other)
        isShown = isShown && (other == plane || planes[other].signedDistance(start + way * depth) >= 0);
    return isShown ? std::optional(depth) : std::nullopt;
}

} // namespace

void drawCaps(const FrameDrawing& frame, std::span<std::uint64_t> words) {
    const plan::View& view = frame.plan->view;
    const Lens lens = lensOf(frame);
    const std::vector<Plane> inCells = sectionPlanes(frame);
    std::vector<Plane> planes; // camera space
    planes.reserve(inCells.size());
    for (const Plane& plane : inCells)
        planes.push_back(
            {toCamera(lens.basis, plane.normal), plane.offset * frame.space.step + glm::dot(plane.normal, lens.eye)});
    glm::dmat4 clipFromCell = imageClipFromDraw(frame);
    for (int axis = 0; axis < 3; ++axis)
        clipFromCell[axis] *= frame.space.step;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        std::vector<SectionLine> lines = linesIn(frame, *frame.sections[plane], inCells[plane]);
        markClosed(lines);
        LineImage image(clipFromCell, view.width, view.height);
        for (const SectionLine& line : lines)
            image.add(line);
        image.sum();
        tbb::parallel_for(0, view.height, [&](int row) {
            for (int column = 0; column < view.width; ++column) {
                const CapKind kind = image.at(column, row);
                if (kind == CapKind::None) continue;
                const glm::dvec2 at((2 * column + 1.0) / view.width - 1, (2 * row + 1.0) / view.height - 1);
                const std::optional<double> depth = capDepth(lens, planes, plane, at);
                const auto name = static_cast<std::uint32_t>(plane << 2U | static_cast<std::size_t>(kind));
                const std::size_t place = static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
                                          static_cast<std::size_t>(column);
                if (depth) words[place] = raster::visibilityWord(lens.depth.stored(*depth), kFirstCapName | name);
            }
        });
    }
}

Rgb capColor(const FrameDrawing& frame, std::uint32_t name) {
    const std::size_t plane = name >> 2U & 0x3FU;
    const glm::dvec3& normal = frame.plan->view.sections.at(plane).normal;
    const auto kind = static_cast<CapKind>(name & 3U);
    const float light = 0.75F + 0.25F * static_cast<float>(std::abs(glm::dot(normal, frame.plan->basis.view)));
    return byteColor(kind == CapKind::Solid ? kSolid : kind == CapKind::Outline ? kOutline : kOpenEdge, light);
}

} // namespace gnomon::executor
