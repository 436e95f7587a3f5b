// The order image, maps, light for culling casters by receivers. Visible surfaces that face the light become receivers.
// Maps then draw only casters that can change a receiver. Finally the image is lit.
#pragma once

#include "render/image_pass.h"

namespace gnomon::render {

/// The receivers of one frame and the casters that can shadow them. Its memory is reused from frame to frame.
class ReceiverPass {
public:
    /// Shades the image as if all surfaces were in shadow, and collects the receivers. `shadowDepth` needs only the
    /// size of the depth texture. Returns the number of lit pixels that need no map.
    std::uint64_t collect(const DrawInputs& frame, const ImageBuffers& buffers, const FloatPicture& shadowDepth);

    /// Returns true if no pixel looks up `box` of the depth texture, so that it need not be drawn.
    bool isUnseen(const raster::PixelBox& box) const { return mask_.isEmpty(box); }

    /// Returns the casters of map `pass` that can change a pixel, for a map drawn with `view`. Whole groups are culled
    /// first. The list is valid until the next call.
    const lod::DrawList& casters(const DrawInputs& frame, std::size_t pass, const raster::View& view);

    /// Returns true if `light` can finish the image. It cannot if a filter kernel reads several texels, or if an
    /// overlay or surfaces are requested. The image is then shaded again.
    bool canLight() const { return awaited_.isLitLater; }

    /// Lights the pixels that the maps show as lit, and returns the number of pixels that count as lit.
    std::uint64_t light(const FloatPicture& shadowDepth, Picture& picture) const;

    /// Returns the number of clusters that `casters` tested since the last `collect`.
    std::uint64_t clustersTested() const { return clustersTested_; }

    /// Returns the size of the arrays per pixel.
    std::uint64_t bytes() const { return awaited_.pixels.size() * (3 * sizeof(std::uint32_t) + sizeof(float) + 1); }

private:
    exact::LookupMask mask_;
    AwaitedPixels awaited_;
    lod::DrawList kept_;
    std::vector<std::size_t> places_;     // per range of a list: index of its first cluster among all clusters
    std::vector<std::uint8_t> mayShadow_; // per cluster of a list
    std::uint64_t clustersTested_ = 0;
};

} // namespace gnomon::render
