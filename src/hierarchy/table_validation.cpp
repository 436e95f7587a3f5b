#include "hierarchy/page_fields.h"
#include "hierarchy/validation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace gnomon::hierarchy {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The max radius and centre coordinate of bounding spheres in a valid model, in grid steps. Spheres grow from level to
/// level, but never by so much.
constexpr double kMaxSphereSteps = 0x1p44;

std::string found(const std::string& what, const std::string& expected, const std::string& found) {
    return what + ": expected " + expected + ", found " + found;
}

std::string numberText(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", value);
    return text.data();
}

/// Returns true if `value` is in [min, max]. Returns false for NaN.
template <class T>
bool isWithin(T value, T min, T max) {
    return value >= min && value <= max;
}

std::optional<std::string> countFault(
    const char* what, std::uint32_t count, std::uint32_t clusters, std::uint32_t maxPerCluster) {
    const std::uint64_t max = std::uint64_t{clusters} * maxPerCluster;
    if (isWithin<std::uint64_t>(count, clusters, max)) return {};
    return found(
        std::string(what) + " of " + std::to_string(clusters) + " clusters",
        std::to_string(clusters) + " to " + std::to_string(max),
        std::to_string(count));
}

std::optional<std::string> boxFault(const GridBox& box) {
    const std::array<std::array<std::uint32_t, 2>, 3> axes = {
        {{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}}};
    for (std::size_t k = 0; k < axes.size(); ++k)
        if (axes[k][0] > axes[k][1] || axes[k][1] > kMaxGridCoordinate)
            return found(
                std::string("its box along ") + "xyz"[k],
                "least <= greatest <= " + std::to_string(kMaxGridCoordinate),
                std::to_string(axes[k][0]) + " and " + std::to_string(axes[k][1]));
    return {};
}

std::optional<std::string> boundsFault(const PageInfo& info, const Grid& grid) {
    const glm::dvec3& c = info.bounds.center;
    const double reach = std::abs(c.x) + std::abs(c.y) + std::abs(c.z) + info.bounds.radius;
    const double max = kMaxSphereSteps * grid.step();
    if (!(info.bounds.radius >= 0) || !(reach <= max))
        return found(
            "its bounds",
            "a sphere within " + numberText(max) + " of the grid's origin",
            "one to " + numberText(reach));
    if (!(info.minError >= 0) || !(info.maxError >= info.minError))
        return found(
            "its errors", "0 <= least <= greatest", numberText(info.minError) + " and " + numberText(info.maxError));
    return {};
}

/// Returns true if the box `outer` contains the box `inner`. `slack` is the tolerance per axis.
bool holds(const Box& outer, const Box& inner, const glm::dvec3& slack) {
    for (int k = 0; k < 3; ++k)
        if (!(inner.min[k] >= outer.min[k] - slack[k]) || !(inner.max[k] <= outer.max[k] + slack[k])) return false;
    return true;
}

/// Returns the max difference between world positions that were rounded in different ways. It is one grid step plus the
/// rounding error of doubles.
glm::dvec3 roundingOf(const Grid& grid, const Box& bounds) {
    const glm::dvec3 far = glm::max(glm::abs(grid.origin), glm::max(glm::abs(bounds.min), glm::abs(bounds.max)));
    return glm::dvec3(grid.step()) + far * 1e-12;
}

std::string boxText(const Box& box) {
    std::string text;
    for (const glm::dvec3& p : {box.min, box.max})
        text += (text.empty() ? "" : " to ") + numberText(p.x) + "," + numberText(p.y) + "," + numberText(p.z);
    return text;
}

std::string pageName(std::size_t page) {
    return "page " + std::to_string(page) + ": ";
}

} // namespace

std::uint64_t maxPlainBytes(const PageInfo& info) {
    constexpr std::uint64_t kIndex = 5; // a varint of 32 bits, with seven bits per byte
    constexpr std::uint64_t kSphereAndErrors = 6 * sizeof(double);
    constexpr std::uint64_t kVertex =
        // Bytes of a vertex: the 32-bit words of its reference, position, normal, colour and fields.
        (1 + 3 + 2 + 4 + 4) * sizeof(std::uint32_t);
    constexpr std::uint64_t kTriangle = 1 + 3; // a code byte and three indices
    // Bytes of a cluster: its counts, its refinement, and its anchor (the position of its first vertex).
    constexpr std::uint64_t kCluster = 2 + kIndex + 3 * kIndex;
    constexpr std::uint64_t kRest = 64; // bytes for sizes of streams and numbers of planes
    return info.groupCount * (kIndex + kSphereAndErrors) + info.refinementCount * (2 * kIndex + kSphereAndErrors) +
           info.clusterCount * kCluster + info.vertexCount * kVertex + info.triangleCount * kTriangle + kRest;
}

std::optional<std::string> countsFault(const PageInfo& info) {
    if (info.level >= kMaxLevels)
        return found("its level", "less than " + std::to_string(kMaxLevels), std::to_string(info.level));
    if (!isWithin(info.groupCount, 1U, info.clusterCount))
        return found(
            "groups of " + std::to_string(info.clusterCount) + " clusters",
            "1 to as many",
            std::to_string(info.groupCount));
    if (auto fault = countFault("vertices", info.vertexCount, info.clusterCount, kMaxClusterVertices)) return fault;
    if (auto fault = countFault("triangles", info.triangleCount, info.clusterCount, kMaxClusterTriangles)) return fault;
    if ((info.level == 0) != (info.refinementCount == 0))
        return found(
            "refinements at level " + std::to_string(info.level),
            info.level == 0 ? "none" : "at least one",
            std::to_string(info.refinementCount));
    if (const std::uint64_t bytes = decodedPageBytes(info); bytes > kMaxPageBytes)
        return found("its bytes once decoded", "at most " + std::to_string(kMaxPageBytes), std::to_string(bytes));
    constexpr std::uint64_t kPackingAndSize = 11;
    if (const std::uint64_t max = maxPlainBytes(info) + kPackingAndSize; info.storedBytes > max)
        return found(
            "its stored bytes", "at most " + std::to_string(max) + " for its counts", std::to_string(info.storedBytes));
    return {};
}

std::optional<std::string> rowFault(const PageInfo& info, const Grid& grid) {
    if (auto fault = countsFault(info)) return fault;
    if (auto fault = boxFault(info.box)) return fault;
    if (auto fault = boundsFault(info, grid)) return fault;
    const std::size_t children = info.children.size();
    if (children > info.refinementCount || (children == 0) != (info.level == 0))
        return found(
            "pages that its " + std::to_string(info.refinementCount) + " refinements name",
            info.level == 0 ? "none" : "1 to as many",
            std::to_string(children));
    return {};
}

std::optional<std::string> summaryFault(const ModelSummary& summary) {
    const Grid& grid = summary.grid;
    if (!isWithin(grid.stepExponent, kMinStepExponent, kMaxStepExponent))
        return found(
            "the grid's step, a power of two",
            std::to_string(kMinStepExponent) + " to " + std::to_string(kMaxStepExponent),
            std::to_string(grid.stepExponent));
    const Box space{glm::dvec3(-kMaxCoordinate), glm::dvec3(kMaxCoordinate)};
    if (!holds(space, {grid.origin, grid.origin}, glm::dvec3(0)))
        return found(
            "the grid's origin",
            "a point within " + numberText(kMaxCoordinate) + " of 0",
            boxText({grid.origin, grid.origin}));
    const Box& bounds = summary.bounds;
    const Box reach{grid.origin, grid.world({kMaxGridCoordinate, kMaxGridCoordinate, kMaxGridCoordinate})};
    const bool isBox = bounds.min.x <= bounds.max.x && bounds.min.y <= bounds.max.y && bounds.min.z <= bounds.max.z;
    if (!isBox || !holds(reach, bounds, roundingOf(grid, reach)))
        return found("the bounds", "a box on the grid, from " + boxText(reach), boxText(bounds));
    if (!isWithin<std::size_t>(summary.levels.size(), 1, kMaxLevels))
        return found("levels", "1 to " + std::to_string(kMaxLevels), std::to_string(summary.levels.size()));
    std::uint32_t fieldBits = 0; // sum over the first kMaxFields fields only, so it cannot overflow
    for (std::size_t field = 0; field < std::min(summary.fields.size(), kMaxFields); ++field)
        fieldBits += summary.fields[field].bits;
    if (summary.fields.size() > kMaxFields || fieldBits > 32)
        return found(
            "fields",
            "at most " + std::to_string(kMaxFields) + " of 32 bits together",
            std::to_string(summary.fields.size()) + " of " + std::to_string(fieldBits));
    return {};
}

std::optional<std::string> modelFault(std::span<const PageInfo> pages, const ModelSummary& summary) {
    if (pages.empty()) return found("pages", "at least 1", "none");
    const std::uint64_t levels = std::uint64_t{pages.front().level} + 1;
    if (summary.levels.size() != levels || pages.back().level != 0)
        return found(
            "levels of the pages",
            std::to_string(summary.levels.size()) + " down to level 0, as the summary says",
            std::to_string(levels) + " down to level " + std::to_string(pages.back().level));
    bool hasRoot = false;
    for (std::size_t page = 0; page < pages.size(); ++page) {
        hasRoot = hasRoot || pages[page].maxError == kInfinite;
        if (pages[page].level > 0) continue;
        const Box local = summary.grid.local(pages[page].box);
        const Box world{summary.grid.origin + local.min, summary.grid.origin + local.max};
        if (!holds(summary.bounds, world, roundingOf(summary.grid, summary.bounds)))
            return found(
                pageName(page) + "its box in the world",
                "one in the summary's bounds, " + boxText(summary.bounds),
                boxText(world));
    }
    if (!hasRoot) return found("pages with a root group, whose error is infinite", "at least 1", "none");
    return {};
}

std::optional<std::string> drawingFault(std::span<const PageInfo> pages, const Grid& grid) {
    // The exponent of the smallest normal float.
    constexpr int kMinExponent = std::numeric_limits<float>::min_exponent - 1;
    constexpr double kMaxExtent = 0x1p62;
    if (grid.stepExponent < kMinExponent)
        return found(
            "too small to be drawn: the grid's step, a power of two",
            "at least " + std::to_string(kMinExponent),
            std::to_string(grid.stepExponent));
    for (std::size_t page = 0; page < pages.size(); ++page) {
        const glm::dvec3 far = grid.local(pages[page].box.max);
        const double extent = std::max({far.x, far.y, far.z});
        if (extent > kMaxExtent)
            return found(
                "too large to be drawn: " + pageName(page) + "distance from the grid's origin",
                "at most " + numberText(kMaxExtent),
                numberText(extent));
    }
    return {};
}

} // namespace gnomon::hierarchy
