#include "frame/frame_row.h"

#include "core/angle.h"

namespace gnomon::frame {

namespace {

std::int64_t toCount(std::uint64_t value) {
    return static_cast<std::int64_t>(value);
}

void setExact(const exact::ExactStatistics& exact, telemetry::FrameRow& row) {
    row.shadowSamples = toCount(exact.samples);
    row.shadowCells = toCount(exact.cells);
    row.sampleTests = toCount(exact.counts.sampleTests);
    row.exactDecisions = toCount(exact.counts.exactDecisions);
    row.pixelsWithinTolerance = toCount(exact.withinTolerance);
    row.shadowTriangles = toCount(exact.counts.trianglesRasterized);
    row.castersTested = toCount(exact.counts.clustersTested);
    row.castersKept = toCount(exact.counts.clustersKept);
}

void setCulled(const render::CulledCasters& culled, telemetry::FrameRow& row) {
    row.shadowMapsDrawn = toCount(culled.mapsDrawn);
    row.shadowTriangles = toCount(culled.triangles);
    row.castersKept = toCount(culled.clustersKept);
}

/// Writes the statistics of the shadow passes to `row`: numbers of drawn maps, triangles and tested casters.
void setCasters(const PreparedFrame& frame, const render::DrawStatistics& drawn, telemetry::FrameRow& row) {
    const plan::FramePlan& plan = frame.plan;
    row.shadowMapsDrawn = 0;
    std::uint64_t shadowTriangles = 0;
    std::uint64_t castersKept = 0;
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        if (!plan.passes[p].isReused) {
            ++row.shadowMapsDrawn;
            shadowTriangles += frame.cut.lists.casters[p].triangles;
        }
        castersKept += frame.cut.lists.casters[p].clusters;
    }
    row.shadowTriangles = toCount(shadowTriangles);
    if (drawn.shadows.fragments) row.shadowFragments = toCount(*drawn.shadows.fragments);
    row.castersKept = toCount(castersKept);
    row.castersTested = toCount(plan.passes.empty() ? 0 : frame.cut.clustersTested);
    if (drawn.culled) setCulled(*drawn.culled, row);
}

/// Returns the name of the caster culling with which the shadow maps were drawn.
std::string_view cullingOf(const plan::FramePlan& plan, const render::DrawStatistics& drawn) {
    const bool isWhole = !drawn.culled && plan.casterCulling == plan::CasterCulling::Receivers;
    return wordOf(plan::kCasterCullings, isWhole ? plan::CasterCulling::On : plan.casterCulling);
}

} // namespace

telemetry::FrameRow frameRow(
    const PreparedFrame& frame, const render::DrawStatistics& drawn, const FrameSource& source) {
    const plan::FramePlan& plan = frame.plan;
    const plan::Quality& quality = plan.quality;
    telemetry::FrameRow row;
    row.model = source.model;
    row.scheme = plan::schemeName(plan);
    row.warp = shadow::name(quality.warp.rule);
    row.zPartitions = plan.splits.empty() ? 0 : toCount(plan.splits.size() - 1);
    row.facePartitions = plan.hasFaces ? "on" : "off";
    row.stabilize = quality.stabilize;
    row.filter = quality.filter;
    row.shadowMaps = toCount(plan.passes.size());
    if (!plan.passes.empty()) row.cullCasters = cullingOf(plan, drawn);
    row.shadowTexels = std::to_string(quality.shadowTexelsWidth) + "x" + std::to_string(quality.shadowTexelsHeight);
    row.errorPixels = quality.errorPixels;
    row.width = plan.view.width;
    row.height = plan.view.height;
    row.imageWidthDrawn = plan.view.width;
    row.samplesPerPixel = 1;
    row.backend = source.backend;
    row.planMs = frame.planMs;
    row.selectMs = frame.selectMs;
    row.cullMs = frame.cullMs;
    row.streamMs = frame.streamMs;
    row.shadowMs = drawn.shadows.time.count;
    row.imageMs = drawn.image.time.count;
    row.imageTriangles = toCount(frame.cut.lists.image.triangles);
    setCasters(frame, drawn, row);
    row.drawCalls = toCount(drawn.shadows.drawCalls + drawn.image.drawCalls);
    row.residentBytes = toCount(source.residency.resident.count + source.trees.count);
    row.gpuBytes = toCount(drawn.deviceMemory.count);
    row.bytesRead = toCount(source.residency.read.count);
    row.pagesRead = toCount(source.residency.pagesRead);
    row.pagesMissing = toCount(frame.residency.pagesMissing);
    row.pagesDamaged = toCount(source.residency.pagesDamaged);
    row.achievedErrorPixels = frame.cut.achievedErrorPixels;
    row.near = plan::depthFromAskedEye(plan, plan.near);
    row.far = plan::depthFromAskedEye(plan, plan.far);
    row.depthRatio = plan.far / plan.near;
    row.lightAngle = degreesFromRadians(plan.lightAngleRadians);
    row.occlusion = plan.skipsHidden ? "on" : "off";
    if (drawn.image.occlusion) {
        row.clustersHidden = toCount(drawn.image.occlusion->clustersHidden);
        row.trianglesSetUp = toCount(drawn.image.occlusion->trianglesSetUp);
    }
    row.shadows = wordOf(plan::kShadowModes, quality.shadows);
    if (drawn.exact) setExact(*drawn.exact, row);
    if (plan.passes.empty()) return row;
    row.storageFactor = plan.storageFactor;
    row.aliasingBoundX = plan.aliasingBound.x;
    row.aliasingBoundZ = plan.aliasingBound.z;
    row.isBoundKept = plan.isBoundKept;
    return row;
}

} // namespace gnomon::frame
