// The renderer. It converts a model, a view and a history to an image, a row of the log and the next history.
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
    History before;  // the history that the frame continues
    History history; // for the next frame
    telemetry::FrameRow row;
};

/// Draws the frames of a model. The renderer has no state that changes a picture: it only caches pages, trees and maps.
class Renderer {
public:
    /// `model` and `backend` must outlive the renderer. Throws Error if the root is damaged or if the memory is
    /// smaller than the tables.
    Renderer(const hierarchy::ModelFile& model, render::Backend& backend, ResidencyOptions options);

    /// Draws the frame of a view; the backend then contains its image. If `history` belongs to the same motion
    /// (plan/camera_cut.h), it provides the hysteresis of the plan and determines the shading. Otherwise the image does
    /// not depend on previous frames.
    Frame render(
        const plan::View& view, const plan::Quality& quality, const FrameOptions& options, const History& history = {});

    /// Returns the plan of a view, with the facts from the hierarchy, without drawing.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Makes all following plans for the capabilities `backend` instead of those of the backend.
    void planFor(const plan::Capabilities& backend) { plannedFor_ = backend; }

    /// Returns true if the light reaches so few pixels that Shading::Auto uses no sun.
    static bool isNegligible(std::uint64_t litPixels, const plan::View& view);

    /// Plans and cuts a view after a frame with the plan memory `memory`, and makes its pages resident. The function
    /// does not draw. The cut extends `margin` pixels beyond the image.
    PreparedFrame prepare(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting = Waiting::UntilComplete,
        const plan::PlanMemory& memory = {},
        double margin = 0);

    /// Draws the frame that was prepared last, also repeatedly. Reuses those of `maps` that the texture still holds.
    /// Afterwards the plan of the frame says which maps were reused.
    render::DrawStatistics draw(
        PreparedFrame& frame, const FrameOptions& options, const std::shared_ptr<const DrawnMaps>& maps = nullptr);

    /// Draws the image of the last rendered frame again with the same cut, at the sample position in `options`. The
    /// frame must have `isAccumulated`. The maps are drawn again if `options` shift them.
    void drawSample(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the view of `frame` with light from `towardsLight` (any length above 0), with a new plan and cut and the
    /// same kind of shadows. Waits until all pages are resident. `options` selects the part of the light. `frame`
    /// itself cannot be drawn again.
    void drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options);

    /// Returns the backend's input for `frame`. `frame` must outlive the result.
    render::DrawInputs drawing(const PreparedFrame& frame, const FrameOptions& options) const;

    /// Reserves memory for the image of a later frame.
    void reservePicture(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
        residency_.reservePicture(picturePart(view, quality, options));
    }

    /// Returns the shortfall of the frames since the last call, compared with the requested error, and resets it. Call
    /// this after small test images to exclude them from the next result.
    telemetry::Shortfall takeShortfall() { return std::exchange(shortfall_, {}); }

    const Residency& residency() const { return residency_; }

    Residency& residency() { return residency_; }

    const hierarchy::ModelFile& model() const { return *model_; }

    render::Backend& backend() const { return *backend_; }

private:
    /// The input of the steps before the cut.
    struct Asked {
        const plan::View& view;
        const plan::Quality& quality;
        const std::shared_ptr<const Ground>& ground; // of the view; null without a ground
        const plan::PlanMemory& memory;
        Waiting waiting = Waiting::UntilComplete;
        double margin = 0;
    };

    /// Returns the capabilities that plans are made for.
    plan::Capabilities capabilities() const { return plannedFor_.value_or(backend_->capabilities()); }

    /// Returns the ground of `view`, or null.
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
