#include "lod/triangle_clip.h"

#include <algorithm>

namespace gnomon::lod {

const std::vector<glm::dvec3>& TriangleClipper::clipped(const std::array<glm::dvec3, 3>& corners) {
    polygon_.assign(corners.begin(), corners.end());
    for (const Plane& plane : volume_->planes) {
        distances_.clear();
        bool isCut = false;
        for (const glm::dvec3& point : polygon_) {
            distances_.push_back(plane.signedDistance(point));
            isCut = isCut || distances_.back() < 0;
        }
        if (!isCut) continue;
        next_.clear();
        for (std::size_t i = 0; i < polygon_.size(); ++i) {
            const std::size_t j = i + 1 == polygon_.size() ? 0 : i + 1;
            if (distances_[i] >= 0) next_.push_back(polygon_[i]);
            if ((distances_[i] >= 0) != (distances_[j] >= 0))
                next_.push_back(glm::mix(polygon_[i], polygon_[j], distances_[i] / (distances_[i] - distances_[j])));
        }
        std::swap(polygon_, next_);
        if (polygon_.empty()) break;
    }
    return polygon_;
}

} // namespace gnomon::lod
