// From a model and a view to a picture and a row of the log: plan, cut, cull per partition, shadow passes, image pass.
#pragma once

#include "executor/executor.h"
#include "frame/residency.h"
#include "hierarchy/model_file.h"
#include "plan/frame_plan.h"
#include "proof/crawl.h"
#include "proof/measured_aliasing.h"
#include "proof/shadow_truth.h"
#include "selection/cut.h"
#include "telemetry/frame_row.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::frame {

/// What the shadows of a frame are held against, once its time is taken.
enum class Oracle : std::uint8_t {
    None,
    SameDetail, // rays against what the maps' cut draws in the whole frustum's caster volume
    FullDetail, // rays against the finest level there
};

/// Those of them that compare.
inline constexpr std::array kOracles = {
    Word<Oracle>{Oracle::SameDetail, "same"},
    Word<Oracle>{Oracle::FullDetail, "full"},
};

/// What a frame is asked for besides view and quality.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    executor::Overlay overlay = executor::Overlay::None;
    bool wantsSurfaces = false;
    bool reusesMaps = true; // where the frame before left the very same ones
    bool measuresAliasing = false;
    bool measuresCrawl = false; // against the frame before, if that had maps too
    Oracle oracle = Oracle::None;
    bool comparesWithFinest = false; // the picture with that of the finest level in ray-traced shadows
    std::optional<Camera> onlooker;  // sees the frame of the view from outside: its cut, its casters, its maps
};

/// What came of a frame besides its picture. The cut's pages stay resident until the next frame.
struct Frame {
    plan::FramePlan plan;
    executor::DrawSpace space;
    selection::Cut cut; // lists: the image's, then one a shadow pass
    telemetry::FrameRow row;
    std::optional<proof::MeasuredAliasing> aliasing; // of a frame with maps that was asked for it
    std::optional<proof::ShadowTruth> truth;         // of a frame with maps and an oracle
    std::optional<proof::Crawl> crawl;               // of a frame with maps after one with maps
};

/// Draws a model frame by frame.
class Renderer {
public:
    /// `model` and `executor` must outlive it. Throws Error if the root is damaged or the memory is less than the
    /// tables take.
    Renderer(const hierarchy::ModelFile& model, executor::Executor& executor, ResidencyOptions options);

    /// The frame of a view; the executor holds its picture.
    Frame render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

    /// The plan alone, refined with what the hierarchy answers; nothing is drawn.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Forgets the frames before, so that the next plan depends on its view alone.
    void forget() {
        previous_.reset();
        heldMaps_.reset();
    }

private:
    struct Prepared;

    Prepared prepare(const plan::View& view, const plan::Quality& quality, Waiting waiting);
    Prepared planAndCut(const plan::View& view, const plan::Quality& quality);
    void cutView(
        Prepared& prepared,
        const plan::View& view,
        const plan::Quality& quality,
        const std::optional<DepthSpan>& range) const;
    void cutAll(Prepared& prepared) const;
    void cut(Prepared& prepared, const plan::Quality& quality) const;
    selection::CutQuery query(const Prepared& prepared) const;
    executor::FrameDrawing drawing(const Prepared& prepared, const FrameOptions& options) const;
    executor::DrawStatistics draw(const Prepared& prepared, const executor::FrameDrawing& drawing);
    void reuseMaps(Prepared& prepared) const;
    ConvexVolume rayCasterVolume(const Prepared& prepared) const;
    selection::CasterDetail rayCasterDetail(const Prepared& prepared) const;
    void prove(const Prepared& prepared, const FrameOptions& options, Frame& frame);
    proof::ShadowTruth truth(const Prepared& prepared, const executor::FrameDrawing& drawing, Oracle oracle);
    Prepared finest(const Prepared& prepared);
    proof::Crawl crawlSince(
        const plan::FramePlan& before, const executor::FrameDrawing& now, const executor::FloatPicture& maps);
    telemetry::FrameRow logged(const Prepared& prepared, const executor::DrawStatistics& drawn) const;

    const hierarchy::ModelFile* model_;
    executor::Executor* executor_;
    Residency residency_;
    std::optional<plan::FramePlan> previous_;

    /// What the executor's depth texture holds.
    struct HeldMaps {
        plan::FramePlan plan;
        std::vector<std::vector<selection::ClusterRange>> casters; // by pass
    };

    std::optional<HeldMaps> heldMaps_;
};

} // namespace gnomon::frame
