#include "validation/crawl.h"

#include "render/frame_block.h"
#include "render/software_shading.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace gnomon::validation {

namespace {

/// Min change of a shadow lookup that counts: about one level of an 8-bit picture. Smaller changes come from rounding,
/// which changes the weights of a filter kernel.
constexpr float kSeenChange = 1.0F / 128;

bool isInView(const render::DrawInputs& frame, const glm::dvec3& position) {
    const plan::View& view = frame.plan->view;
    const glm::dvec3 p(frame.space.cameraFromDraw * glm::dvec4(position, 1));
    return p.z > 0 && std::abs(p.x) <= p.z * view.tanHalfX() && std::abs(p.y) <= p.z * view.tanHalfY();
}

bool isSameSlice(const plan::ShadowPass& a, const plan::ShadowPass& b) {
    return a.map.region.slice == b.map.region.slice && a.map.region.face == b.map.region.face;
}

/// Compares the shadow lookups of two frames at the same world points.
class Comparison {
public:
    Comparison(const DrawnMaps& before, const DrawnMaps& now)
        : before_(before.frame),
          now_(now.frame),
          then_(*before.frame, render::imageClipFromDraw(*before.frame), *before.depth, {}),
          later_(*now.frame, render::imageClipFromDraw(*now.frame), *now.depth, {}) {
        const auto cells = [](const hierarchy::GridPoint& p) { return glm::dvec3(p.x, p.y, p.z); };
        nowFromBefore_ = (cells(before_->space.originCell) - cells(now_->space.originCell)) * now_->space.step;
    }

    void compareRow(const render::Raster<render::SurfaceSample>& surfaces, int row, Crawl& found) const {
        render::PointBatch points;
        for (int column = 0; column < surfaces.width; ++column) {
            const render::SurfaceSample& surface = surfaces.at(column, row);
            if (!surface.isLitSide()) continue;
            for (int axis = 0; axis < 3; ++axis) {
                points.position[static_cast<std::size_t>(axis)][points.count] = surface.position[axis];
                points.normal[static_cast<std::size_t>(axis)][points.count] = surface.normal[axis];
            }
            if (++points.count == render::PixelBatch::kMaxPixels) compare(points, found);
        }
        compare(points, found);
    }

private:
    /// Compares the shadow lookups of both frames at the points in `points`, adds the counts to `found`, and empties
    /// `points`.
    void compare(render::PointBatch& points, Crawl& found) const {
        render::PointBatch moved = points;
        const glm::vec3 offset(nowFromBefore_);
        for (std::size_t i = 0; i < moved.count; ++i)
            for (int axis = 0; axis < 3; ++axis)
                moved.position[static_cast<std::size_t>(axis)][i] += offset[axis];
        render::lookUpShadows(then_.frame(), points);
        render::lookUpShadows(later_.frame(), moved);
        for (std::size_t i = 0; i < points.count; ++i) {
            if (points.pass[i] < 0 || moved.pass[i] < 0) continue;
            const auto& a = before_->plan->passes[static_cast<std::size_t>(points.pass[i])];
            const auto& b = now_->plan->passes[static_cast<std::size_t>(moved.pass[i])];
            const glm::dvec3 position(moved.position[0][i], moved.position[1][i], moved.position[2][i]);
            if (!isSameSlice(a, b) || !isInView(*now_, position)) continue;
            ++found.points;
            found.changed += std::abs(points.lit[i] - moved.lit[i]) > kSeenChange ? 1 : 0;
        }
        points.count = 0;
    }

    const render::DrawInputs* before_;
    const render::DrawInputs* now_;
    render::Shading then_;
    render::Shading later_;
    // vector from a position in the earlier camera-relative space to the same point in the later space
    glm::dvec3 nowFromBefore_{0};
};

} // namespace

Crawl crawl(const DrawnMaps& before, const render::Raster<render::SurfaceSample>& surfaces, const DrawnMaps& now) {
    const Comparison comparison(before, now);
    std::vector<Crawl> rows(static_cast<std::size_t>(surfaces.height));
    tbb::parallel_for(0, surfaces.height, [&](int row) {
        comparison.compareRow(surfaces, row, rows[static_cast<std::size_t>(row)]);
    });
    Crawl result;
    for (const Crawl& row : rows) {
        result.points += row.points;
        result.changed += row.changed;
    }
    return result;
}

} // namespace gnomon::validation
