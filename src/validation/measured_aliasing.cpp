#include "validation/measured_aliasing.h"

#include "validation/texel_footprint.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::validation {

namespace {

void keepLarger(MeasuredAliasing& all, const MeasuredAliasing& part) {
    all.x = std::max(all.x, part.x);
    all.z = std::max(all.z, part.z);
    all.overBound = std::max(all.overBound, part.overBound);
    all.pixelsMeasured += part.pixelsMeasured;
    all.pixelsWithoutBound += part.pixelsWithoutBound;
}

} // namespace

MeasuredAliasing measuredAliasing(
    const render::DrawInputs& frame, const render::Raster<render::SurfaceSample>& surfaces) {
    const plan::FramePlan& plan = *frame.plan;
    const render::CameraRelativeSpace& space = frame.space;
    std::vector<TexelProbe> probes;
    for (const plan::ShadowPass& pass : plan.passes)
        probes.emplace_back(frame, pass.map);
    const double kernel = std::max(1, plan.quality.filter);
    std::vector<MeasuredAliasing> rows(static_cast<std::size_t>(surfaces.height));
    tbb::parallel_for(0, surfaces.height, [&](int y) {
        MeasuredAliasing& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < surfaces.width; ++x) {
            const render::SurfaceSample& surface = surfaces.at(x, y);
            if (!surface.isLitSide() || surface.partition() < 0) continue;
            const glm::dvec3 p(surface.position);
            const double depth = glm::dot(plan.basis.view, p - space.eye);
            if (!(depth >= plan.near && depth <= plan.far)) {
                ++row.pixelsWithoutBound;
                continue;
            }
            const auto partition = static_cast<std::size_t>(surface.partition());
            const double pixel = render::pixelWidth(plan, space, p);
            const TexelWidths texel = probes[partition].widths(p, kStepOverPixel * pixel);
            const shadow::AliasingBound& aliasingBound = plan.passes[partition].map.aliasingBound;
            MeasuredAliasing one{texel.x / pixel * kernel, texel.z / pixel * kernel, 0, 1, 0};
            one.overBound = std::max(one.x / aliasingBound.x, one.z / aliasingBound.z);
            keepLarger(row, one);
        }
    });
    MeasuredAliasing result;
    for (const MeasuredAliasing& row : rows)
        keepLarger(result, row);
    return result;
}

} // namespace gnomon::validation
