// Transfers colours and fields from a patch to its simplified version, and measures the remaining error of the colours.
// Errors of fields are not measured.
#pragma once

#include "preprocess/levels/channel_fit.h"
#include "preprocess/simplify/color_charge.h"

namespace gnomon::levels {

/// The new colours of a simplified patch and their remaining error.
struct ColorTransfer {
    std::vector<TransferredWord> colors; // RGBA8 colours of the changed vertices of `simplified`, by ascending vertex
    double error = 0;                    // remaining error in grid steps
};

/// Returns new colours for the vertices of `simplified`, which ChannelFit computes. The error of the result is the max
/// `colorCharge` over the remaining colour differences.
ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

/// Returns new packed fields for the vertices of `simplified`, which ChannelFit computes. Returns an empty list if all
/// vertices have the same fields or the patch has no fields.
std::vector<TransferredWord> transferredFields(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
