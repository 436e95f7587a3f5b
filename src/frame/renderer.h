// From a model and a view to a picture and a row of the log: plan, cut, cull per partition, shadow passes, image pass.
#pragma once

#include "culling/receivers.h"
#include "frame/held_maps.h"
#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"
#include "telemetry/frame_row.h"
#include "telemetry/shortfall.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::frame {

/// A frame that was drawn once.
struct Frame : PreparedFrame {
    FrameOptions options;
    telemetry::FrameRow row;
};

/// Draws a model frame by frame.
class Renderer {
public:
    /// `model` and `executor` must outlive it. Throws Error if the root is damaged or the memory is less than the
    /// tables take.
    Renderer(const hierarchy::ModelFile& model, executor::Executor& executor, ResidencyOptions options);

    /// Draws the frame of a view; the executor holds its picture. The frame before steadies its plan and decides its
    /// shading if both are frames of one motion (plan/view_jump.h). Otherwise the picture depends on no frame before.
    Frame render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

    /// The plan alone, refined with what the hierarchy answers; nothing is drawn.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Plans from now on for an executor that can do so much, which is not the one that draws.
    void planFor(const plan::Capabilities& backend) { plannedFor_ = backend; }

    /// What the frames of a motion share. Frames that begin with the same state are planned and shaded alike.
    struct Motion {
        std::shared_ptr<const plan::PlannedFrame> previous;
        plan::View view; // of the frame before, as it was asked for
        plan::Quality quality;
        double farthest = 0;           // depth that the frame before saw
        std::optional<bool> isSunless; // of the frames with Shading::Auto; nothing: not decided yet
    };

    const Motion& motion() const { return motion_; }

    /// Lets the next frame follow the frames that `motion` comes from.
    void continueFrom(const Motion& motion) { motion_ = motion; }

    /// Whether the light reaches so few of the pixels that Shading::Auto leaves the sun out.
    static bool isNextToNothing(std::uint64_t litPixels, const plan::View& view);

    /// Whether the last frame has a ground, in view or not.
    bool hasGround() const { return ground_ != nullptr; }

    /// Forgets the frames before, so that the next plan depends on its view alone.
    void forget() {
        motion_ = {};
        heldMaps_.clear();
    }

    /// Plans and cuts a view as the frame after `before` (null: the first), and makes its pages resident. Draws
    /// nothing, and the next frame does not know of it. The cut reaches `margin` pixels beyond the image.
    PreparedFrame prepare(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before,
        double margin = 0);

    /// Draws a frame, one that was drawn before too, as long as it is the last that was prepared. Its plan then says
    /// which maps were used again.
    executor::DrawStatistics draw(PreparedFrame& frame, const FrameOptions& options);

    /// Draws the image of the last frame that was rendered once more, one with `isAccumulated`, where `options` samples
    /// its pixels: by the same cut. The maps are drawn again if `options` move them.
    void drawSample(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the view of `frame` in light from another direction, of any length above 0, planned and cut anew with the
    /// same kind of shadows, once all of that is resident; `options` say of which light. No frame to come knows of it;
    /// `frame` itself cannot be drawn again.
    void drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options);

    /// What the executor gets to draw `frame`, which must outlive it.
    executor::FrameDrawing drawing(const PreparedFrame& frame, const FrameOptions& options) const;

    /// Keeps room for the picture of a frame that is still to come.
    void reservePicture(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) {
        residency_.reservePicture(picturePart(view, quality, options));
    }

    /// What the frames since the last call miss of the error that was asked for. Small pictures that only decide
    /// something are to be taken out so.
    telemetry::Shortfall takeShortfall() { return std::exchange(shortfall_, {}); }

    const Residency& residency() const { return residency_; }

    Residency& residency() { return residency_; }

    const hierarchy::ModelFile& model() const { return *model_; }

    executor::Executor& executor() const { return *executor_; }

private:
    /// Does the work of `prepare` for the ground that is set, without penumbrae and sky.
    PreparedFrame prepareShadows(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before,
        double margin);

    /// The capabilities that plans are made for.
    plan::Capabilities capabilities() const { return plannedFor_.value_or(executor_->capabilities()); }

    /// Plans `frame` by its facts.
    void planAnew(PreparedFrame& frame, const plan::View& view, const plan::Quality& quality) const;

    /// Whether a frame of `view` with `quality` continues the motion of the frame before.
    bool continuesMotion(const plan::View& view, const plan::Quality& quality) const;

    /// The frame before, without the memory that steadies a plan unless `view` continues its motion.
    std::shared_ptr<const plan::PlannedFrame> frameBefore(const plan::View& view, const plan::Quality& quality) const;

    std::optional<bool> isWithoutSun(const Frame& frame) const;
    executor::DrawStatistics drawWithOrWithoutSun(Frame& frame);
    Bytes picturePart(const plan::View& view, const plan::Quality& quality, const FrameOptions& options) const;
    void chooseOcclusion(PreparedFrame& frame) const;

    const hierarchy::ModelFile* model_;
    executor::Executor* executor_;
    std::optional<plan::Capabilities> plannedFor_;
    Residency residency_;
    Motion motion_;
    HeldMaps heldMaps_;
    telemetry::Shortfall shortfall_;
    std::vector<culling::DepthCandidate> depthScratch_;
    std::shared_ptr<const Ground> ground_; // of the view that is prepared
    std::shared_ptr<executor::SectionMemory> sections_;
};

} // namespace gnomon::frame
