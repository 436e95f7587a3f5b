#include "preprocess/levels/color_transfer.h"

#include <algorithm>

namespace gnomon::levels {

namespace {

/// Colours are RGBA8: four channels of 8 bits.
constexpr hierarchy::FieldLayout kColorLayout = {{8, 8, 8, 8}};

bool isPlain(const std::vector<std::uint32_t>& words) {
    return std::ranges::all_of(words, [&](std::uint32_t word) { return word == words.front(); });
}

} // namespace

ColorTransfer transferredColors(const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    std::vector<std::uint32_t> colors;
    colors.reserve(patch.vertices.size());
    for (const hierarchy::Vertex& vertex : patch.vertices)
        colors.push_back(vertex.color);
    if (isPlain(colors)) return {};
    ChannelFit fit(patch, simplified, std::move(colors), kColorLayout);
    ColorTransfer result{fit.run(), simplified.layerCharge};
    fit.forEachDifference([&](double length, double difference) {
        result.error = std::max(result.error, simplify::colorCharge(length, difference));
    });
    return result;
}

std::vector<TransferredWord> transferredFields(
    const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    if (isPlain(patch.fields.words)) return {};
    return ChannelFit(patch, simplified, patch.fields.words, patch.fields.layout).run();
}

} // namespace gnomon::levels
