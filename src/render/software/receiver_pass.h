// Receiver culling: draws only shadow casters that can change the image. First the visible surfaces that face the
// light are found (the receivers). Then the shadow maps draw only casters that can shadow a receiver. Finally the lit
// pixels receive their colour.
#pragma once

#include "render/image_pass.h"

namespace gnomon::render {

/// The receivers (visible surfaces that face the light) of one frame, and the casters that can shadow them. The object
/// reuses its memory from frame to frame.
class ReceiverPass {
public:
    /// Shades the image as if all surfaces were in shadow, and collects the shadow map lookups of all pixels. The
    /// function uses only the size of `shadowDepth`. Returns the number of lit pixels that need no lookup.
    std::uint64_t collect(const DrawInputs& frame, const ImageBuffers& buffers, const FloatPicture& shadowDepth);

    /// Returns true if no pixel looks up a texel of `box` in the depth texture of the shadow maps. This box then need
    /// not be drawn.
    bool isUnseen(const raster::PixelBox& box) const { return mask_.isEmpty(box); }

    /// Returns the casters of shadow map `pass` that can change a pixel. `view` is the projection with which the map is
    /// drawn. Whole groups of clusters are culled first. The list is valid until the next call.
    const lod::DrawList& casters(const DrawInputs& frame, std::size_t pass, const raster::View& view);

    /// Returns true if `light` can complete the image. If not, the image must be shaded again. This happens if a filter
    /// kernel reads several texels, or if an overlay or surfaces are requested.
    bool canLight() const { return awaited_.isLitLater; }

    /// Draws the lit colour of each pixel that the shadow maps show as lit. Returns the number of pixels that count as
    /// lit.
    std::uint64_t light(const FloatPicture& shadowDepth, Picture& picture) const;

    /// Returns the number of clusters that `casters` tested since the last call of `collect`.
    std::uint64_t clustersTested() const { return clustersTested_; }

    /// Returns the memory of the arrays with one entry per pixel, in bytes.
    std::uint64_t bytes() const { return awaited_.pixels.size() * (3 * sizeof(std::uint32_t) + sizeof(float) + 1); }

private:
    exact::LookupMask mask_;
    AwaitedPixels awaited_;
    lod::DrawList kept_;
    // For each range of a draw list: the index of its first cluster among all clusters of the list.
    std::vector<std::size_t> places_;
    std::vector<std::uint8_t> mayShadow_; // per cluster of a draw list: 1 if the cluster may shadow a receiver
    std::uint64_t clustersTested_ = 0;
};

} // namespace gnomon::render
