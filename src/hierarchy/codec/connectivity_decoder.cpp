#include "hierarchy/codec/connectivity_decoder.h"

#include "hierarchy/codec/connectivity_code.h"
#include "hierarchy/codec/vertex_numbers.h"
#include "hierarchy/validation.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace gnomon::hierarchy {

namespace {

/// The meaning of a triangle's code byte, and how many bytes and vertices the triangle consumes.
struct CodeMeaning {
    std::uint32_t age = 0;          // age of the edge across which it is entered, plus 1
    std::uint32_t distance = 0;     // distance of the third corner before the next new vertex
    std::uint32_t explicitMask = 0; // all bits set if the index of the third corner is in the second stream
    std::uint32_t newVertices = 0;
    std::uint32_t indices = 0; // number of its bytes in the second stream
};

constexpr std::array<CodeMeaning, 256> kMeanings = [] {
    std::array<CodeMeaning, 256> meanings{};
    for (unsigned code = 0; code < 256; ++code) {
        const unsigned third = code & 15U;
        const unsigned newCorners = (code & 1U) + (code >> 1U & 1U) + (code >> 2U & 1U);
        const bool isExplicit = third == kExplicit;
        if (code >> 4U == kNotEntered)
            meanings[code] = {0, 0, 0, newCorners, 3 - newCorners};
        else
            meanings[code] = {
                (code >> 4U) + 1, third, isExplicit ? ~0U : 0U, third == 0 ? 1U : 0U, isExplicit ? 1U : 0U};
    }
    return meanings;
}();

constexpr std::uint32_t kFirstUnentered = kNotEntered << 4U;

/// A bit of a vertex or edge word. It means that the vertex or edge is invalid.
constexpr std::uint32_t kBad = 0x80000000U;

/// The state while one cluster is decoded. It lives in local variables of one function. Stores through byte pointers
/// may alias each member of an object with a known address, so the compiler would reload such members after each store.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filling the arrays first would cost more than what is read
struct ClusterRun {
    const std::uint8_t* indices = nullptr; // its next index; the byte after the last one may be read
    std::size_t next = 0;                  // index of the next new vertex
    std::size_t openCount = kNotEntered;
    std::uint32_t bad = 0; // kBad if an edge or a vertex was invalid
    std::array<Triangle, kMaxClusterTriangles> triangles;
    // The edge word of each vertex (EdgeWords). The additional entry receives the writes for corners that are not new.
    std::array<std::uint32_t, kMaxClusterVertices + 1> edges;
    // All edges that decoded triangles have left open, oldest first. A word contains the vertices `from`, `to` and the
    // opposite corner, one byte each.
    std::array<std::uint32_t, kNotEntered + 3 * kMaxClusterTriangles> open;
};

inline void takeUnentered(ClusterRun& run, std::size_t t, std::uint32_t code) {
    std::array<std::uint32_t, 3> corner{};
    for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t isNew = code >> k & 1U;
        corner[k] = isNew != 0 ? static_cast<std::uint32_t>(run.next) : *run.indices;
        run.edges[run.next] = kNoEdge;
        run.next += isNew;
        run.indices += 1 - isNew;
        run.triangles[t][k] = static_cast<std::uint8_t>(corner[k]);
    }
    const auto [a, b, c] = corner;
    run.open[run.openCount] = b | a << 8U | c << 16U;
    run.open[run.openCount + 1] = a | c << 8U | b << 16U;
    run.open[run.openCount + 2] = c | b << 8U | a << 16U;
    run.openCount += 3;
}

/// Decodes a triangle that continues across an open edge. The code has no branches, because the CPU cannot predict
/// which vertices are new.
inline void takeEntered(ClusterRun& run, std::size_t t, const CodeMeaning& code) {
    const std::uint32_t edge = run.open[run.openCount - code.age];
    // The subtraction sets the bit kBad if there is no such vertex.
    const std::uint32_t near = static_cast<std::uint32_t>(run.next) - code.distance;
    const std::uint32_t third = near ^ ((near ^ *run.indices) & code.explicitMask);
    run.bad |= edge | third;
    run.edges[run.next] = edge;
    run.next += code.newVertices;
    run.indices += code.indices;
    const auto firstTwo = static_cast<std::uint16_t>(edge);
    std::memcpy(run.triangles[t].data(), &firstTwo, sizeof firstTwo);
    run.triangles[t][2] = static_cast<std::uint8_t>(third);
    const std::uint32_t from = edge & 0xFFU;
    const std::uint32_t toAndThird = (edge & 0xFF00U) + third;
    run.open[run.openCount] = from + (toAndThird << 8U);
    run.open[run.openCount + 1] = toAndThird + (from << 16U);
    run.openCount += 2;
}

/// Returns how many numbers of the second stream the triangles of `cluster` use. Throws Damage if the stream has fewer
/// numbers or if a corner is out of range. The decoding that follows therefore needs no checks.
std::size_t checkedIndexCount(
    std::span<const std::uint8_t> codes, std::span<const std::uint8_t> indices, const Cluster& cluster) {
    std::uint32_t newVertices = 0;
    std::size_t count = 0;
    for (const std::uint8_t code : codes) {
        newVertices += kMeanings[code].newVertices;
        count += kMeanings[code].indices;
    }
    if (count > indices.size() || newVertices > cluster.vertexCount)
        throw Damage{"a triangle refers to a missing vertex"};
    std::uint8_t highest = 0;
    for (const std::uint8_t index : indices.first(count))
        highest = std::max(highest, index);
    if (highest >= cluster.vertexCount) throw Damage{"a triangle refers to a missing vertex"};
    return count;
}

/// Decodes the triangles of one cluster into the page, and fills `edges` for the vertices of the cluster.
void decodeCluster(
    std::span<const std::uint8_t> codes,
    const std::uint8_t* indices,
    const Cluster& cluster,
    Page& page,
    std::uint32_t* edges) {
    ClusterRun run;
    run.indices = indices;
    std::fill_n(run.open.begin(), kNotEntered, kBad);
    for (std::size_t t = 0; t < codes.size(); ++t) {
        if (codes[t] >= kFirstUnentered)
            takeUnentered(run, t, codes[t]);
        else
            takeEntered(run, t, kMeanings[codes[t]]);
    }
    if ((run.bad & kBad) != 0) throw Damage{"a triangle refers to a missing vertex or edge"};
    page.triangles.insert(page.triangles.end(), run.triangles.begin(), run.triangles.begin() + cluster.triangleCount);
    std::fill(run.edges.begin() + static_cast<std::ptrdiff_t>(run.next), run.edges.end(), kNoEdge);
    std::copy_n(run.edges.begin(), cluster.vertexCount, edges);
}

std::span<const std::uint8_t> numbers(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

} // namespace

void decodeConnectivity(
    std::span<const std::byte> codes, std::span<const std::byte> indices, Page& page, EdgeWords& edges) {
    const Cluster& last = page.clusters.back();
    page.triangles.reserve(codes.size());
    edges.resize(std::size_t{last.firstVertex} + last.vertexCount + kMaxLanes);
    std::span<const std::uint8_t> rest = numbers(indices);
    for (const Cluster& cluster : page.clusters) {
        const auto own = numbers(codes.subspan(cluster.firstTriangle, cluster.triangleCount));
        const std::size_t count = checkedIndexCount(own, rest, cluster);
        decodeCluster(own, rest.data(), cluster, page, edges.data() + cluster.firstVertex);
        rest = rest.subspan(count);
    }
    if (!rest.empty()) throw Damage{"the page has unused indices"};
}

} // namespace gnomon::hierarchy
