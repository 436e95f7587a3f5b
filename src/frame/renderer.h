// The renderer. It converts a model and a view to an image and a row of the log, in this order: plan, cut, culling per
// partition, shadow passes, image pass.
#pragma once

#include "frame/held_maps.h"
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
    telemetry::FrameRow row;
};

/// Draws the frames of a model, one after another.
class Renderer {
public:
    /// `model` and `backend` must outlive the renderer. Throws Error if the root is damaged or if the memory is
    /// smaller than the tables.
    Renderer(const hierarchy::ModelFile& model, render::Backend& backend, ResidencyOptions options);

    /// Draws the frame of a view; the backend then contains its image. If the previous frame belongs to the same
    /// motion (plan/view_jump.h), it provides the hysteresis of the plan and determines the shading. Otherwise the
    /// image does not depend on previous frames.
    Frame render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

    /// Returns the plan of a view, with the facts from the hierarchy, without drawing.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Makes all following plans for the capabilities `backend` instead of those of the backend.
    void planFor(const plan::Capabilities& backend) { plannedFor_ = backend; }

    /// The shared state of the frames of a motion. Frames that start with the same state have the same plan and
    /// shading.
    struct Motion {
        std::shared_ptr<const plan::PlannedFrame> previous;
        plan::View view; // requested view of the previous frame
        plan::Quality quality;
        double farthest = 0;           // largest visible depth of the previous frame
        std::optional<bool> isSunless; // for frames with Shading::Auto; nullopt: not known yet
    };

    const Motion& motion() const { return motion_; }

    /// Restores `motion`, so that the next frame continues it.
    void continueFrom(const Motion& motion) { motion_ = motion; }

    /// Returns true if the light reaches so few pixels that Shading::Auto uses no sun.
    static bool isNextToNothing(std::uint64_t litPixels, const plan::View& view);

    /// Returns true if the last frame has a ground, in view or not.
    bool hasGround() const { return ground_ != nullptr; }

    /// Clears the state of previous frames, so that the next plan depends only on its own view.
    void forget() {
        motion_ = {};
        heldMaps_.clear();
    }

    /// Plans and cuts a view as the successor of `before` (null: the first frame), and makes its pages resident. The
    /// function does not draw, and does not affect the next frame. The cut extends `margin` pixels beyond the image.
    PreparedFrame prepare(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before,
        double margin = 0);

    /// Draws the frame that was prepared last, also repeatedly. Afterwards its plan says which maps were reused.
    render::DrawStatistics draw(PreparedFrame& frame, const FrameOptions& options);

    /// Draws the image of the last rendered frame again with the same cut, at the sample position in `options`. The
    /// frame must have `isAccumulated`. The maps are drawn again if `options` shift them.
    void drawSample(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the view of `frame` with light from `towardsLight` (any length above 0), with a new plan and cut and the
    /// same kind of shadows. Waits until all pages are resident. `options` selects the part of the light. The call does
    /// not affect later frames, but `frame` itself cannot be drawn again.
    void drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options);

    /// Returns the backend's input for `frame`. `frame` must outlive the result.
    render::FrameDrawing drawing(const PreparedFrame& frame, const FrameOptions& options) const;

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
    /// Does the work of `prepare` with the current ground, except penumbrae and sky light.
    PreparedFrame prepareShadows(
        const plan::View& view,
        const plan::Quality& asked,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before,
        double margin);

    /// Returns the capabilities that plans are made for.
    plan::Capabilities capabilities() const { return plannedFor_.value_or(backend_->capabilities()); }

    /// Plans `frame` from its facts.
    void planAnew(PreparedFrame& frame, const plan::View& view, const plan::Quality& quality) const;

    /// Returns true if a frame of `view` with `quality` continues the motion of the previous frame.
    bool continuesMotion(const plan::View& view, const plan::Quality& quality) const;

    /// Returns the previous frame, without its plan memory if `view` does not continue its motion.
    std::shared_ptr<const plan::PlannedFrame> frameBefore(const plan::View& view, const plan::Quality& quality) const;

    std::optional<bool> isWithoutSun(const Frame& frame) const;
    render::DrawStatistics drawWithOrWithoutSun(Frame& frame);
    Bytes picturePart(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) const;
    void chooseOcclusion(PreparedFrame& frame) const;

    const hierarchy::ModelFile* model_;
    render::Backend* backend_;
    std::optional<plan::Capabilities> plannedFor_;
    Residency residency_;
    Motion motion_;
    HeldMaps heldMaps_;
    telemetry::Shortfall shortfall_;
    std::vector<lod::DepthCandidate> depthScratch_;
    std::shared_ptr<const Ground> ground_; // of the prepared view
    std::shared_ptr<render::SectionMemory> sections_;
};

} // namespace gnomon::frame
