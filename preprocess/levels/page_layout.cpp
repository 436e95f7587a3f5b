#include "preprocess/levels/page_layout.h"

#include "core/check.h"
#include "hierarchy/codec/cluster_order.h"
#include "preprocess/levels/local_numbers.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

namespace gnomon::levels {

namespace {

using hierarchy::kNone;
using hierarchy::Page;

std::uint64_t decodedBytes(const Level& level, const LevelGroup& group) {
    constexpr std::uint64_t kGroupBytes = 72; // a constant of the format: it decides which groups share a page
    std::uint64_t bytes = kGroupBytes;
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
        bytes += sizeof(hierarchy::Cluster) + level.clusters[c].vertexCount * sizeof(hierarchy::Vertex) +
                 level.clusters[c].triangleCount * sizeof(hierarchy::Triangle);
    return bytes;
}

/// Appends the cluster's triangles, its vertices numbered in the order of their first use.
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

/// The number that the level's refinement `refinement` has in `page`, where it is added if it is new; `known` are those
/// of the page so far.
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
    hierarchy::PageFields fields; // of its vertices
};

/// The page of the groups [first, end).
PageWithFields makePage(
    const simplify::Mesh& mesh,
    const Level& level,
    std::uint32_t number,
    std::size_t first,
    std::size_t end,
    LocalNumbers& numbers) {
    PageWithFields made;
    auto& [page, fields] = made;
    fields.layout = mesh.fields.layout;
    page.level = number;
    std::vector<std::uint32_t> refinements; // of the level, in the order of the page
    for (std::size_t g = first; g < end; ++g) {
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
    for (LevelGroup& group : level.groups) {
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
    std::vector<std::size_t> ends(pageCount, 0); // of each page's groups
    for (std::size_t g = 0; g < level.groups.size(); ++g)
        ends[level.groups[g].place.page] = g + 1;
    std::vector<hierarchy::EncodedPage> encoded(pageCount);
    tbb::enumerable_thread_specific<LocalNumbers> numbers(mesh.vertices.size());
    tbb::parallel_for(std::uint32_t{0}, pageCount, [&](std::uint32_t id) {
        auto [page, fields] = makePage(mesh, level, number, id > 0 ? ends[id - 1] : 0, ends[id], numbers.local());
        hierarchy::orderForCoding(page, fields);
        encoded[id] = hierarchy::encodePage(page, fields);
    });
    return encoded;
}

} // namespace gnomon::levels
