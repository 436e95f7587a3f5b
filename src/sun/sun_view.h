// The pixels of a view as receivers: one cut, one image, and exact shadows for one light after another.
#pragma once

#include "frame/renderer.h"
#include "render/exact_pass.h"
#include "sun/receivers.h"

#include <optional>
#include <vector>

namespace gnomon::sun {

/// A view for sun studies. The cut and the image are made once for all light directions. The casters are all clusters
/// that may be between the visible surfaces and any of the lights. The cut contains image and casters together, so no
/// surface is shadowed by another level of detail of itself. Detail is selected as for a frame. For casters, it uses up
/// to kDetailLights evenly selected lights.
class SunView final : public Receivers {
public:
    static constexpr std::size_t kDetailLights = 64;

    /// Prepares and draws the view. `renderer` must outlive this object and must not prepare another frame meanwhile.
    /// `lights` must not be empty. Throws the same errors as the rendering of a frame.
    SunView(
        frame::Renderer& renderer,
        const plan::View& view,
        const plan::Quality& quality,
        std::span<const IntegerLight> lights);

    /// Returns the number of pixels. Rows are from top to bottom.
    std::size_t count() const override { return picture_.pixels.size(); }

    exact::ExactStatistics resolve(const IntegerLight& light, std::span<std::uint8_t> isLit) override;

    /// Computes the same result as `resolve` with the plain integer loops of exact::plainStatuses, as ground truth for
    /// tests. Only pixels with a non-zero entry in `isRequested` (`count()` elements) are tested.
    void resolvePlainly(
        const IntegerLight& light, std::span<const std::uint8_t> isRequested, std::span<std::uint8_t> isLit);

    /// Returns the visible points, in undefined order.
    const exact::VisiblePoints& points() const { return points_; }

    /// Returns the position of visible point `i`, in world space.
    glm::dvec3 position(std::size_t i) const;

    /// Returns the picture of the view without sunlight.
    const render::Picture& picture() const { return picture_; }

    /// Returns the number of triangles that may cast shadows.
    std::uint64_t casterTriangles() const { return frame_.cut.lists.casters[0].triangles; }

    /// Returns the prepared frame of the view.
    const frame::PreparedFrame& prepared() const { return frame_; }

private:
    void prepare(frame::Renderer& renderer, std::span<const IntegerLight> lights);
    void cutCasters(const frame::Residency& residency, std::span<const IntegerLight> lights);
    plan::FramePlan planFor(const IntegerLight& light) const;
    /// Collects the samples for exact shadows of the plan's light. Returns the input of the renderer for this plan.
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
