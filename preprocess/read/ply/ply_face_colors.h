// Reads the face colours of a PLY file.
#pragma once

#include "preprocess/read/ply/ply_layout.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace gnomon::read {

/// Reads all faces of the PLY element `element`. Calls `use(corners, channels)` for each face with its vertex indices
/// and its four colour channels. A channel has no value if the file has no property for it.
template <class Values, class Use>
void readColoredFaces(
    Values& values, const PlyElement& element, const ColorLayout& layout, std::uint64_t vertexCount, Use use) {
    const int list = indexListOf(element);
    std::vector<std::uint64_t> corners;
    values.beginElement(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        std::array<std::optional<double>, 4> channels;
        for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
            const PlyProperty& property = element.properties[static_cast<std::size_t>(i)];
            const auto* const channel = std::find(layout.begin(), layout.end(), i);
            if (i == list)
                readCorners(values, property, vertexCount, corners);
            else if (channel != layout.end())
                channels[static_cast<std::size_t>(channel - layout.begin())] = values.real(property.type);
            else
                skipProperty(values, property);
        }
        values.endRow();
        use(std::span<const std::uint64_t>(corners), channels);
    }
}

/// Converts the colour `channels` to RGBA8. The value `full` of a channel becomes 255. A missing channel becomes 255.
inline std::uint32_t colorOf(
    const PlyElement& element,
    const ColorLayout& layout,
    const std::array<double, 4>& full,
    const std::array<std::optional<double>, 4>& channels) {
    std::uint32_t color = 0;
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
        const int index = layout[channel];
        const PlyType type = index < 0 ? PlyType::Float64 : element.properties[static_cast<std::size_t>(index)].type;
        color |= std::uint32_t{colorByte(type, channels[channel].value_or(full[channel]), full[channel])}
                 << (8 * channel);
    }
    return color;
}

} // namespace gnomon::read
