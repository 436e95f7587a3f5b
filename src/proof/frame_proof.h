// What a frame that was drawn is held against: rays, the promise of its plan, the finest level, the frame before.
#pragma once

#include "core/words.h"
#include "frame/renderer.h"
#include "proof/crawl.h"
#include "proof/measured_aliasing.h"
#include "proof/shadow_truth.h"

#include <array>
#include <optional>

namespace gnomon::proof {

/// What the shadows of a frame are held against.
enum class Oracle : std::uint8_t {
    None,
    SameDetail, // rays against what the maps' cut draws in the whole frustum's caster volume
    FullDetail, // rays against the finest level there
    Exact,      // integers against what the frame's cut draws there
};

/// Those of them that compare.
inline constexpr std::array kOracles = {
    Word<Oracle>{Oracle::SameDetail, "same"},
    Word<Oracle>{Oracle::FullDetail, "full"},
    Word<Oracle>{Oracle::Exact, "exact"},
};

/// Whether shadow maps alone can be held against it.
constexpr bool isOfMaps(Oracle oracle) {
    return oracle == Oracle::SameDetail || oracle == Oracle::FullDetail;
}

/// What is to be found out about a frame.
struct ProofOptions {
    bool measuresAliasing = false;
    bool measuresCrawl = false; // against the frame before, if that had maps too
    Oracle oracle = Oracle::None;
    bool countsWrongPixels = false;  // as Oracle::Exact does, whatever the oracle
    bool comparesWithFinest = false; // the picture with that of the finest level in ray-traced shadows
};

/// What was found out.
struct FrameProof {
    std::optional<MeasuredAliasing> aliasing; // of a frame with maps
    std::optional<ShadowTruth> truth;         // of a frame with maps
    std::optional<Crawl> crawl;               // of a frame with maps after one with maps
    std::optional<double> imageDifference;    // mean, fraction of full scale
    std::optional<double> wrongPixelsAll;     // share of all pixels, by integers; of any frame with shadows
};

/// Holds `frame`, the last one that `renderer` drew, against what `options` name. Each of these is drawn, untimed: the
/// frame with its surfaces, without overlay; the finest level by rays, for `comparesWithFinest`; the frame before, for
/// the crawl; and at the end `frame` again as it was, whose picture and pages are then there. The frames to come do not
/// depend on it. Draws and finds nothing for a frame that an observer camera sees. Throws Error, also where the memory
/// does not hold what Oracle::FullDetail takes, or some of that is damaged.
FrameProof prove(frame::Renderer& renderer, const frame::Frame& frame, const ProofOptions& options);

/// Fills the columns of accuracy of `row`: those that `proof` knows nothing of become empty.
void setAccuracy(const FrameProof& proof, telemetry::FrameRow& row);

} // namespace gnomon::proof
