// The pixels of a view as receivers: one cut, one image, and then light after light by exact shadows.
#pragma once

#include "daylight/receivers.h"
#include "executor/exact_pass.h"
#include "frame/renderer.h"

#include <optional>
#include <vector>

namespace gnomon::daylight {

/// A view is cut and drawn once, whatever the light: its casters are all clusters that may stand between what is in
/// view and any of the lights, in one cut with the image, so that no surface shadows another version of itself. Detail
/// is chosen as for a frame; that of casters for up to kDetailLights of the lights, evenly taken.
class SunView final : public Receivers {
public:
    static constexpr std::size_t kDetailLights = 64;

    /// `renderer` must outlive it, and prepare no frame meanwhile. At least one light. Throws Error as a frame does.
    SunView(
        frame::Renderer& renderer,
        const plan::View& view,
        const plan::Quality& quality,
        std::span<const IntegerLight> lights);

    /// Pixels, rows from top to bottom.
    std::size_t count() const override { return picture_.pixels.size(); }

    exact::ExactStatistics decide(const IntegerLight& light, std::span<std::uint8_t> isLit) override;

    /// The same by the plain integer loops of exact::plainStatuses, of those pixels that `isAsked` (of `count()`
    /// elements, not 0): the truth.
    void decidePlainly(const IntegerLight& light, std::span<const std::uint8_t> isAsked, std::span<std::uint8_t> isLit);

    /// What is visible, in no order.
    const exact::VisiblePoints& points() const { return points_; }

    /// Where point `i` of these lies, world space.
    glm::dvec3 position(std::size_t i) const;

    /// The view without any sun.
    const executor::Picture& picture() const { return picture_; }

    /// What casts, at most.
    std::uint64_t casterTriangles() const { return frame_.cut.lists[1].triangles; }

    /// The view as it is cut and drawn.
    const frame::PreparedFrame& prepared() const { return frame_; }

private:
    void prepare(frame::Renderer& renderer, std::span<const IntegerLight> lights);
    void cutCasters(const frame::Residency& residency, std::span<const IntegerLight> lights);
    plan::FramePlan planFor(const IntegerLight& light) const;
    /// Fills the samples for a light.
    executor::FrameDrawing collect(const plan::FramePlan& plan);

    plan::View view_;
    plan::Quality quality_;
    frame::PreparedFrame frame_;
    executor::FrameDrawing drawing_;
    executor::Picture picture_;
    executor::SoftwarePass pass_;
    exact::VisiblePoints points_;
    std::vector<exact::Caster> casters_;
    exact::ExactShadows exact_;
};

} // namespace gnomon::daylight
