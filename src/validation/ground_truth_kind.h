// The kinds of ground truth for the shadows of a frame.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::validation {

/// The ground truth (option --oracle) for the shadows of a frame.
enum class GroundTruth : std::uint8_t {
    None,
    SameDetail, // rays against the clusters that the maps draw, in the caster volume of the whole frustum
    FullDetail, // rays against the finest level of detail in the same volume
    Exact,      // integer arithmetic against the clusters of the frame's cut in the same volume
};

/// All kinds of ground truth except None.
inline constexpr std::array kGroundTruths = {
    Word<GroundTruth>{GroundTruth::SameDetail, "same"},
    Word<GroundTruth>{GroundTruth::FullDetail, "full"},
    Word<GroundTruth>{GroundTruth::Exact, "exact"},
};

/// Returns true if this ground truth requires shadow maps.
constexpr bool isOfMaps(GroundTruth groundTruth) {
    return groundTruth == GroundTruth::SameDetail || groundTruth == GroundTruth::FullDetail;
}

} // namespace gnomon::validation
