// Validates a drawn frame against ray tracing, its aliasing bound, the finest level of detail and the previous frame.
#pragma once

#include "frame/renderer.h"
#include "validation/crawl.h"
#include "validation/ground_truth_kind.h"
#include "validation/measured_aliasing.h"
#include "validation/shadow_truth.h"

#include <array>
#include <optional>

namespace gnomon::validation {

/// The measurements that the caller requests for a frame.
struct ValidationOptions {
    bool measuresAliasing = false;
    bool measuresCrawl = false; // compares with the previous frame, if it also had maps
    GroundTruth groundTruth = GroundTruth::None;
    bool countsWrongPixels = false;  // counts wrong pixels as GroundTruth::Exact does, but independent of `groundTruth`
    bool comparesWithFinest = false; // compares the picture with the finest level of detail with ray-traced shadows
};

/// The results of the measurements.
struct FrameValidation {
    std::optional<MeasuredAliasing> aliasing; // only for a frame with maps
    std::optional<ShadowTruth> truth;         // only for a frame with maps
    std::optional<Crawl> crawl;               // only if this frame and the previous frame have maps
    // mean difference to the picture of the finest level, as a fraction of full scale
    std::optional<double> imageDifference;
    // fraction of all pixels that differ from the result by integer arithmetic; for any frame with shadows
    std::optional<double> wrongPixelsAll;
};

/// Measures `frame`, the last frame of `renderer`, as `options` request. The function draws additional frames, whose
/// time is not measured:
/// - the frame with its surfaces and without overlay;
/// - the finest level of detail with rays, for `comparesWithFinest`;
/// - the previous frame, for the crawl;
/// - at the end `frame` again, so that its picture and pages are available.
/// Later frames do not depend on this function. For a frame with an observer camera, the function draws nothing and
/// returns an empty result. Throws Error, for example if the memory is too small for GroundTruth::FullDetail or if
/// pages for it are damaged.
FrameValidation validate(frame::Renderer& renderer, const frame::Frame& frame, const ValidationOptions& options);

/// Fills the accuracy columns of `row`. If `proof` lacks a measurement, its column becomes empty.
void setAccuracy(const FrameValidation& proof, telemetry::FrameRow& row);

} // namespace gnomon::validation
