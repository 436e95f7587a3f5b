// The lookup mask of shadow maps. It stores the max depth of the shadow map lookups per block of texels (receiver
// masks: Bittner, Mattausch, Silvennoinen and Wimmer 2011). A caster behind all lookups of its blocks changes no
// pixel.
#pragma once

#include "exact/receiver_mask.h"
#include "raster/raster.h"

#include <algorithm>
#include <cstdint>

namespace gnomon::exact {

/// Bounds of the shadow map texels and depths that a caster can cover.
struct CasterBound {
    raster::PixelBox texels{}; // within the viewport
    float nearest = 0;         // lower bound of the depths that the caster can draw, in [0, 1]
};

/// Returns bounds of the texels and depths that a caster within `box` (grid positions) can cover in a depth pass with
/// `view`. The bounds include all rounding of vertices. If the box extends to the plane w = 0, the bounds are the whole
/// viewport and depth 0.
CasterBound casterBound(const raster::View& view, const raster::CellBox& box);

/// The range of texels that one shadow map lookup reads: columns and rows of the depth texture, both ends included.
struct LookupTexels {
    std::int32_t firstColumn = 0;
    std::int32_t firstRow = 0;
    std::int32_t lastColumn = 0;
    std::int32_t lastRow = 0;

    bool operator==(const LookupTexels&) const = default;
};

/// Stores the max depth of all shadow map lookups per block of texels, for the depth texture of one frame. The object
/// reuses its memory between frames.
class LookupMask {
public:
    /// Clears the mask for a depth texture of width x height texels. Both sizes must be above 0.
    void reset(int width, int height);

    /// Collects the shadow map lookups of one thread. Consecutive lookups often read the same blocks of texels. The
    /// object therefore adds only the deepest of these lookups to the mask.
    class Run {
    public:
        explicit Run(LookupMask& mask) : mask_(&mask) {}

        Run(const Run&) = delete;
        Run& operator=(const Run&) = delete;
        Run(Run&&) = delete;
        Run& operator=(Run&&) = delete;

        ~Run() { flush(); }

        /// Adds a shadow map lookup that compares `depth` with the stored depths of `texels`.
        void add(const LookupTexels& texels, float depth) {
            constexpr int kShift = ReceiverMask::kBlockBits;
            const LookupTexels blocks = {
                texels.firstColumn >> kShift,
                texels.firstRow >> kShift,
                texels.lastColumn >> kShift,
                texels.lastRow >> kShift};
            if (!(blocks == blocks_)) flush();
            blocks_ = blocks;
            deepest_ = std::max(deepest_, depth); // max ignores a NaN, and a caster never darkens a lookup with NaN
        }

    private:
        void flush() {
            // Stored depths are in [0, 1], so a lookup with depth 0 or less is always lit and needs no caster.
            if (deepest_ > 0) mask_->lower(blocks_, -deepest_);
            deepest_ = 0;
        }

        LookupMask* mask_;
        LookupTexels blocks_; // blocks of the current run of lookups
        float deepest_ = 0;
    };

    /// Completes the mask. Must be called after the last lookup is added, and before `isEmpty` and `mayShadow`.
    void finish() { mask_.finish(); }

    /// Returns true if no shadow map lookup needs the texels of `box`, so this part of the map need not be drawn.
    bool isEmpty(const raster::PixelBox& box) const;

    /// Returns true if a caster with the bounds `bound` may darken a shadow map lookup.
    bool mayShadow(const CasterBound& bound) const;

private:
    void lower(const LookupTexels& blocks, float to);

    ReceiverMask mask_; // stores heights towards the light: negated depths
};

} // namespace gnomon::exact
