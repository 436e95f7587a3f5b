#include "hierarchy/codec/plane_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/codec/plane_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::hierarchy::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using WordTag = hn::CappedTag<std::uint32_t, kMaxLanes>;
using Words = hn::Vec<WordTag>;

constexpr WordTag kWords;
constexpr hn::Rebind<std::uint8_t, WordTag> kBytes;

/// Combines the byte planes of the numbers from index `i` to a SIMD vector. Lanes after the last number are undefined.
HWY_INLINE Words numbersAt(const Planes& planes, std::size_t i) {
    const std::size_t left = planes.numbers - i;
    Words numbers = hn::Zero(kWords);
    for (unsigned plane = 0; plane < planes.planes; ++plane) {
        const std::uint8_t* bytes = planes.bytes + plane * planes.numbers + i;
        HWY_ALIGN std::array<std::uint8_t, kMaxLanes> last{};
        if (left < hn::Lanes(kWords)) {
            std::copy(bytes, bytes + left, last.begin());
            bytes = last.data();
        }
        const auto wide = hn::PromoteTo(kWords, hn::LoadU(kBytes, bytes));
        numbers = hn::Or(numbers, hn::ShiftLeftSame(wide, static_cast<int>(8 * plane)));
    }
    return numbers;
}

HWY_INLINE Words differencesAt(const Planes& planes, std::size_t i) {
    const Words code = numbersAt(planes, i);
    const Words sign = hn::Sub(hn::Zero(kWords), hn::And(code, hn::Set(kWords, 1)));
    return hn::Xor(hn::ShiftRight<1>(code), sign);
}

void numbersInLanes(const Planes& planes, std::uint32_t* out) {
    for (std::size_t i = 0; i < planes.numbers; i += hn::Lanes(kWords))
        hn::StoreU(numbersAt(planes, i), kWords, out + i);
}

void positionsInLanes(std::span<const Planes, 3> planes, PositionWords* out) {
    for (std::size_t i = 0; i < planes[0].numbers; i += hn::Lanes(kWords))
        hn::StoreInterleaved4(
            differencesAt(planes[0], i),
            differencesAt(planes[1], i),
            differencesAt(planes[2], i),
            hn::Zero(kWords),
            kWords,
            out[i].word.data());
}

void normalsInLanes(std::span<const Planes, 2> planes, std::uint32_t mask, std::uint64_t* out) {
    const Words bits = hn::Set(kWords, mask);
    for (std::size_t i = 0; i < planes[0].numbers; i += hn::Lanes(kWords))
        hn::StoreInterleaved2(
            hn::And(differencesAt(planes[0], i), bits),
            hn::And(differencesAt(planes[1], i), bits),
            kWords,
            reinterpret_cast<std::uint32_t*>(out + i));
}

void colorsInLanes(std::span<const Planes, 4> planes, std::uint32_t* out) {
    const Words byte = hn::Set(kWords, 0xFF);
    for (std::size_t i = 0; i < planes[0].numbers; i += hn::Lanes(kWords)) {
        Words color = hn::Zero(kWords);
        for (std::size_t k = 0; k < 4; ++k)
            color =
                hn::Or(color, hn::ShiftLeftSame(hn::And(differencesAt(planes[k], i), byte), static_cast<int>(8 * k)));
        hn::StoreU(color, kWords, out + i);
    }
}

} // namespace gnomon::hierarchy::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::hierarchy {

HWY_EXPORT(numbersInLanes);
HWY_EXPORT(positionsInLanes);
HWY_EXPORT(normalsInLanes);
HWY_EXPORT(colorsInLanes);

void decodeNumbers(const Planes& planes, std::uint32_t* out) {
    HWY_DYNAMIC_DISPATCH(numbersInLanes)(planes, out);
}

void decodePositions(std::span<const Planes, 3> planes, PositionWords* out) {
    HWY_DYNAMIC_DISPATCH(positionsInLanes)(planes, out);
}

void decodeNormals(std::span<const Planes, 2> planes, std::uint32_t mask, std::uint64_t* out) {
    HWY_DYNAMIC_DISPATCH(normalsInLanes)(planes, mask, out);
}

void decodeColors(std::span<const Planes, 4> planes, std::uint32_t* out) {
    HWY_DYNAMIC_DISPATCH(colorsInLanes)(planes, out);
}

} // namespace gnomon::hierarchy
#endif
