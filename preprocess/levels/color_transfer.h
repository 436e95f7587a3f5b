// Transfers colours and fields from a patch to its simplified version. Colours have a remaining error. Errors of fields
// are not measured.
#pragma once

#include "preprocess/levels/channel_fit.h"
#include "preprocess/simplify/color_charge.h"

namespace gnomon::levels {

/// The new colours of a simplified patch and their remaining error.
struct ColorTransfer {
    std::vector<TransferredWord> colors; // RGBA8 of changed vertices of `simplified`, by ascending vertex
    double error = 0;                    // remaining error in grid steps
};

/// Returns new colours for the vertices of `simplified`, computed by ChannelFit. The error is the max `colorCharge` of
/// the remaining differences.
ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

/// Returns new packed fields for the vertices of `simplified`, computed by ChannelFit. Returns an empty list if all
/// words are equal or the patch has no fields.
std::vector<TransferredWord> transferredFields(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
