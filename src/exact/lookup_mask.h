// What of a frame's shadow maps its image will look up (receiver masks: Bittner, Mattausch, Silvennoinen and Wimmer
// 2011): in blocks of texels, how deep the deepest lookup is. A caster that lies before none changes no pixel.
#pragma once

#include "exact/receiver_mask.h"
#include "raster/raster.h"

#include <algorithm>
#include <cstdint>

namespace gnomon::exact {

/// Bounds of all that triangles with their corners in a box can draw into a map.
struct CasterBound {
    raster::PixelBox texels{}; // of the viewport, those outside left out
    float nearest = 0;         // no more than any depth that a texel takes of them, from 0 to 1
};

/// The bound of `box` (grid positions) in a depth pass with `view`, whatever its vertices are rounded to; the whole
/// viewport at depth 0 where the box reaches the plane of w = 0.
CasterBound casterBound(const raster::View& view, const raster::CellBox& box);

/// The texels that a lookup reads, by column and row of the depth texture, both ends included.
struct LookupTexels {
    std::int32_t firstColumn = 0;
    std::int32_t firstRow = 0;
    std::int32_t lastColumn = 0;
    std::int32_t lastRow = 0;

    bool operator==(const LookupTexels&) const = default;
};

/// The mask of a frame's depth texture; keeps its memory from frame to frame.
class LookupMask {
public:
    /// An empty mask of a texture of that size, which is not nothing.
    void reset(int width, int height);

    /// Lookups that one thread adds. Those of neighbours read the same blocks, so only the deepest of a run is handed
    /// on.
    class Run {
    public:
        explicit Run(LookupMask& mask) : mask_(&mask) {}

        Run(const Run&) = delete;
        Run& operator=(const Run&) = delete;
        Run(Run&&) = delete;
        Run& operator=(Run&&) = delete;

        ~Run() { flush(); }

        /// Adds a lookup that compares `depth` with what `texels` hold.
        void add(const LookupTexels& texels, float depth) {
            constexpr int kShift = ReceiverMask::kBlockBits;
            const LookupTexels blocks = {
                texels.firstColumn >> kShift,
                texels.firstRow >> kShift,
                texels.lastColumn >> kShift,
                texels.lastRow >> kShift};
            if (!(blocks == blocks_)) flush();
            blocks_ = blocks;
            deepest_ = std::max(deepest_, depth); // no number is left out, since it is lit by nothing
        }

    private:
        void flush() {
            // Stored depths are from 0 to 1: a lookup at 0 or before is lit by all of them.
            if (deepest_ > 0) mask_->lower(blocks_, -deepest_);
            deepest_ = 0;
        }

        LookupMask* mask_;
        LookupTexels blocks_; // of those of the run, in blocks
        float deepest_ = 0;
    };

    /// To be called once all lookups are added, before the mask is asked.
    void finish() { mask_.finish(); }

    /// Whether no lookup that a caster could darken reads the texels of `box`, or of blocks that it shares.
    bool isEmpty(const raster::PixelBox& box) const;

    /// Whether what stays within `bound` may change what a lookup answers.
    bool mayShadow(const CasterBound& bound) const;

private:
    void lower(const LookupTexels& blocks, float to);

    ReceiverMask mask_; // heights towards the light: depths with their signs turned
};

} // namespace gnomon::exact
