// Which vertices of separate pieces lie near each other, so that pieces can merge when no edge joins them.
#pragma once

#include "preprocess/simplify/patch.h"

namespace gnomon::simplify {

/// For each position of `patch` the nearest one of another connected piece, or kNone for locked positions
/// and those of large pieces; empty if the patch is one piece.
std::vector<std::uint32_t> nearestInOtherPieces(const Patch& patch);

} // namespace gnomon::simplify
