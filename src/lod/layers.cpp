#include "lod/layers.h"

#include <algorithm>

namespace gnomon::lod {

double imageLayers(const lod::CutQuery& query, const lod::DrawList& image, double sufficientLayers) {
    const lod::DetailView& view = query.rule->view();
    const hierarchy::Grid& grid = query.trees->grid();
    double layers = 0;
    for (const lod::ClusterRange& range : image.ranges) {
        const hierarchy::Page& page = *query.resident[range.page];
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c) {
            const Box box = grid.local(page.clusters[c].box);
            const glm::dvec3 extent = box.extent();
            const glm::dvec3 fromEye = box.center() - view.eye;
            const double distance = glm::length(fromEye);
            const double depth = glm::dot(fromEye, view.basis.view);
            double share = 1;
            if (depth > 0.5 * glm::length(extent)) {
                // Sums the projected areas of the three visible faces. At depth 1, the image has the area 4 tanHalfX
                // tanHalfY.
                const glm::dvec3 faces(extent.y * extent.z, extent.z * extent.x, extent.x * extent.y);
                const double area = glm::dot(glm::abs(fromEye), faces) / distance;
                share = area / (4 * view.tanHalfX * view.tanHalfY * depth * depth);
            }
            layers += std::min(share, 1.0);
        }
        if (layers >= sufficientLayers) break;
    }
    return layers;
}

} // namespace gnomon::lod
