// Transfers the colours and fields of the vertices of a patch to the simplified patch. Measures the remaining error of
// the colours, but not of the fields.
#pragma once

#include "preprocess/levels/channel_fit.h"
#include "preprocess/simplify/color_charge.h"

namespace gnomon::levels {

/// The new vertex colours of a simplified patch and their remaining error.
struct ColorTransfer {
    std::vector<TransferredWord> colors; // RGBA8 colours of the changed vertices of `simplified`, by ascending vertex
    double error = 0;                    // remaining error in grid steps
};

/// Returns new vertex colours for `simplified`, fitted to the colours of `patch` by ChannelFit. The error is the max
/// `colorCharge` over the remaining colour differences.
ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

/// Returns new packed vertex fields for `simplified`, fitted to the fields of `patch` by ChannelFit. Returns an empty
/// list if all vertices have the same fields or the patch has no fields.
std::vector<TransferredWord> transferredFields(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
