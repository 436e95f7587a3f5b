// Stores the covered pixels of triangles to the memory of a tile. The tile belongs to a depth map or a visibility
// buffer. The header is compiled once per SIMD instruction set.
#if defined(GNOMON_RASTER_TILE_TARGET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_TILE_TARGET_INL_H
#undef GNOMON_RASTER_TILE_TARGET_INL_H
#else
#define GNOMON_RASTER_TILE_TARGET_INL_H
#endif

#include "raster/farthest_depths.h"
#include "raster/triangle_lanes-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
using WordTag = hn::ScalableTag<std::uint64_t>;
#else
using WordTag = hn::Repartition<std::uint64_t, UintTag>;
#endif

/// A list of the covered pixels of several triangles: address in the tile, depth and triangle id per pixel.
struct Hits { // NOLINT(cppcoreguidelines-pro-type-member-init): elements are set when `count` grows
    static constexpr std::size_t kMaxEntries =
        std::size_t{17} * kMaxLanes; // 4 x 4 pixels per lane, and one more vector
    std::array<std::int32_t, kMaxEntries> addresses;
    std::array<float, kMaxEntries> depths;
    std::array<std::uint32_t, kMaxEntries> ids;
    std::size_t count = 0;

    template <bool hasIds>
    HWY_INLINE void add(IntMask inside, Ints address, Floats depth, Ints id) {
        hn::StoreU(hn::Compress(address, inside), kInts, addresses.data() + count);
        hn::StoreU(hn::Compress(depth, hn::RebindMask(kFloats, inside)), kFloats, depths.data() + count);
        if constexpr (hasIds) hn::StoreU(hn::BitCast(kUints, hn::Compress(id, inside)), kUints, ids.data() + count);
        count += hn::CountTrue(kInts, inside);
    }
};

/// A tile of a depth map. Each pixel stores the smallest depth.
struct DepthTile {
    static constexpr bool kHasIds = false;
    static constexpr bool kCounts = true; // true: the number of covered pixels is counted
    float* depths = nullptr;
    std::uint64_t covered = 0;

    HWY_INLINE void count(std::size_t pixels) { covered += pixels; }

    HWY_INLINE void discount(std::size_t pixels) { covered -= pixels; }

    HWY_INLINE void takeHits(const Hits& hits) const {
        for (std::size_t i = 0; i < hits.count; ++i) {
            float& depth = depths[hits.addresses[i]];
            depth = std::min(depth, hits.depths[i]);
        }
    }

    HWY_INLINE void takeRow(int address, IntMask inside, Floats depth, std::uint32_t /*id*/) const {
        const auto old = hn::LoadU(kFloats, depths + address);
        const auto nearer = hn::Min(old, depth);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(kFloats, inside), nearer, old), kFloats, depths + address);
    }
};

/// A tile of a visibility buffer. Each pixel stores the largest word.
struct VisibilityTile {
    static constexpr bool kHasIds = true;
    static constexpr bool kCounts = false;
    std::uint64_t* words = nullptr;
    FarthestDepths<WordDepths>* farthest = nullptr; // farthest depths of `words`; null without occlusion tests
    TriangleBits setUp{};                           // triangles of the last drawn cluster that passed setup

    /// Returns the nearness (an integer that is larger for nearer depths) of the pixel at each SIMD lane's address. The
    /// bits of a non-negative float have the same order as its value.
    HWY_INLINE Ints nearness(Ints address) const {
        constexpr int kUpperHalf = std::endian::native == std::endian::little ? 1 : 0;
        const auto* halves = reinterpret_cast<const std::int32_t*>(words);
        return hn::GatherIndex(kInts, halves, hn::Add(hn::ShiftLeft<1>(address), hn::Set(kInts, kUpperHalf)));
    }

    HWY_INLINE void takeHits(const Hits& hits) const {
        for (std::size_t i = 0; i < hits.count; ++i) {
            std::uint64_t& word = words[hits.addresses[i]];
            word = std::max(word, visibilityWord(hits.depths[i], hits.ids[i]));
        }
    }

    HWY_INLINE void takeRow(int address, IntMask inside, Floats depth, std::uint32_t id) const {
        // A word of 0 is smaller than every other word, so it changes nothing at pixels outside the triangle.
        const auto mask = hn::RebindMask(kUints, inside);
        const auto high = hn::IfThenElseZero(mask, hn::BitCast(kUints, depth));
        const auto low = hn::IfThenElseZero(mask, hn::Set(kUints, ~id));
        constexpr WordTag kWords;
#if HWY_TARGET == HWY_SCALAR // a vector with one lane cannot be split into halves
        takeWords(address, hn::PromoteTo(kWords, high), hn::PromoteTo(kWords, low));
#else
        const hn::Half<UintTag> half;
        takeWords(
            address, hn::PromoteTo(kWords, hn::LowerHalf(half, high)), hn::PromoteTo(kWords, hn::LowerHalf(half, low)));
        takeWords(
            address + static_cast<int>(hn::Lanes(kWords)),
            hn::PromoteTo(kWords, hn::UpperHalf(half, high)),
            hn::PromoteTo(kWords, hn::UpperHalf(half, low)));
#endif
    }

private:
    template <class Words>
    HWY_INLINE void takeWords(int address, Words high, Words low) const {
        constexpr WordTag kWords;
        const auto word = hn::Or(hn::ShiftLeft<32>(high), low);
        hn::StoreU(hn::Max(hn::LoadU(kWords, words + address), word), kWords, words + address);
    }
};

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
