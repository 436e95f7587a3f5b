// The renderer of a model. It draws the image of a view, and returns statistics for the log and the history for the
// next frame.
#pragma once

#include "frame/drawn_maps.h"
#include "frame/history.h"
#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"
#include "lod/receivers.h"
#include "telemetry/frame_row.h"
#include "telemetry/shortfall.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::frame {

/// A frame that has been drawn.
struct Frame : PreparedFrame {
    FrameOptions options;
    History before;  // history of the previous frame, as far as this frame continues it
    History history; // history for the next frame
    telemetry::FrameRow row;
};

/// Draws the frames of a model. The renderer has no state that changes an image: it only caches pages, ray-tracing
/// trees and shadow maps.
class Renderer {
public:
    /// `model` and `backend` must outlive the renderer. Throws Error if the root page is damaged, or if the memory is
    /// smaller than the tables of the model.
    Renderer(const hierarchy::ModelFile& model, render::Backend& backend, ResidencyOptions options);

    /// Draws a view, and returns the frame. The backend then contains the image. If `history` belongs to the same
    /// motion (plan/camera_cut.h), it provides the hysteresis of the plan and the choice of the headlight. Otherwise
    /// the image does not depend on previous frames.
    Frame render(
        const plan::View& view, const plan::Quality& quality, const FrameOptions& options, const History& history = {});

    /// Returns the plan of a view without drawing it. The scene facts come from the hierarchy.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Makes all following plans for the given capabilities instead of the capabilities of the renderer's own backend.
    void planFor(const plan::Capabilities& backend) { plannedFor_ = backend; }

    /// Returns true if the light reaches so few pixels that Shading::Auto uses the headlight instead of the sun.
    static bool isNegligible(std::uint64_t litPixels, const plan::View& view);

    /// Plans and cuts a view, and makes its pages resident. It does not draw. `memory` is the plan memory of the
    /// previous frame. The cut extends `margin` pixels beyond the image.
    PreparedFrame prepare(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting = Waiting::UntilComplete,
        const plan::PlanMemory& memory = {},
        double margin = 0);

    /// Draws the frame that `prepare` returned last. Can be called repeatedly. Reuses the maps of `maps` that are still
    /// in the depth texture, and marks them in the plan of `frame`.
    render::DrawStatistics draw(
        PreparedFrame& frame, const FrameOptions& options, const std::shared_ptr<const DrawnMaps>& maps = nullptr);

    /// Draws the image of the last rendered frame again with the same cut, at the subpixel position in `options`. The
    /// frame must have `isAccumulated`. If `options` shift the texel grids, the maps are drawn again.
    void drawSample(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the view of `frame` with light from the direction `towardsLight` (any length above 0). The view receives a
    /// new plan and cut, with the same kind of shadows. The function waits until all pages are resident. `options`
    /// selects the part of the light. Afterwards `frame` cannot be drawn again, because its pages may have been
    /// evicted.
    void drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options);

    /// Returns the backend's input for `frame`. `frame` must outlive the result.
    render::DrawInputs drawing(const PreparedFrame& frame, const FrameOptions& options) const;

    /// Reserves memory for the image that a later frame will draw.
    void reservePicture(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
        residency_.reservePicture(picturePart(view, quality, options));
    }

    /// Returns the shortfall of the frames since the last call, and resets it. The shortfall is the excess of the drawn
    /// error over the requested error. Call this function after small test images to exclude them from the next result.
    telemetry::Shortfall takeShortfall() { return std::exchange(shortfall_, {}); }

    const Residency& residency() const { return residency_; }

    Residency& residency() { return residency_; }

    const hierarchy::ModelFile& model() const { return *model_; }

    render::Backend& backend() const { return *backend_; }

private:
    /// The input for the planning of a frame.
    struct Asked {
        const plan::View& view;
        const plan::Quality& quality;
        const std::shared_ptr<const Ground>& ground; // ground of the view; null without a ground
        const plan::PlanMemory& memory;
        Waiting waiting = Waiting::UntilComplete;
        double margin = 0;
    };

    /// Returns the capabilities for which plans are made.
    plan::Capabilities capabilities() const { return plannedFor_.value_or(backend_->capabilities()); }

    /// Returns the ground of `view`, or null if it has none.
    std::shared_ptr<const Ground> ground(const plan::View& view, const plan::ShadingSettings& look, bool hasSky) const;

    static std::uint64_t minLitPixels(const plan::View& view);
    PreparedFrame prepareShadows(const Asked& asked);
    PreparedFrame planned(const Asked& asked, plan::ShadowMode shadows);
    void findFacts(
        PreparedFrame& frame, const Asked& asked, plan::ShadowMode shadows, const std::optional<DepthSpan>& range);
    render::DrawStatistics drawInLight(Frame& frame);
    Bytes picturePart(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) const;

    const hierarchy::ModelFile* model_;
    render::Backend* backend_;
    std::optional<plan::Capabilities> plannedFor_;
    Residency residency_;
    std::shared_ptr<const DrawnMaps> maps_; // the maps in the depth texture; null: none
    telemetry::Shortfall shortfall_;
    std::vector<lod::DepthCandidate> depthScratch_;
    std::shared_ptr<render::SectionMemory> sections_;
};

} // namespace gnomon::frame
