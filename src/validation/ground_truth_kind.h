// The kinds of ground truth for the shadows of a frame.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::validation {

/// The kind of ground truth with which the shadows of a frame are compared (option --oracle).
enum class GroundTruth : std::uint8_t {
    None,
    SameDetail, // rays against the clusters that the shadow maps draw, in the caster volume of the whole frustum
    FullDetail, // rays against the finest level of detail in the same volume
    Exact,      // integer arithmetic against the frame's selected clusters in the same volume
};

/// All kinds of ground truth except None.
inline constexpr std::array kGroundTruths = {
    Word<GroundTruth>{GroundTruth::SameDetail, "same"},
    Word<GroundTruth>{GroundTruth::FullDetail, "full"},
    Word<GroundTruth>{GroundTruth::Exact, "exact"},
};

/// Returns true if this kind of ground truth can only be used for frames with shadow maps.
constexpr bool isOfMaps(GroundTruth groundTruth) {
    return groundTruth == GroundTruth::SameDetail || groundTruth == GroundTruth::FullDetail;
}

} // namespace gnomon::validation
