// A hilly field, and views and qualities by seed: what the executors are compared on.
#pragma once

#include "executor/executor.h"
#include "hierarchy/tiny_model.h"

namespace gnomon::executor {

constexpr int kFieldSide = 256; // pixels of its pictures

/// The finest clusters of a hilly field, drawn whole into the image and into every map.
class Field {
public:
    Field();

    /// A view from over or amid the hills; every sixth is orthographic.
    plan::View view(std::uint64_t seed) const;

    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality) const;

    /// The drawing of a plan that must outlive it.
    FrameDrawing drawing(const plan::FramePlan& plan) const;

    /// Every third cluster, awaited and damaged in turn.
    std::vector<LodSubstitute> someSubstitutes() const;

    const tests::TinyModel& model() const { return model_; }

private:
    tests::TinyModel model_;
    selection::DrawList all_;
};

/// Warps, slices, faces, stabilised slices, filters, shadings and backgrounds in turn; every eleventh without shadows.
plan::Quality fieldQuality(std::uint64_t seed);

/// The same, with logarithmic rows where `seed` is one of every three that are not stabilised.
plan::Quality softwareQuality(std::uint64_t seed);

} // namespace gnomon::executor
