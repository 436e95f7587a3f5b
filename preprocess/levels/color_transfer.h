// Colour transfer: the colours of a simplified patch, fitted to those of the patch that it replaces, and what that
// leaves wrong; its fields likewise, which nothing is charged for.
#pragma once

#include "preprocess/levels/channel_fit.h"

namespace gnomon::levels {

struct ColorTransfer {
    std::vector<TransferredWord> colors; // RGBA8, of vertices that `simplified` keeps and that change, ascending
    double error = 0;                    // grid steps
};

/// The charge of what is `difference` (of a channel, 0..1) off in colour where vertices moved by `length`: how far the
/// wrong colour reaches, times what of the difference exceeds what is seen, in units of what a pixel may be wrong by.
double colorCharge(double length, double difference);

/// New colours for the vertices that `simplified` keeps, by ChannelFit. The error is the largest `colorCharge` of what
/// is off after that.
ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

/// New words of fields, by ChannelFit; none where the patch has no fields.
std::vector<TransferredWord> transferredFields(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified);

} // namespace gnomon::levels
