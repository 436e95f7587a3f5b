// Draws the image of a view of a model. Also returns statistics for the log, and the history for the next frame.
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
    History before;  // history of the previous frame, without the parts that this frame cannot use
    History history; // history for the next frame
    telemetry::FrameRow row;
};

/// Draws frames of a model. The renderer only caches pages, ray-tracing trees and shadow maps, and no cached data
/// change an image.
class Renderer {
public:
    /// Opens `model` for drawing with `backend`. Both must outlive the renderer. Throws Error if the root page is
    /// damaged, or if the memory limit is smaller than the model's tables.
    Renderer(const hierarchy::ModelFile& model, render::Backend& backend, ResidencyOptions options);

    /// Draws `view` into the backend's image, and returns the frame. If `history` belongs to the same camera motion
    /// (plan/camera_cut.h), it provides the plan's hysteresis and the choice of the headlight. Otherwise the image does
    /// not depend on previous frames.
    Frame render(
        const plan::View& view, const plan::Quality& quality, const FrameOptions& options, const History& history = {});

    /// Plans `view` without drawing it, and returns the plan. The function selects clusters and loads their pages as
    /// for drawing.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Makes all following plans for the capabilities `backend` instead of those of the renderer's own backend.
    void planFor(const plan::Capabilities& backend) { plannedFor_ = backend; }

    /// Returns true if the light reaches so few pixels that Shading::Auto uses the headlight instead of the sun.
    static bool isNegligible(std::uint64_t litPixels, const plan::View& view);

    /// Plans a view, selects its clusters, and loads their pages. It does not draw. `memory` contains the hysteresis
    /// values of the previous frame's plan. The clusters also cover `margin` pixels around the image.
    PreparedFrame prepare(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting = Waiting::UntilComplete,
        const plan::PlanMemory& memory = {},
        double margin = 0);

    /// Draws the frame that `prepare` returned last. Can be called repeatedly. Shadow maps in `maps` that are identical
    /// and still in the depth texture are reused, and are marked in the plan of `frame`.
    render::DrawStatistics draw(
        PreparedFrame& frame, const FrameOptions& options, const std::shared_ptr<const DrawnMaps>& maps = nullptr);

    /// Draws the image of the last rendered frame again with the same clusters, at the subpixel position in `options`.
    /// The frame must have `isAccumulated`. If `options` shift the texel grids, the shadow maps are drawn again.
    void drawSample(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the view of `frame` with light from the direction `towardsLight` (any length above 0). The function makes
    /// a new plan with the same kind of shadows, selects clusters again, and waits for their pages. `options` selects
    /// the part of the light. Afterwards `frame` cannot be drawn again, because its pages may have been evicted.
    void drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options);

    /// Returns the backend's input for `frame`. `frame` must outlive the result.
    render::DrawInputs drawing(const PreparedFrame& frame, const FrameOptions& options) const;

    /// Reserves memory for the image that a later frame will draw.
    void reservePicture(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
        residency_.reservePicture(picturePart(view, quality, options));
    }

    /// Returns by how much the drawn error exceeded the requested error in the frames since the last call, and resets
    /// this statistic. Call this function after small test images to exclude them from the next result.
    telemetry::Shortfall takeShortfall() { return std::exchange(shortfall_, {}); }

    const Residency& residency() const { return residency_; }

    Residency& residency() { return residency_; }

    const hierarchy::ModelFile& model() const { return *model_; }

    render::Backend& backend() const { return *backend_; }

private:
    /// The view, settings and ground for which a frame is planned.
    struct Asked {
        const plan::View& view;
        const plan::Quality& quality;
        const std::shared_ptr<const Ground>& ground; // ground of the view; null without a ground
        const plan::PlanMemory& memory;
        Waiting waiting = Waiting::UntilComplete;
        double margin = 0;
    };

    /// Returns the backend capabilities for which plans are made.
    plan::Capabilities capabilities() const { return plannedFor_.value_or(backend_->capabilities()); }

    /// Returns the ground of `view`, or null if the view has no ground.
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
    std::shared_ptr<const DrawnMaps> maps_; // shadow maps in the backend's depth texture; null: none
    telemetry::Shortfall shortfall_;
    std::vector<lod::DepthCandidate> depthScratch_;
    std::shared_ptr<render::SectionMemory> sections_;
};

} // namespace gnomon::frame
