// Colour transfer: the colours of a simplified patch, fitted to those of the patch that it replaces, and what that
// leaves wrong; its fields likewise, which nothing is charged for.
#pragma once

#include "preprocess/levels/channel_fit.h"
#include "preprocess/simplify/color_charge.h"

namespace gnomon::levels {

struct ColorTransfer {
    std::vector<TransferredWord> colors; // RGBA8, of vertices that `simplified` keeps and that change, ascending
    double error = 0;                    // grid steps
};

/// New colours for the vertices that `simplified` keeps, by ChannelFit. The error is the largest `colorCharge` of what
/// is off after that.
ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

/// New words of fields, by ChannelFit; none where the patch has no fields.
std::vector<TransferredWord> transferredFields(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
