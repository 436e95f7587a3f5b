#include "preprocess/read/off/off_colors.h"

#include "preprocess/read/color_range.h"
#include "preprocess/read/face_color_splitter.h"

#include <algorithm>
#include <cmath>

namespace gnomon::read {

void OffColors::add(std::uint64_t row, std::span<const double> channels) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
        double& max = i < 3 ? max_ : maxAlpha_;
        if (std::isfinite(channels[i])) max = std::max(max, channels[i]);
        isBelowZero_ = isBelowZero_ || channels[i] < 0;
        areIntegers_ = areIntegers_ && channels[i] == std::floor(channels[i]);
    }
    colors_.push_back({row, {channels[0], channels[1], channels[2], channels.size() > 3 ? channels[3] : -1}});
}

std::uint32_t OffColors::packed(const Color& color) const {
    const std::uint32_t channels = packedChannels(glm::dvec4(color.channels), fullOfReals(max_)) & 0xFFFFFFU;
    const std::uint32_t alpha =
        color.channels.a < 0 ? 255U : channelByte(double{color.channels.a}, fullOfReals(maxAlpha_));
    return channels | alpha << 24U;
}

std::uint64_t OffColors::clearCount() const {
    return static_cast<std::uint64_t>(std::count_if(
        colors_.begin(), colors_.end(), [this](const Color& color) { return packed(color) >> 24U != 255U; }));
}

std::vector<std::uint32_t> OffColors::packed(std::uint64_t rows) const {
    std::vector<std::uint32_t> all(rows, kNoColor);
    for (const Color& color : colors_)
        all[color.row] = packed(color);
    return all;
}

std::string OffColors::remark(const std::string& ofWhat) const {
    if (fullOfReals(max_) == 1) return "colours of " + ofWhat + " range from 0 to 1, because none exceeds 1";
    if (areIntegers_) return {};
    return "colours of " + ofWhat + ", which are real numbers, range from 0 to 255, because one exceeds 1";
}

MemoryMesh withOffColors(
    MemoryMesh mesh, const OffRowColors& colors, bool isAnnounced, const std::string& path, Bytes memoryLimit) {
    const auto drop = [&](const char* name, std::uint64_t count) {
        if (count > 0) mesh.attributesDropped[name] += count;
    };
    const bool hasVertices = colors.vertices.areColors() || (isAnnounced && colors.vertices.count() > 0);
    const bool hasFaces = !hasVertices && colors.faces.areColors();
    if (!hasVertices) drop("other values of vertices", colors.vertices.count());
    if (!hasFaces) drop("face colours", colors.faces.count());
    if (!hasVertices && !hasFaces) return mesh;
    const OffColors& kept = hasVertices ? colors.vertices : colors.faces;
    drop("alpha", kept.clearCount());
    if (const std::string remark = kept.remark(hasVertices ? "vertices" : "faces"); !remark.empty())
        mesh.remarks.push_back(path + ": " + remark);
    if (!hasVertices) {
        std::vector<std::uint32_t> packed = kept.packed(mesh.faceSizes.size());
        return withFaceColors(std::move(mesh), std::move(packed), path, memoryLimit);
    }
    mesh.colors = kept.packed(mesh.positions.size());
    return mesh;
}

} // namespace gnomon::read
