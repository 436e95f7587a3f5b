// From a model and a view to a picture and a row of the log: plan, cut, cull per partition, shadow passes, image pass.
#pragma once

#include "hierarchy/model_file.h"
#include "plan/frame_plan.h"
#include "render/executor.h"
#include "render/residency.h"
#include "selection/cut.h"
#include "telemetry/frame_row.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::render {

/// What a frame is asked for besides view and quality.
struct FrameOptions {
    Waiting waiting = Waiting::UntilComplete;
    Overlay overlay = Overlay::None;
    bool wantsSurfaces = false;
    std::optional<Camera> onlooker; // sees the frame of the view from outside: its cut, its casters, its maps
};

/// What came of a frame besides its picture. The cut's pages stay resident until the next frame.
struct Frame {
    plan::FramePlan plan;
    DrawSpace space;
    selection::Cut cut; // lists: the image's, then one a shadow pass
    telemetry::FrameRow row;
};

/// Draws a model frame by frame.
class Renderer {
public:
    /// `model` and `executor` must outlive it. Throws Error if the root is damaged or the memory is less than the
    /// tables take.
    Renderer(const hierarchy::ModelFile& model, Executor& executor, ResidencyOptions options);

    /// The frame of a view; the executor holds its picture.
    Frame render(const plan::View& view, const plan::Quality& quality, const FrameOptions& options);

    /// The plan alone, refined with what the hierarchy answers; nothing is drawn.
    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality);

    /// Forgets the frames before, so that the next plan depends on its view alone.
    void forget() { previous_.reset(); }

private:
    struct Prepared;

    Prepared prepare(const plan::View& view, const plan::Quality& quality, Waiting waiting);
    Prepared planAndCut(const plan::View& view, const plan::Quality& quality);
    void cutImage(Prepared& prepared) const;
    void cutAll(Prepared& prepared) const;
    void cut(Prepared& prepared) const;
    selection::CutQuery query(const Prepared& prepared) const;
    plan::SceneFacts factsOf(const plan::View& view, const selection::Cut& cut) const;
    FrameDrawing drawing(const Prepared& prepared, const FrameOptions& options) const;
    telemetry::FrameRow logged(const Prepared& prepared, const DrawStatistics& drawn) const;

    const hierarchy::ModelFile* model_;
    Executor* executor_;
    Residency residency_;
    std::optional<plan::FramePlan> previous_;
};

} // namespace gnomon::render
