#include "hierarchy/codec/vertex_kernel.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hierarchy/codec/vertex_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::hierarchy::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

/// Emulates a vector of four words for targets without SIMD instructions.
struct Four {
    std::array<std::uint32_t, 4> word;
};

HWY_INLINE Four four(const PositionWords& words) {
    return {words.word};
}

template <class Op>
HWY_INLINE Four each(const Four& a, const Four& b, const Op& op) {
    return {{op(a.word[0], b.word[0]), op(a.word[1], b.word[1]), op(a.word[2], b.word[2]), op(a.word[3], b.word[3])}};
}

HWY_INLINE Four sum(const Four& a, const Four& b) {
    return each(a, b, [](std::uint32_t x, std::uint32_t y) { return x + y; });
}

HWY_INLINE Four difference(const Four& a, const Four& b) {
    return each(a, b, [](std::uint32_t x, std::uint32_t y) { return x - y; });
}

HWY_INLINE Four minOf(const Four& a, const Four& b) {
    return each(a, b, [](std::uint32_t x, std::uint32_t y) { return std::min(x, y); });
}

HWY_INLINE Four maxOf(const Four& a, const Four& b) {
    return each(a, b, [](std::uint32_t x, std::uint32_t y) { return std::max(x, y); });
}

HWY_INLINE void store(const Four& words, std::uint32_t* to) {
    std::copy(words.word.begin(), words.word.end(), to);
}

#else

constexpr hn::FixedTag<std::uint32_t, 4> kFour;
using Four = hn::Vec<decltype(kFour)>;

HWY_INLINE Four four(const PositionWords& words) {
    return hn::Load(kFour, words.word.data());
}

HWY_INLINE Four sum(Four a, Four b) {
    return hn::Add(a, b);
}

HWY_INLINE Four difference(Four a, Four b) {
    return hn::Sub(a, b);
}

HWY_INLINE Four minOf(Four a, Four b) {
    return hn::Min(a, b);
}

HWY_INLINE Four maxOf(Four a, Four b) {
    return hn::Max(a, b);
}

HWY_INLINE void store(Four words, std::uint32_t* to) {
    hn::StoreU(words, kFour, to);
}

#endif

using ParentPlaces = std::array<std::uint32_t, kMaxClusterVertices + kMaxLanes>;

/// Writes the indices of the three vertices that predict each vertex (in ClusterVertices). If the three corners of the
/// edge word come before the vertex, they predict it. Otherwise all three indices are those of the previous vertex.
HWY_INLINE void placeParents(std::span<const std::uint32_t> edges, ParentPlaces& parents) {
    constexpr hn::CappedTag<std::int32_t, kMaxLanes> kLanes;
    const auto byte = hn::Set(kLanes, 0xFF);
    const auto each = hn::Set(kLanes, 0x010101);
    auto vertex = hn::Iota(kLanes, 0);
    const auto step = hn::Set(kLanes, static_cast<std::int32_t>(hn::Lanes(kLanes)));
    for (std::size_t v = 0; v < edges.size(); v += hn::Lanes(kLanes), vertex = hn::Add(vertex, step)) {
        const auto edge = hn::LoadU(kLanes, reinterpret_cast<const std::int32_t*>(edges.data() + v));
        const auto from = hn::And(edge, byte);
        const auto to = hn::And(hn::ShiftRight<8>(edge), byte);
        const auto opposite = hn::ShiftRight<16>(edge);
        const auto isEarlier = hn::Lt(hn::Max(from, hn::Max(to, opposite)), vertex);
        const auto place = hn::IfThenElse(isEarlier, hn::Add(edge, each), hn::Mul(vertex, each));
        hn::StoreU(place, kLanes, reinterpret_cast<std::int32_t*>(parents.data() + v));
    }
}

/// Returns the means of the four bytes in `a` and the four bytes in `b`, rounded down.
HWY_INLINE std::uint32_t byteMeans(std::uint32_t a, std::uint32_t b) {
    return (a & b) + (((a ^ b) >> 1U) & 0x7F7F7F7FU);
}

/// Returns the sums of the four bytes in `a` and the four bytes in `b`, modulo 256.
HWY_INLINE std::uint32_t byteSums(std::uint32_t a, std::uint32_t b) {
    return ((a & 0x7F7F7F7FU) + (b & 0x7F7F7F7FU)) ^ ((a ^ b) & 0x80808080U);
}

template <bool kNormals, bool kColors>
// `fresh` is passed by value. The compiler then knows that no write to memory changes it.
HWY_INLINE void predict(const FreshVertices fresh, ClusterVertices& cluster) {
    ParentPlaces parents;
    placeParents(fresh.edges, parents);
    for (std::size_t i = 0; i < fresh.vertices.size(); ++i) {
        const std::uint32_t v = fresh.vertices[i] - fresh.first;
        const std::uint32_t places = parents[v];
        const std::size_t from = places & 0xFFU;
        const std::size_t to = places >> 8U & 0xFFU;
        const std::size_t opposite = places >> 16U;
        const Four rest = difference(four(fresh.positions[i]), four(cluster.positions[opposite]));
        const Four position = sum(sum(rest, four(cluster.positions[from])), four(cluster.positions[to]));
        store(position, cluster.positions[v + 1].word.data());
        if constexpr (kNormals) {
            const std::uint64_t mean = (cluster.normals[from] + cluster.normals[to]) >> 1U & fresh.normalMask;
            cluster.normals[v + 1] = (mean + fresh.normals[i]) & fresh.normalMask;
        }
        if constexpr (kColors)
            cluster.colors[v + 1] = byteSums(byteMeans(cluster.colors[from], cluster.colors[to]), fresh.colors[i]);
    }
}

void predictInLanes(const FreshVertices& fresh, ClusterVertices& cluster) {
    const bool hasNormals = !fresh.normals.empty();
    const bool hasColors = !fresh.colors.empty();
    if (hasNormals && hasColors) return predict<true, true>(fresh, cluster);
    if (hasNormals) return predict<true, false>(fresh, cluster);
    if (hasColors) return predict<false, true>(fresh, cluster);
    return predict<false, false>(fresh, cluster);
}

GridBox storeInLanes(const ClusterVertices& cluster, const NormalCode& code, std::span<Vertex> vertices) {
    static_assert(
        offsetof(Vertex, normal) == 12 && offsetof(Vertex, color) == 16, "a position is stored as four words");
    Four min = four(cluster.positions[1]);
    Four max = min;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        const Four position = four(cluster.positions[v + 1]);
        min = minOf(min, position);
        max = maxOf(max, position);
        const std::uint64_t normal = cluster.normals[v + 1];
        store(position, &vertices[v].position.x);
        vertices[v].normal = static_cast<std::uint32_t>(normal | normal >> 16U) << code.shift ^ kOffsetBinary;
        vertices[v].color = cluster.colors[v + 1];
    }
    PositionWords low{};
    PositionWords high{};
    store(min, low.word.data());
    store(max, high.word.data());
    return {{low.word[0], low.word[1], low.word[2]}, {high.word[0], high.word[1], high.word[2]}};
}

} // namespace gnomon::hierarchy::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::hierarchy {

HWY_EXPORT(predictInLanes);
HWY_EXPORT(storeInLanes);

void predictVertices(const FreshVertices& fresh, ClusterVertices& cluster) {
    HWY_DYNAMIC_DISPATCH(predictInLanes)(fresh, cluster);
}

GridBox storeVertices(const ClusterVertices& cluster, const NormalCode& code, std::span<Vertex> vertices) {
    return HWY_DYNAMIC_DISPATCH(storeInLanes)(cluster, code, vertices);
}

} // namespace gnomon::hierarchy
#endif
