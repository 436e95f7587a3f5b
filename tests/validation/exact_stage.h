// A model in exact shadows over the software backend, and what the plain integer loops say of its pixels.
#pragma once

#include "frame/renderer.h"
#include "render/exact_pass.h"
#include "render/software_backend.h"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace gnomon::validation {

/// The results of a frame.
struct Shot {
    std::optional<exact::ExactStatistics> exact;
    render::Picture picture;
    render::Raster<render::SurfaceSample> surfaces;
    std::size_t samples = 0;
    std::size_t wrong = 0; // pixels whose lit or dark result differs from the integers
};

/// Returns all counts of its statistics, or an empty list without statistics.
inline std::vector<std::uint64_t> countsOf(const Shot& shot) {
    if (!shot.exact) return {};
    const exact::ExactStatistics& s = *shot.exact;
    return {
        s.samples,
        s.cells,
        s.dark,
        s.darkWithoutTolerance,
        s.withinTolerance,
        s.counts.clustersTested,
        s.counts.clustersKept,
        s.counts.triangles,
        s.counts.trianglesRasterized,
        s.counts.sampleTests,
        s.counts.exactDecisions};
}

/// Returns true if the surface is lit. A surface that is half lit counts as lit.
inline bool isLit(const render::SurfaceSample& surface) {
    return surface.isLitSide() && surface.litFraction() >= 0.5F;
}

/// A model with a renderer over the software backend.
class Stage {
public:
    explicit Stage(const hierarchy::ModelFile& file) : file_(&file), renderer_(file, *backend_, {}) {}

    const Box& bounds() const { return file_->summary().bounds; }

    frame::PreparedFrame prepare(const plan::View& view, const plan::Quality& quality) {
        return renderer_.prepare(view, quality);
    }

    Shot draw(frame::PreparedFrame frame, const frame::FrameOptions& options = {}) {
        Shot shot;
        shot.exact = renderer_.draw(frame, options).exact;
        shot.picture = backend_->picture();
        if (options.wantsSurfaces) shot.surfaces = backend_->surfaces();
        return shot;
    }

    /// Draws with surfaces, and counts the pixels that differ from the simple loops over all casters of the frame.
    Shot judged(const frame::PreparedFrame& frame, frame::FrameOptions options = {}) {
        options.wantsSurfaces = true;
        Shot shot = draw(frame, options);
        render::DrawInputs drawing = renderer_.drawing(frame, options);
        drawing.exactCasters = &frame.cut.lists.casters.at(0);
        const render::Raster<std::uint8_t> truth = render::litByIntegers(drawing);
        EXPECT_EQ(truth.pixels.size(), shot.surfaces.pixels.size());
        for (std::size_t i = 0; i < truth.pixels.size(); ++i)
            shot.wrong += isLit(shot.surfaces.pixels[i]) != (truth.pixels[i] != 0) ? 1U : 0U;
        return shot;
    }

    frame::Renderer& renderer() { return renderer_; }

private:
    const hierarchy::ModelFile* file_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_;
};

inline plan::Quality exactQuality() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    return quality;
}

} // namespace gnomon::validation
