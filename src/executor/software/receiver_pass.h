// The image before its shadow maps: who is seen and faces the light becomes a receiver of the map that it looks up,
// maps draw what may change what those find, and only then the image is lit.
#pragma once

#include "executor/image_pass.h"

namespace gnomon::executor {

/// The receivers of one frame, and the casters that matter to them; keeps its memory from frame to frame.
class ReceiverPass {
public:
    /// Draws the image in shadow and collects its receivers. `shadowDepth` has the size of the frame's depth texture,
    /// whatever it holds. Answers how many pixels face the light where no map is asked.
    std::uint64_t collect(const FrameDrawing& frame, const ImageBuffers& buffers, const FloatPicture& shadowDepth);

    /// Whether no pixel can change by what `box` of the depth texture holds, so that it need not be drawn.
    bool isUnseen(const raster::PixelBox& box) const { return mask_.isEmpty(box); }

    /// The clusters of the frame's casters of map `pass`, drawn with `view`, that may change a pixel; groups are looked
    /// at first. Valid until the next call.
    const selection::DrawList& casters(const FrameDrawing& frame, std::size_t pass, const raster::View& view);

    /// Whether `light` finishes the image; else it has to be shaded again: a kernel reads many texels, and an overlay
    /// or surfaces want more than colours.
    bool canLight() const { return awaited_.isLitLater; }

    /// Gives the light to the pixels that it reaches, from what the maps hold, and returns how many count as lit.
    std::uint64_t light(const FloatPicture& shadowDepth, Picture& picture) const;

    /// Clusters that `casters` was asked about since the last `collect`.
    std::uint64_t clustersTested() const { return clustersTested_; }

    /// What the arrays by pixel take.
    std::uint64_t bytes() const { return awaited_.pixels.size() * (3 * sizeof(std::uint32_t) + sizeof(float) + 1); }

private:
    exact::LookupMask mask_;
    AwaitedPixels awaited_;
    selection::DrawList kept_;
    std::vector<std::size_t> places_;     // of each range of a list, its first cluster among all
    std::vector<std::uint8_t> mayShadow_; // by cluster of a list
    std::uint64_t clustersTested_ = 0;
};

} // namespace gnomon::executor
