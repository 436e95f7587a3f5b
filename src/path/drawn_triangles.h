// Visits the triangles of a model at a chosen level of detail, in world space. The pages are read one after the other.
#pragma once

#include "hierarchy/cut_rule.h"
#include "hierarchy/model_file.h"

#include <array>
#include <limits>

namespace gnomon::path {

using TriangleCorners = std::array<glm::dvec3, 3>;

/// Calls `visit` with each triangle of a cut of the model, in world space. A cut contains the clusters of one level of
/// detail per place. The cut refines each group of clusters for which `isRefined(error, bounds)` is true; `bounds` are
/// in local space. If the function is false for a group, it must be false for all finer groups. Pages with finer detail
/// than the cut are not read, so the time does not depend on the size of the model.
template <class IsRefined, class Visit>
void forEachTriangle(const hierarchy::ModelFile& model, const IsRefined& isRefined, const Visit& visit) {
    const hierarchy::Grid& grid = model.summary().grid;
    for (std::uint32_t id = 0; id < model.pages().size(); ++id) {
        const hierarchy::PageInfo& info = model.pages()[id];
        const bool holdsRoot = info.maxError == std::numeric_limits<double>::infinity();
        if (!holdsRoot && !isRefined(info.maxError, info.bounds)) continue; // the cut draws none of its groups
        const hierarchy::Page page = model.readPage(id);
        hierarchy::forEachDrawn(page, isRefined, [&](const hierarchy::Group&, const hierarchy::Cluster& cluster) {
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
                TriangleCorners corners;
                for (std::size_t i = 0; i < corners.size(); ++i)
                    corners[i] = grid.world(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
                visit(corners);
            }
        });
    }
}

} // namespace gnomon::path
