// Tests for each light direction which pixels of an image are sunlit. The image is drawn once, and exact shadows are
// computed per light direction.
#pragma once

#include "frame/renderer.h"
#include "render/exact_pass.h"
#include "sun/receivers.h"

#include <optional>
#include <vector>

namespace gnomon::sun {

/// An image whose pixels are tested for sunlight from many light directions. The level of detail is selected and the
/// image is drawn only once for all lights. The shadow casters are all clusters that may be between the visible
/// surfaces and any of the lights. Image and casters use the same clusters, so no surface is shadowed by another level
/// of detail of itself. Detail is selected as for a frame. For casters, the selection uses up to kDetailLights evenly
/// selected lights.
class SunView final : public Receivers {
public:
    static constexpr std::size_t kDetailLights = 64;

    /// Selects the clusters and draws the image. `renderer` must outlive this object and must not prepare another frame
    /// meanwhile. `lights` must not be empty. Throws the same errors as the rendering of a frame.
    SunView(
        frame::Renderer& renderer,
        const plan::View& view,
        const plan::Quality& quality,
        std::span<const IntegerLight> lights);

    /// Returns the number of pixels of the image. Pixels are sorted by row, from top to bottom.
    std::size_t count() const override { return picture_.pixels.size(); }

    exact::ExactStatistics resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) override;

    /// Computes the same result as `resolve` with the simple integer loops of exact::plainStatuses, as ground truth for
    /// tests. Only pixels with a non-zero entry in `isRequested` (`count()` elements) are tested.
    void resolvePlainly(
        const IntegerLight& light, std::span<const std::uint8_t> isRequested, std::span<std::uint8_t> isLit);

    /// Returns the surface points that the pixels of the image show, in undefined order.
    const exact::VisiblePoints& points() const { return points_; }

    /// Returns the world-space position of the surface point with index `i` in `points()`.
    glm::dvec3 position(std::size_t i) const;

    /// Returns the image without sunlight.
    const render::Picture& picture() const { return picture_; }

    /// Returns the number of triangles that may cast shadows on the image.
    std::uint64_t casterTriangles() const { return frame_.cut.lists.casters[0].triangles; }

    /// Returns the prepared frame from which the image was drawn.
    const frame::PreparedFrame& prepared() const { return frame_; }

private:
    void prepare(frame::Renderer& renderer, std::span<const IntegerLight> lights);
    void cutCasters(const frame::Residency& residency, std::span<const IntegerLight> lights);
    plan::FramePlan planFor(const IntegerLight& light) const;
    /// Collects the visible points of the image that face the light of `plan`, for exact shadows. Returns the input
    /// with which the renderer draws this plan.
    render::DrawInputs collect(const plan::FramePlan& plan);

    plan::View view_;
    plan::Quality quality_;
    frame::PreparedFrame frame_;
    render::DrawInputs drawing_;
    render::Picture picture_;
    render::SoftwarePass pass_;
    exact::VisiblePoints points_;
    std::vector<exact::Caster> casters_;
    exact::ExactShadows exact_;
};

} // namespace gnomon::sun
