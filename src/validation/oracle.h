// The kinds of ground truth for the shadows of a frame.
#pragma once

#include "core/words.h"

#include <array>
#include <cstdint>

namespace gnomon::validation {

/// The ground truth (option --oracle) for the shadows of a frame.
enum class Oracle : std::uint8_t {
    None,
    SameDetail, // rays against the cut of the maps, in the caster volume of the whole frustum
    FullDetail, // rays against the finest level in that volume
    Exact,      // integer arithmetic against the cut of the frame in that volume
};

/// All kinds of ground truth except None.
inline constexpr std::array kOracles = {
    Word<Oracle>{Oracle::SameDetail, "same"},
    Word<Oracle>{Oracle::FullDetail, "full"},
    Word<Oracle>{Oracle::Exact, "exact"},
};

/// Returns true if this ground truth requires shadow maps.
constexpr bool isOfMaps(Oracle oracle) {
    return oracle == Oracle::SameDetail || oracle == Oracle::FullDetail;
}

} // namespace gnomon::validation
