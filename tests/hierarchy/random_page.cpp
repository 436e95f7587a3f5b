#include "random_page.h"

#include "hierarchy/validation.h"

namespace gnomon::hierarchy {

namespace {

enum class Attributes { None, Normals, CoarseNormals, All };

std::uint32_t coordinate(Random& random) {
    // Clustered, spread out, and at both ends of the grid.
    switch (random.below(4)) {
    case 0:
        return static_cast<std::uint32_t>(1'000'000 + random.below(500));
    case 1:
        return static_cast<std::uint32_t>(random.below(kMaxGridCoordinate));
    case 2:
        return kMaxGridCoordinate;
    default:
        return 0;
    }
}

Vertex randomVertex(Random& random, Attributes attributes) {
    Vertex vertex;
    vertex.position = {coordinate(random), coordinate(random), coordinate(random)};
    const auto bits = static_cast<std::uint32_t>(random.bits());
    if (attributes == Attributes::Normals || attributes == Attributes::All) vertex.normal = bits;
    if (attributes == Attributes::CoarseNormals) vertex.normal = random.below(9) == 0 ? kNoNormal : bits & 0xFFC0FFC0U;
    if (attributes == Attributes::All) vertex.color = static_cast<std::uint32_t>(random.bits());
    return vertex;
}

} // namespace

Sphere randomSphere(Random& random) {
    return {{random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(0, 1e7)}, random.uniform(0, 5)};
}

Page randomPage(std::uint64_t seed) {
    Random random(seed);
    const auto attributes = static_cast<Attributes>(random.below(4));
    Page page;
    page.level = static_cast<std::uint32_t>(random.below(3));
    const auto groups = 1 + random.below(3);
    const bool hasAttributeErrors = seed % 2 == 1;
    if (page.level > 0)
        for (std::uint64_t i = 0; i <= random.below(4); ++i)
            page.refinements.push_back(
                {{static_cast<std::uint32_t>(random.below(1U << 20U)), static_cast<std::uint32_t>(random.below(9))},
                 randomSphere(random),
                 random.unit(),
                 hasAttributeErrors ? random.unit() : 0});
    for (std::uint64_t g = 0; g < groups; ++g) {
        Group group;
        group.firstCluster = static_cast<std::uint32_t>(page.clusters.size());
        group.clusterCount = static_cast<std::uint32_t>(1 + random.below(3));
        group.bounds = randomSphere(random);
        if (random.below(4) != 0) group.error = random.unit();
        if (hasAttributeErrors) group.attributeError = random.unit();
        for (std::uint32_t c = 0; c < group.clusterCount; ++c) {
            Cluster cluster;
            cluster.firstVertex = static_cast<std::uint32_t>(page.vertices.size());
            cluster.firstTriangle = static_cast<std::uint32_t>(page.triangles.size());
            cluster.vertexCount = static_cast<std::uint32_t>(1 + random.below(kMaxClusterVertices));
            cluster.triangleCount = static_cast<std::uint32_t>(1 + random.below(kMaxClusterTriangles));
            if (page.level > 0) cluster.refinement = static_cast<std::uint32_t>(random.below(page.refinements.size()));
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
                page.vertices.push_back(randomVertex(random, attributes));
                cluster.box.add(page.vertices.back().position);
            }
            const auto corner = [&] { return static_cast<std::uint8_t>(random.below(cluster.vertexCount)); };
            for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
                page.triangles.push_back({corner(), corner(), corner()});
            group.box.add(cluster.box);
            page.clusters.push_back(cluster);
        }
        page.groups.push_back(group);
    }
    return page;
}

} // namespace gnomon::hierarchy
