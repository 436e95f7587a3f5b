// Validation of a drawn frame against ray tracing, its aliasing bound, the finest level and the frame before.
#pragma once

#include "frame/renderer.h"
#include "validation/crawl.h"
#include "validation/ground_truth_kind.h"
#include "validation/measured_aliasing.h"
#include "validation/shadow_truth.h"

#include <array>
#include <optional>

namespace gnomon::validation {

/// The requested measurements of a frame.
struct ValidationOptions {
    bool measuresAliasing = false;
    bool measuresCrawl = false; // against the frame before, if that had maps too
    GroundTruth groundTruth = GroundTruth::None;
    bool countsWrongPixels = false;  // like GroundTruth::Exact, but independent of `groundTruth`
    bool comparesWithFinest = false; // compares the picture with the finest level in ray-traced shadows
};

/// The results of the measurements.
struct FrameValidation {
    std::optional<MeasuredAliasing> aliasing; // of a frame with maps
    std::optional<ShadowTruth> truth;         // of a frame with maps
    std::optional<Crawl> crawl;               // of a frame with maps after a frame with maps
    std::optional<double> imageDifference;    // mean, as a fraction of full scale
    std::optional<double> wrongPixelsAll;     // share of all pixels, by integer arithmetic; of any frame with shadows
};

/// Measures `frame`, the last frame of `renderer`, as `options` say. This draws additional frames without timing:
/// - the frame with its surfaces and without overlay;
/// - the finest level with rays, for `comparesWithFinest`;
/// - the frame before, for the crawl;
/// - at the end `frame` again, so that its picture and pages are available.
/// Later frames do not depend on this function. For a frame with an observer camera, it draws nothing and returns an
/// empty result. Throws Error, for example if the memory is too small for GroundTruth::FullDetail or its pages are
/// damaged.
FrameValidation validate(frame::Renderer& renderer, const frame::Frame& frame, const ValidationOptions& options);

/// Fills the accuracy columns of `row`. A column without a measurement in `proof` becomes empty.
void setAccuracy(const FrameValidation& proof, telemetry::FrameRow& row);

} // namespace gnomon::validation
