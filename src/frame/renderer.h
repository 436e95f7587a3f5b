// From a model and a view to a picture and a row of the log: plan, cut, cull per partition, shadow passes, image pass.
#pragma once

#include "culling/receivers.h"
#include "frame/prepared_frame.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"
#include "telemetry/frame_row.h"

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::frame {

class ExactEstimate;

/// How a frame is drawn, besides view and quality.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    executor::Overlay overlay = executor::Overlay::None;
    bool wantsSurfaces = false;           // keep what the executor's `surfaces` returns
    bool reusesMaps = true;               // where the frame before left the very same ones
    bool wantsWholeMaps = false;          // to be looked at besides this image: receivers cull none of their casters
    std::optional<Camera> observerCamera; // sees the frame of the view from outside: its cut, its casters, its maps
    glm::dvec2 subpixel{0};               // where pixels are sampled, as FrameDrawing has it; at most half a pixel off
    bool isAccumulated = false;           // `drawSample` is to follow: the cut reaches half a pixel beyond the image,
                                          // maps are whole, and the executor keeps the light
    executor::LightPart lightPart = executor::LightPart::All;
    double skyWeight = 0;                          // as FrameDrawing has it
    std::optional<glm::vec3> groundShade;          // likewise
    std::shared_ptr<const shadow::TileMask> tiles; // likewise
};

/// A frame that was drawn once.
struct Frame : PreparedFrame {
    FrameOptions options;
    telemetry::FrameRow row;
};

/// What the executor's depth texture holds.
struct HeldMaps {
    plan::FramePlan plan;
    std::vector<std::vector<selection::ClusterRange>> casters; // by pass
    bool isCulled = false;                                     // by what the image looked up
    std::vector<selection::ClusterRange> image;                // that did
    FrameOptions options;
};

/// Draws a model frame by frame.
class Renderer {
public:
    /// `model` and `executor` must outlive it. Throws Error if the root is damaged or the memory is less than the
    /// tables take.
    Renderer(const hierarchy::ModelFile& model, executor::Executor& executor, ResidencyOptions options);

    /// The frame of a view; the executor holds its picture. Its plan is steadied by that of the frame before, unless
    /// the view is a jump from that one's (plan/view_jump.h).
    Frame render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

    /// The plan alone, refined with what the hierarchy answers; nothing is drawn.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Plans from now on for an executor that can do so much, which is not the one that draws.
    void planFor(const plan::ExecutorFacts& executor) { plannedFor_ = executor; }

    /// Forgets the frames before, so that the next plan depends on its view alone.
    void forget() {
        previous_.reset();
        wasSunless_ = false;
        heldMaps_.reset();
    }

    /// Chooses the mode of the shadows where it is left open; then plans and cuts a view as the frame after `before`
    /// (null: the first), and makes its pages resident; draws nothing, and the next frame does not know of it.
    PreparedFrame prepare(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before);

    /// Draws a frame, one that was drawn before too, as long as it is the last that was prepared.
    executor::DrawStatistics draw(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the image of the last frame that was rendered once more, one with `isAccumulated`, where `options` samples
    /// its pixels: by the same cut and the same maps, as the frame left them.
    void drawSample(const PreparedFrame& frame, const FrameOptions& options);

    /// Draws the view of `frame` in light from another direction, of any length above 0, planned and cut anew with the
    /// same kind of shadows, once all of that is resident; `options` say of which light. No frame to come knows of it;
    /// `frame` itself cannot be drawn again.
    void drawTowards(const Frame& frame, const glm::dvec3& towardsLight, const FrameOptions& options);

    /// What the executor gets to draw `frame`, which must outlive it.
    executor::FrameDrawing drawing(const PreparedFrame& frame, const FrameOptions& options) const;

    const Residency& residency() const { return residency_; }

    Residency& residency() { return residency_; }

    const hierarchy::ModelFile& model() const { return *model_; }

    executor::Executor& executor() const { return *executor_; }

private:
    /// `prepare`, but for what the plan says of penumbrae and sky.
    PreparedFrame prepareShadows(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before);

    /// The same for a view that a point light shines on.
    PreparedFrame prepareForPoint(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before);

    /// `prepare` with shadows whose mode is not left open.
    PreparedFrame prepareAs(
        const plan::View& view,
        const plan::Quality& quality,
        Waiting waiting,
        const std::shared_ptr<const plan::PlannedFrame>& before);

    /// Plans `frame` by its facts.
    void planAnew(PreparedFrame& frame, const plan::View& view, const plan::Quality& quality) const;

    /// Fits the maps of `frame`, which is planned and cut without having looked, to what it shows: draws that, plans
    /// and cuts again, until what is cut is what was looked at.
    void fitToView(PreparedFrame& frame, const plan::View& view, const plan::Quality& quality);

    /// Keeps nothing of the frames before that steadies a plan if `view` is a jump from the last one's.
    void forgetIfJumped(const plan::View& view);

    bool hasSunWrong(const Frame& frame) const;
    void chooseOcclusion(PreparedFrame& frame) const;
    void markReusedMaps(PreparedFrame& frame, const FrameOptions& options) const;
    void rememberMaps(const PreparedFrame& frame, const FrameOptions& options, bool isCulled);

    const hierarchy::ModelFile* model_;
    executor::Executor* executor_;
    std::optional<plan::ExecutorFacts> plannedFor_;
    Residency residency_;
    std::shared_ptr<const plan::PlannedFrame> previous_;
    std::optional<plan::View> viewBefore_; // as it was asked for; that of the frame before, as is:
    double farthestBefore_ = 0;            // depth that was seen
    bool wasSunless_ = false;              // the frame before
    double margin_ = 0;                    // pixels around the image that the cut reaches
    std::optional<HeldMaps> heldMaps_;
    std::vector<culling::DepthCandidate> depthScratch_;
    std::shared_ptr<const Ground> ground_;    // of the view that is prepared
    std::shared_ptr<ExactEstimate> estimate_; // its memory; made when first needed
    std::shared_ptr<executor::SectionMemory> sections_;
};

} // namespace gnomon::frame
