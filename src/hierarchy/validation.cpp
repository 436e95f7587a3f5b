#include "hierarchy/validation.h"

#include <cmath>

namespace gnomon::hierarchy {

namespace {

constexpr double kRounding = 1e-9;

bool isFinite(const Sphere& sphere) {
    return std::isfinite(sphere.center.x) && std::isfinite(sphere.center.y) && std::isfinite(sphere.center.z) &&
           std::isfinite(sphere.radius) && sphere.radius >= 0;
}

bool isLength(double value) {
    return std::isfinite(value) && value >= 0;
}

bool same(const GridBox& a, const GridBox& b) {
    return a.min == b.min && a.max == b.max;
}

std::string place(const char* kind, std::size_t index) {
    return std::string(kind) + " " + std::to_string(index) + " ";
}

std::optional<std::string> refinementFault(const Page& page) {
    for (std::size_t i = 0; i < page.refinements.size(); ++i) {
        const Refinement& refinement = page.refinements[i];
        if (!isFinite(refinement.bounds)) return place("refinement", i) + "has bounds that are no sphere";
        if (!isLength(refinement.error) || !isLength(refinement.attributeError))
            return place("refinement", i) + "has an error that is no length";
    }
    return {};
}

std::optional<std::string> clusterFault(const Page& page, std::size_t index) {
    const Cluster& cluster = page.clusters[index];
    if (cluster.vertexCount == 0 || cluster.vertexCount > kMaxClusterVertices)
        return place("cluster", index) + "has " + std::to_string(cluster.vertexCount) + " vertices";
    if (cluster.triangleCount == 0 || cluster.triangleCount > kMaxClusterTriangles)
        return place("cluster", index) + "has " + std::to_string(cluster.triangleCount) + " triangles";
    if (cluster.vertexCount > page.vertices.size() - cluster.firstVertex)
        return place("cluster", index) + "reaches past the last vertex";
    if (cluster.triangleCount > page.triangles.size() - cluster.firstTriangle)
        return place("cluster", index) + "reaches past the last triangle";
    const bool finest = page.level == 0;
    if (finest ? cluster.refinement != kNone : cluster.refinement >= page.refinements.size())
        return place("cluster", index) + "names no refinement of its page";
    GridBox box;
    for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
        box.add(page.vertices[cluster.firstVertex + v].position);
    if (!same(box, cluster.box)) return place("cluster", index) + "has a box that is not that of its vertices";
    if (std::max({box.max.x, box.max.y, box.max.z}) > kMaxGridCoordinate)
        return place("cluster", index) + "leaves the grid";
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
        for (const std::uint8_t corner : page.triangles[cluster.firstTriangle + t])
            if (corner >= cluster.vertexCount) return place("cluster", index) + "has a corner that is no vertex of it";
    return {};
}

std::optional<std::string> groupFault(const Page& page, std::size_t index) {
    const Group& group = page.groups[index];
    if (group.clusterCount == 0 || group.clusterCount > page.clusters.size() - group.firstCluster)
        return place("group", index) + "reaches past the last cluster";
    if (!isFinite(group.bounds)) return place("group", index) + "has bounds that are no sphere";
    if (std::isnan(group.error) || group.error < 0 || !isLength(group.attributeError))
        return place("group", index) + "has an error that is no length";
    GridBox box;
    for (std::uint32_t c = 0; c < group.clusterCount; ++c)
        box.add(page.clusters[group.firstCluster + c].box);
    if (!same(box, group.box)) return place("group", index) + "has a box that is not that of its clusters";
    return {};
}

/// Returns a description of the first gap or overlap in the ranges of clusters and groups of a page, or nullopt if
/// there is none. Without gaps, a page contains no hidden bytes.
std::optional<std::string> tilingFault(const Page& page) {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < page.clusters.size(); ++i) {
        const Cluster& cluster = page.clusters[i];
        if (cluster.firstVertex != vertices || cluster.firstTriangle != triangles)
            return place("cluster", i) + "does not begin where the one before ends";
        vertices += cluster.vertexCount;
        triangles += cluster.triangleCount;
        if (vertices > page.vertices.size() || triangles > page.triangles.size())
            return place("cluster", i) + "reaches past the end";
    }
    if (vertices != page.vertices.size() || triangles != page.triangles.size())
        return "vertices or triangles belong to no cluster";
    std::uint64_t clusters = 0;
    for (std::size_t i = 0; i < page.groups.size(); ++i) {
        if (page.groups[i].firstCluster != clusters)
            return place("group", i) + "does not begin where the one before ends";
        clusters += page.groups[i].clusterCount;
        if (clusters > page.clusters.size()) return place("group", i) + "reaches past the end";
    }
    if (clusters != page.clusters.size()) return "a cluster has no group";
    return {};
}

} // namespace

bool encloses(const Sphere& outer, const Sphere& inner) {
    const double reach = glm::length(inner.center - outer.center) + inner.radius;
    return reach <= outer.radius + kRounding * (outer.radius + glm::length(outer.center) * 1e-3);
}

bool encloses(const Sphere& outer, const Box& inner) {
    const glm::dvec3 furthest = glm::max(glm::abs(inner.min - outer.center), glm::abs(inner.max - outer.center));
    return encloses(outer, Sphere{outer.center, glm::length(furthest)});
}

Sphere enclosingSphere(std::span<const Sphere> spheres) {
    Box box;
    for (const Sphere& sphere : spheres) {
        box.add(sphere.center - glm::dvec3(sphere.radius));
        box.add(sphere.center + glm::dvec3(sphere.radius));
    }
    Sphere result;
    if (box.isEmpty()) return result;
    result.center = box.center();
    for (const Sphere& sphere : spheres)
        result.radius = std::max(result.radius, glm::length(sphere.center - result.center) + sphere.radius);
    return result;
}

std::optional<std::string> pageFault(const Page& page) {
    if (page.groups.empty()) return "no group";
    if (auto fault = tilingFault(page)) return fault;
    if (auto fault = refinementFault(page)) return fault;
    for (std::size_t i = 0; i < page.clusters.size(); ++i)
        if (auto fault = clusterFault(page, i)) return fault;
    for (std::size_t i = 0; i < page.groups.size(); ++i)
        if (auto fault = groupFault(page, i)) return fault;
    return {};
}

std::vector<std::uint32_t> childPages(const Page& page) {
    std::vector<std::uint32_t> children;
    for (const Refinement& refinement : page.refinements)
        children.push_back(refinement.group.page);
    std::sort(children.begin(), children.end());
    children.erase(std::unique(children.begin(), children.end()), children.end());
    return children;
}

PageInfo describePage(const Page& page) {
    PageInfo info;
    info.level = page.level;
    info.groupCount = static_cast<std::uint32_t>(page.groups.size());
    info.clusterCount = static_cast<std::uint32_t>(page.clusters.size());
    info.refinementCount = static_cast<std::uint32_t>(page.refinements.size());
    info.vertexCount = static_cast<std::uint32_t>(page.vertices.size());
    info.triangleCount = static_cast<std::uint32_t>(page.triangles.size());
    std::vector<Sphere> spheres;
    spheres.reserve(page.groups.size());
    info.minError = std::numeric_limits<double>::infinity();
    for (const Group& group : page.groups) {
        info.box.add(group.box);
        spheres.push_back(group.bounds);
        info.minError = std::min(info.minError, group.drawnError());
        info.maxError = std::max(info.maxError, group.drawnError());
    }
    info.bounds = enclosingSphere(spheres);
    info.children = childPages(page);
    return info;
}

} // namespace gnomon::hierarchy
