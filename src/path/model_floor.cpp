#include "path/model_floor.h"

#include "core/error.h"
#include "core/formatted.h"
#include "hierarchy/main_part.h"
#include "hierarchy/upright_frame.h"
#include "path/drawn_triangles.h"

#include <cmath>

namespace gnomon::path {

namespace {

constexpr std::uint64_t kMaxTriangles = 12'000'000;

/// Refines all groups of clusters that intersect a region and have an error larger than `error`.
struct RegionRule {
    Box region; // local space
    double error = 0;

    bool operator()(double groupError, const Sphere& bounds) const {
        return groupError > error && distance(region, bounds.center) <= bounds.radius;
    }
};

std::uint64_t trianglesRead(const hierarchy::ModelFile& model, const RegionRule& isRefined) {
    std::uint64_t count = 0;
    for (const hierarchy::PageInfo& info : model.pages())
        if (isRefined(info.maxError, info.bounds)) count += info.triangleCount;
    return count;
}

/// A summed-area table over the columns of a grid (Crow 1984).
class SummedArea {
public:
    SummedArea(const ColumnGrid& grid, const std::vector<double>& values)
        : width_(static_cast<std::size_t>(grid.width)),
          sums_((width_ + 1) * (static_cast<std::size_t>(grid.depth) + 1), 0) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const std::size_t x = i % width_;
            const std::size_t z = i / width_;
            sums_[at(x + 1, z + 1)] = values[i] + sums_[at(x, z + 1)] + sums_[at(x + 1, z)] - sums_[at(x, z)];
        }
    }

    double sum(const glm::ivec2& first, const glm::ivec2& end) const {
        const glm::uvec2 a(first);
        const glm::uvec2 b(end);
        return sums_[at(b.x, b.y)] - sums_[at(a.x, b.y)] - sums_[at(b.x, a.y)] + sums_[at(a.x, a.y)];
    }

private:
    std::size_t at(std::size_t x, std::size_t z) const { return z * (width_ + 1) + x; }

    std::size_t width_;
    std::vector<double> sums_;
};

struct Window {
    glm::ivec2 first{0};
    double worth = 0;
    double fromMiddle = 0;
};

std::vector<double> worthOfColumns(const WalkableFloor& floor, const HeightBand& band) {
    std::vector<double> worth(floor.grid().columnCount(), 0);
    for (std::uint32_t i = 0; i < floor.cells().size(); ++i) {
        const FloorCell& cell = floor.cells()[i];
        if (!band.holds(floor.height(cell.floor))) continue;
        const bool isNearObjects = floor.isWalkable(i) && floor.clearance(i) < 2 * floor.body().eyeHeight;
        worth[cell.column] += 1 + (floor.isWalkable(i) && floor.isInside(i) ? 3 : 0) + (isNearObjects ? 1 : 0);
    }
    return worth;
}

} // namespace

Box uprightBounds(const hierarchy::ModelFile& model) {
    return hierarchy::uprightBox(
        hierarchy::uprightFrame(model.summary().up.direction), hierarchy::mainPartOf(model.summary()));
}

WalkableFloor floorOf(const hierarchy::ModelFile& model, const Box& region, const WalkBody& body, double cell) {
    const ColumnGrid grid(region, cell, std::min(0.2 * cell, 0.06 * body.eyeHeight));
    if (region.extent().y / grid.rise > 1e9)
        throw Error(
            model.path(),
            "the eye height is too small for the height of the model",
            formatted("at least %g", body.eyeHeight * (region.extent().y / grid.rise / 1e9)),
            formatted("%g", body.eyeHeight));
    const glm::dvec3 origin = model.summary().grid.origin;
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(model.summary().up.direction);
    const Box world = hierarchy::worldBox(frame, region);
    RegionRule isRefined{{world.min - origin, world.max - origin}, 0.2 * cell};
    while (trianglesRead(model, isRefined) > kMaxTriangles)
        isRefined.error *= 1.5;
    SolidSpans solid(grid, static_cast<std::int32_t>(body.headroom / grid.rise), isRefined.error);
    forEachTriangle(model, isRefined, [&](const TriangleCorners& corners) {
        solid.add({frame.toUpright(corners[0]), frame.toUpright(corners[1]), frame.toUpright(corners[2])});
    });
    return {solid, body};
}

std::vector<Box> bestRegions(const WalkableFloor& coarse, const HeightBand& band, double side, std::size_t count) {
    const ColumnGrid& grid = coarse.grid();
    const SummedArea area(grid, worthOfColumns(coarse, band));
    const glm::ivec2 size(grid.width, grid.depth);
    const glm::ivec2 window = glm::min(size, glm::ivec2(std::max(1, static_cast<int>(side / grid.cell))));
    const int stride = std::max(1, std::max(window.x, window.y) / 8);
    std::vector<Window> windows;
    for (int z = 0; z <= size.y - window.y; z += stride)
        for (int x = 0; x <= size.x - window.x; x += stride) {
            const glm::ivec2 first(x, z);
            const glm::dvec2 off = glm::dvec2(first) + 0.5 * glm::dvec2(window) - 0.5 * glm::dvec2(size);
            windows.push_back({first, area.sum(first, first + window), glm::length(off)});
        }
    std::stable_sort(windows.begin(), windows.end(), [](const Window& a, const Window& b) {
        return a.worth != b.worth ? a.worth > b.worth : a.fromMiddle < b.fromMiddle;
    });
    std::vector<Window> kept;
    for (const Window& next : windows) {
        const auto isOver = [&](const Window& other) {
            return glm::all(glm::lessThan(glm::abs(other.first - next.first), window));
        };
        if (next.worth <= 0 || kept.size() == count) break;
        if (std::none_of(kept.begin(), kept.end(), isOver)) kept.push_back(next);
    }
    std::vector<Box> regions;
    for (const Window& each : kept) {
        const glm::dvec2 middle = (glm::dvec2(each.first) + 0.5 * glm::dvec2(window)) * grid.cell;
        const glm::dvec2 half = 0.5 * glm::min(glm::dvec2(window) * grid.cell, glm::dvec2(side));
        const glm::dvec3 center = grid.origin + glm::dvec3(middle.x, 0, middle.y);
        regions.push_back({center - glm::dvec3(half.x, 0, half.y), center + glm::dvec3(half.x, 0, half.y)});
    }
    return regions;
}

} // namespace gnomon::path
