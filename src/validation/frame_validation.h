// Validates a drawn frame against ray tracing, its aliasing bound, the finest level of detail and the previous frame.
#pragma once

#include "frame/renderer.h"
#include "validation/crawl.h"
#include "validation/ground_truth_kind.h"
#include "validation/measured_aliasing.h"
#include "validation/shadow_classes.h"
#include "validation/shadow_truth.h"

#include <array>
#include <optional>

namespace gnomon::validation {

/// The measurements that the caller requests for a frame.
struct ValidationOptions {
    bool measuresAliasing = false;
    bool measuresCrawl = false; // compares the shadows with the previous frame, if it also had shadow maps
    GroundTruth groundTruth = GroundTruth::None;
    // counts the pixels that differ from exact integer shadows (GroundTruth::Exact), even if `groundTruth` is another
    // kind
    bool countsWrongPixels = false;
    bool classifiesPixels = false;   // by the ground truth if it is GroundTruth::Exact, otherwise as drawn
    bool comparesWithFinest = false; // compares the picture with the finest level of detail with ray-traced shadows
};

/// The results of measuring the accuracy of a frame.
struct FrameValidation {
    std::optional<MeasuredAliasing> aliasing; // only for a frame with shadow maps
    std::optional<ShadowTruth> truth;         // only for a frame with shadow maps
    std::optional<Crawl> crawl;               // only if this frame and the previous frame have shadow maps
    // mean difference to the picture of the finest level of detail, as a fraction of full scale
    std::optional<double> imageDifference;
    // fraction of all pixels whose shadow differs from the result by integer arithmetic; for any frame with shadows
    std::optional<double> wrongPixelsAll;
    std::optional<render::Raster<ShadowClass>> classes; // only if `classifiesPixels`
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

/// Fills the accuracy columns of the log row `row` with the measurements in `proof`. If a measurement is missing, its
/// column becomes empty.
void setAccuracy(const FrameValidation& proof, telemetry::FrameRow& row);

} // namespace gnomon::validation
