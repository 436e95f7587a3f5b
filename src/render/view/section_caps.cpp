#include "render/view/section_caps.h"

#include "render/frame_block.h"
#include "render/view/grid_polygon.h"
#include "render/view/image_projection.h"
#include "render/view/section_cut.h"
#include "render/view/section_memory.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace gnomon::render {

namespace {

constexpr glm::vec3 kSolid{0.71F, 0.36F, 0.24F};    // displayed colour
constexpr glm::vec3 kOutline{0.22F, 0.10F, 0.07F};  // displayed colour
constexpr glm::vec3 kOpenEdge{0.83F, 0.21F, 0.13F}; // displayed colour

Rgb byteColor(const glm::vec3& color, float light) {
    Rgb rgb{};
    for (std::size_t c = 0; c < rgb.size(); ++c)
        rgb[c] = static_cast<std::uint8_t>(std::lround(255 * light * color[static_cast<int>(c)]));
    return rgb;
}

/// The intersection lines of one section plane, drawn into an image. The image stores the pixels that lines cross, and
/// the winding number of the closed lines at each pixel.
class LineImage {
public:
    LineImage(const DrawInputs& frame, const glm::dmat4& clipFromCell)
        : clipFromCell_(clipFromCell),
          originCell_(gridCellOf(frame.space.originCell)),
          width_(frame.plan->view.width),
          height_(frame.plan->view.height),
          windings_(&frame.sectionMemory->caps.windings),
          kinds_(&frame.sectionMemory->caps.kinds) {
        if (kinds_->width == width_ && kinds_->height == height_) return;
        *windings_ = {width_ + 1, height_, 0};
        *kinds_ = {width_, height_, CapKind::None};
    }

    void add(const SectionLine& line) {
        if (line.from == line.to) return; // markClosed has merged both ends of the line, so it encloses no area
        const End a = seen(line.from);
        const End b = seen(line.to);
        if (line.isClosed) wind(a, b);
        draw(a, b, line.isClosed ? CapKind::Outline : CapKind::OpenEdge);
    }

    /// Calls `use` for each pixel of row `y` that has a line or a non-zero winding number. Then the function clears the
    /// row.
    template <class Use>
    void forRow(int y, const Use& use) {
        int* changes = &windings_->at(0, y);
        CapKind* lines = &kinds_->at(0, y);
        int winding = 0;
        for (int x = 0; x < width_; ++x) {
            while (winding == 0 && x + kAtOnce <= width_ && isNothing(changes + x) && isNothing(lines + x))
                x += kAtOnce;
            if (x == width_) break;
            winding += std::exchange(changes[x], 0);
            const CapKind line = std::exchange(lines[x], CapKind::None);
            // An open line inside a solid part is drawn as an outline, and the solid part continues behind it.
            const CapKind inside = line == CapKind::None ? CapKind::Solid : CapKind::Outline;
            const CapKind kind = winding != 0 ? inside : line;
            if (kind != CapKind::None) use(x, kind);
        }
        changes[width_] = 0;
    }

private:
    static constexpr int kAtOnce = 16; // in pixels

    /// Returns true if the kAtOnce values from `values` on are all 0.
    template <class Value>
    static bool isNothing(const Value* values) {
        constexpr std::array<Value, kAtOnce> kNothing{};
        return std::memcmp(values, kNothing.data(), sizeof(kNothing)) == 0;
    }

    /// An end point of an intersection line in clip coordinates, and its image position in pixels. The image position
    /// is also defined behind the eye.
    struct End {
        glm::dvec4 clip{0};
        glm::dvec2 pixel{0};

        bool isBehind() const { return clip.w < 0; }

        /// Returns true if the end point is above `row`, the middle of a row of pixels. Such a row corresponds to a
        /// straight line in the section plane.
        bool isAbove(double row) const { return isBehind() ? pixel.y <= row : pixel.y > row; }
    };

    End seen(const glm::dvec3& cell) const {
        End end;
        end.clip = clipFromCell_ * glm::dvec4(cell - originCell_, 1);
        if (end.clip.w == 0) end.clip.w = std::numeric_limits<double>::min();
        end.pixel = (glm::dvec2(end.clip) / end.clip.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
        return end;
    }

    /// Updates the winding numbers of row `y` for a line that crosses the row at column `column`.
    void windAt(double column, int y, bool isBehind, int sign) {
        const int firstColumn = static_cast<int>(std::clamp(std::ceil(column - 0.5), 0.0, static_cast<double>(width_)));
        windings_->at(firstColumn, y) += isBehind ? -sign : sign;
        if (isBehind) windings_->at(0, y) += sign;
    }

    /// Updates the winding numbers of all pixels to one side of a line. A row of pixels corresponds to a straight line
    /// in the section plane, and a part of this line can be behind the eye. Crossings behind the eye count for the
    /// pixels on the other side.
    void wind(const End& a, const End& b) {
        if (a.isBehind() != b.isBehind()) return windThroughEyePlane(a, b);
        const auto [low, high] = std::minmax(a.pixel.y, b.pixel.y);
        const int first = static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(height_)));
        const int end = static_cast<int>(std::clamp(std::ceil(high - 0.5), 0.0, static_cast<double>(height_)));
        if (first >= end) return;
        const int sign = a.isAbove(first + 0.5) ? 1 : -1;
        const double slope = (b.pixel.x - a.pixel.x) / (b.pixel.y - a.pixel.y);
        for (int y = first; y < end; ++y)
            windAt(a.pixel.x + (y + 0.5 - a.pixel.y) * slope, y, a.isBehind(), sign);
    }

    /// Updates the winding numbers for a line of which only one end point is behind the eye.
    void windThroughEyePlane(const End& a, const End& b) {
        for (int y = 0; y < height_; ++y) {
            const bool isAbove = a.isAbove(y + 0.5);
            if (isAbove == b.isAbove(y + 0.5)) continue;
            const double row = (2 * y + 1.0) / height_ - 1;
            const double atA = a.clip.y - row * a.clip.w;
            const double atB = b.clip.y - row * b.clip.w;
            const glm::dvec4 hit = a.clip + (b.clip - a.clip) * (atA / (atA - atB));
            if (hit.w != 0) windAt((hit.x / hit.w * 0.5 + 0.5) * width_, y, hit.w < 0, isAbove ? 1 : -1);
        }
    }

    void draw(const End& a, const End& b, CapKind kind) {
        constexpr double kMinW = 1e-9;
        const double nearest = kMinW * std::max(std::abs(a.clip.w), std::abs(b.clip.w));
        if (a.clip.w <= nearest && b.clip.w <= nearest) return;
        // Clips one end of the line to the half-space in front of the eye, and returns its position in pixels.
        const auto before = [&](const End& end, const End& other) {
            if (end.clip.w > nearest) return end.pixel;
            const double way = (nearest - end.clip.w) / (other.clip.w - end.clip.w);
            const glm::dvec4 hit = glm::mix(end.clip, other.clip, way);
            return (glm::dvec2(hit) / hit.w * 0.5 + 0.5) * glm::dvec2(width_, height_);
        };
        const glm::dvec2 start = before(a, b);
        const glm::dvec2 way = before(b, a) - start;
        const glm::dvec2 size(width_, height_);
        double first = 0;
        double last = 1;
        for (int axis = 0; axis < 2; ++axis) { // clips the line to the image
            if (way[axis] == 0) {
                if (start[axis] < 0 || start[axis] >= size[axis]) return;
                continue;
            }
            const double enter = -start[axis] / way[axis];
            const double leave = (size[axis] - start[axis]) / way[axis];
            first = std::max(first, std::min(enter, leave));
            last = std::min(last, std::max(enter, leave));
        }
        if (!(first <= last)) return;
        const glm::dvec2 from = start + way * first;
        const glm::dvec2 along = way * (last - first);
        const int steps = static_cast<int>(std::ceil(std::max(std::abs(along.x), std::abs(along.y))));
        const glm::dvec2 step = along / std::max(1.0, static_cast<double>(steps));
        for (int i = 0; i <= steps; ++i) {
            const int x = std::clamp(static_cast<int>(from.x + step.x * i), 0, width_ - 1);
            const int y = std::clamp(static_cast<int>(from.y + step.y * i), 0, height_ - 1);
            kinds_->at(x, y) = std::max(kinds_->at(x, y), kind);
        }
    }

    glm::dmat4 clipFromCell_;
    glm::dvec3 originCell_;
    int width_;
    int height_;
    Raster<int>* windings_;
    Raster<CapKind>* kinds_;
};

/// Returns the depth at which a primary ray intersects section plane `plane`. Returns nullopt if other section planes
/// remove this point.
std::optional<double> capDepth(
    const ImageProjection& projection, const std::vector<Plane>& planes, std::size_t plane, const glm::dvec2& at) {
    const glm::dvec3 start = projection.visiblePoint(at, 0);
    const glm::dvec3 way = projection.visiblePoint(at, 1) - start;
    const double slope = glm::dot(planes[plane].normal, way);
    const double depth = -planes[plane].signedDistance(start) / slope;
    bool isShown = slope > 0 && (projection.depth.isParallel || depth > 0);
    for (std::size_t other = 0; other < planes.size(); ++other)
        isShown = isShown && (other == plane || planes[other].signedDistance(start + way * depth) >= 0);
    return isShown ? std::optional(depth) : std::nullopt;
}

} // namespace

void drawCaps(const DrawInputs& frame, std::span<std::uint64_t> words) {
    const plan::View& view = frame.plan->view;
    const ImageProjection projection = imageProjection(frame);
    const std::vector<Plane> inCells = sectionPlanes(frame);
    std::vector<Plane> planes; // in camera space
    planes.reserve(inCells.size());
    for (const Plane& plane : inCells)
        planes.push_back(
            {toCamera(projection.basis, plane.normal),
             plane.offset * frame.space.step + glm::dot(plane.normal, projection.eye)});
    glm::dmat4 clipFromCell = imageClipFromDraw(frame);
    for (int axis = 0; axis < 3; ++axis)
        clipFromCell[axis] *= frame.space.step;
    for (std::size_t plane = 0; plane < planes.size(); ++plane) {
        LineImage image(frame, clipFromCell);
        for (const SectionLine& line : frame.sectionMemory->lines.of(plane))
            image.add(line);
        tbb::parallel_for(0, view.height, [&](int row) {
            image.forRow(row, [&](int column, CapKind kind) {
                const glm::dvec2 at((2 * column + 1.0) / view.width - 1, (2 * row + 1.0) / view.height - 1);
                const std::optional<double> depth = capDepth(projection, planes, plane, at);
                const auto name = static_cast<std::uint32_t>(plane << 2U | static_cast<std::size_t>(kind));
                const std::size_t place = static_cast<std::size_t>(row) * static_cast<std::size_t>(view.width) +
                                          static_cast<std::size_t>(column);
                if (depth) words[place] = raster::visibilityWord(projection.depth.stored(*depth), kFirstCapName | name);
            });
        });
    }
}

Rgb capColor(const DrawInputs& frame, std::uint32_t name) {
    const std::size_t plane = name >> 2U & 0x3FU;
    const glm::dvec3& normal = frame.plan->view.sections.at(plane).normal;
    const auto kind = static_cast<CapKind>(name & 3U);
    const float light = 0.75F + 0.25F * static_cast<float>(std::abs(glm::dot(normal, frame.plan->basis.view)));
    return byteColor(kind == CapKind::Solid ? kSolid : kind == CapKind::Outline ? kOutline : kOpenEdge, light);
}

} // namespace gnomon::render
