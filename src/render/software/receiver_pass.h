// Culling of casters by receivers. The visible surfaces are found first, and those that face the light become
// receivers. The maps then draw only casters that can change a receiver. Finally the lit pixels receive their colour.
#pragma once

#include "render/image_pass.h"

namespace gnomon::render {

/// The receivers of one frame, and the casters that can shadow them. The object reuses its memory from frame to frame.
class ReceiverPass {
public:
    /// Shades the image as if all surfaces were in shadow, and collects the receivers. Only the size of `shadowDepth`
    /// is used. Returns the number of lit pixels that need no lookup in a map.
    std::uint64_t collect(const DrawInputs& frame, const ImageBuffers& buffers, const FloatPicture& shadowDepth);

    /// Returns true if no pixel looks up a texel of `box` in the depth texture. The box need not be drawn then.
    bool isUnseen(const raster::PixelBox& box) const { return mask_.isEmpty(box); }

    /// Returns the casters of map `pass` that can change a pixel. `view` is the view with which the map is drawn. Whole
    /// groups are culled first. The list is valid until the next call.
    const lod::DrawList& casters(const DrawInputs& frame, std::size_t pass, const raster::View& view);

    /// Returns true if `light` can complete the image. This is impossible if a filter kernel reads several texels, or
    /// if an overlay or surfaces are requested. The image must then be shaded again.
    bool canLight() const { return awaited_.isLitLater; }

    /// Draws the lit colour of all pixels that are lit according to the maps. Returns the number of pixels that count
    /// as lit.
    std::uint64_t light(const FloatPicture& shadowDepth, Picture& picture) const;

    /// Returns the number of clusters that `casters` tested since the last `collect`.
    std::uint64_t clustersTested() const { return clustersTested_; }

    /// Returns the memory of the arrays per pixel, in bytes.
    std::uint64_t bytes() const { return awaited_.pixels.size() * (3 * sizeof(std::uint32_t) + sizeof(float) + 1); }

private:
    exact::LookupMask mask_;
    AwaitedPixels awaited_;
    lod::DrawList kept_;
    // per range of a draw list: index of its first cluster among all clusters of the list
    std::vector<std::size_t> places_;
    std::vector<std::uint8_t> mayShadow_; // per cluster of a draw list: 1 if the cluster may shadow a receiver
    std::uint64_t clustersTested_ = 0;
};

} // namespace gnomon::render
