// A hilly field with seeded views and qualities, for the comparison of backends.
#pragma once

#include "render/backend.h"
#include "tests/support/tiny_model.h"

namespace gnomon::render {

constexpr int kFieldSide = 256; // width and height of its pictures, in pixels

/// The finest clusters of a hilly field. The image and each map draw all of them.
class Field {
public:
    Field();

    /// Returns a view from above or among the hills. Every sixth view is orthographic.
    plan::View view(std::uint64_t seed) const;

    plan::FramePlan plan(const plan::View& view, const plan::Quality& quality) const;

    /// Returns the drawing of a plan, which must outlive it.
    DrawInputs drawing(const plan::FramePlan& plan) const;

    /// Returns every third cluster, alternately pending and damaged.
    std::vector<LodSubstitute> someSubstitutes() const;

    const tests::TinyModel& model() const { return model_; }

private:
    tests::TinyModel model_;
    lod::DrawList all_;
};

/// Returns a quality with varying warps, slices, faces, stabilised slices, filters, shadings and backgrounds. Every
/// eleventh has no shadows.
plan::Quality fieldQuality(std::uint64_t seed);

/// Returns the same quality as fieldQuality. A third of the seeds without stabilised slices use logarithmic rows.
plan::Quality softwareQuality(std::uint64_t seed);

} // namespace gnomon::render
