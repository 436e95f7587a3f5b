#include "preprocess/levels/page_layout.h"

#include "core/check.h"
#include "hierarchy/codec/cluster_order.h"
#include "preprocess/levels/local_numbers.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;
using hierarchy::Page;

std::uint64_t decodedBytes(const Level& level, const LevelGroup& group) {
    // This number is a constant of the format, because it determines which groups share a page.
    constexpr std::uint64_t kGroupBytes = 72;
    std::uint64_t bytes = kGroupBytes;
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
        bytes += sizeof(hierarchy::Cluster) + level.clusters[c].vertexCount * sizeof(hierarchy::Vertex) +
                 level.clusters[c].triangleCount * sizeof(hierarchy::Triangle);
    return bytes;
}

/// Returns the binary exponent of a group's error, clamped to kMaxExponent. An error of 0 has the lowest exponent, and
/// the infinite error of a root has the highest.
int errorExponent(const LevelGroup& group) {
    constexpr int kMaxExponent = 2048;
    const double error = std::max(group.error, group.attributeError);
    // Clamping is needed because ilogb returns INT_MIN for 0 and INT_MAX for infinity.
    return std::clamp(std::ilogb(error), -kMaxExponent, kMaxExponent);
}

int floorOfQuotient(int value, int by) {
    return value >= 0 ? value / by : -((by - 1 - value) / by);
}

/// Returns the groups of `level` sorted by error class. A class covers a factor of 16 in error, and the median error is
/// in the middle of its class. Within a class the order does not change. A view often refines only some groups of a
/// region. With this order the groups that it does not refine are in other pages, which it need not read.
std::vector<std::uint32_t> pageOrder(const Level& level) {
    constexpr int kClassBits = 4;
    std::vector<int> exponents;
    for (const LevelGroup& group : level.groups)
        exponents.push_back(errorExponent(group));
    std::vector<int> sorted = exponents;
    const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), median, sorted.end());
    const int lowest = *median - kClassBits / 2; // lowest exponent of the class that contains the median
    const auto classOf = [&](std::uint32_t g) { return floorOfQuotient(exponents[g] - lowest, kClassBits); };
    std::vector<std::uint32_t> order(level.groups.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(
        order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return classOf(a) < classOf(b); });
    return order;
}

/// Appends the triangles of a cluster to a page. Vertices are numbered in the order of first use.
void addGeometry(
    const simplify::Mesh& mesh,
    const Level& level,
    const LevelCluster& cluster,
    LocalNumbers& numbers,
    Page& page,
    hierarchy::PageFields& fields) {
    numbers.begin();
    for (const simplify::Triangle& corners :
         std::span(level.triangles).subspan(cluster.firstTriangle, cluster.triangleCount)) {
        hierarchy::Triangle triangle{};
        for (std::size_t i = 0; i < 3; ++i)
            triangle[i] = static_cast<std::uint8_t>(numbers.of(corners[i]));
        page.triangles.push_back(triangle);
    }
    GNOMON_CHECK_OP(numbers.ids().size(), ==, cluster.vertexCount);
    for (const std::uint32_t v : numbers.ids())
        page.vertices.push_back(mesh.vertices[v]);
    if (!mesh.hasFields()) return;
    for (const std::uint32_t v : numbers.ids())
        fields.words.push_back(mesh.fieldsOf(v));
}

/// Returns the index in `page` of a refinement of `level`. `refinement` is its index in the level. Adds the refinement
/// to the page if needed. `known` lists the refinements of the level that the page already contains.
std::uint32_t refinementInPage(
    const Level& level, std::uint32_t refinement, std::vector<std::uint32_t>& known, Page& page) {
    const auto found = std::find(known.begin(), known.end(), refinement);
    const auto number = static_cast<std::uint32_t>(found - known.begin());
    if (found != known.end()) return number;
    const LevelRefinement& finer = level.refinements[refinement];
    known.push_back(refinement);
    page.refinements.push_back(
        {{provisionalId(finer.place.level, finer.place.page), finer.place.group},
         finer.bounds,
         finer.error,
         finer.attributeError});
    return number;
}

struct PageWithFields {
    Page page;
    hierarchy::PageFields fields; // fields of the page's vertices
};

/// Builds a page that contains the given groups of the level.
PageWithFields makePage(
    const simplify::Mesh& mesh,
    const Level& level,
    std::uint32_t number,
    std::span<const std::uint32_t> groups,
    LocalNumbers& numbers) {
    PageWithFields made;
    auto& [page, fields] = made;
    fields.layout = mesh.fields.layout;
    page.level = number;
    std::vector<std::uint32_t> refinements; // indices of the level's refinements, in page order
    for (const std::uint32_t g : groups) {
        const LevelGroup& source = level.groups[g];
        page.groups.push_back(
            {static_cast<std::uint32_t>(page.clusters.size()),
             source.clusterCount,
             source.box,
             source.bounds,
             source.error,
             source.attributeError});
        for (std::uint32_t c = source.firstCluster; c < source.firstCluster + source.clusterCount; ++c) {
            const LevelCluster& from = level.clusters[c];
            hierarchy::Cluster cluster;
            cluster.firstVertex = static_cast<std::uint32_t>(page.vertices.size());
            cluster.firstTriangle = static_cast<std::uint32_t>(page.triangles.size());
            cluster.vertexCount = from.vertexCount;
            cluster.triangleCount = from.triangleCount;
            cluster.box = from.box;
            if (from.refinement != kNone)
                cluster.refinement = refinementInPage(level, from.refinement, refinements, page);
            page.clusters.push_back(cluster);
            addGeometry(mesh, level, from, numbers, page, fields);
        }
    }
    return made;
}

} // namespace

std::uint32_t provisionalId(std::uint32_t level, std::uint32_t page) {
    GNOMON_CHECK_OP(level, <, kMaxLevels);
    GNOMON_CHECK_OP(page, <, kMaxLevelPages);
    return (kMaxLevels - 1 - level) * kMaxLevelPages + page;
}

PageOfLevel placeOfProvisional(std::uint32_t id) {
    return {kMaxLevels - 1 - id / kMaxLevelPages, id % kMaxLevelPages};
}

std::uint32_t placeGroups(Level& level, std::uint32_t number) {
    GroupPlace place{number, 0, 0};
    std::uint64_t bytes = 0;
    for (const std::uint32_t g : pageOrder(level)) {
        LevelGroup& group = level.groups[g];
        const std::uint64_t own = decodedBytes(level, group);
        if (bytes > 0 && bytes + own > hierarchy::kPageTargetBytes) {
            ++place.page;
            place.group = 0;
            bytes = 0;
        }
        bytes += own;
        group.place = place;
        ++place.group;
    }
    return place.page + 1;
}

std::vector<hierarchy::EncodedPage> encodePages(
    const simplify::Mesh& mesh, const Level& level, std::uint32_t number, std::uint32_t pageCount) {
    std::vector<std::vector<std::uint32_t>> groups(pageCount); // per page: its groups, in order
    for (const std::uint32_t g : pageOrder(level))
        groups[level.groups[g].place.page].push_back(g);
    std::vector<hierarchy::EncodedPage> encoded(pageCount);
    tbb::enumerable_thread_specific<LocalNumbers> numbers(mesh.vertices.size());
    tbb::parallel_for(std::uint32_t{0}, pageCount, [&](std::uint32_t id) {
        auto [page, fields] = makePage(mesh, level, number, groups[id], numbers.local());
        hierarchy::orderForCoding(page, fields);
        encoded[id] = hierarchy::encodePage(page, fields);
    });
    return encoded;
}

} // namespace gnomon::levels
