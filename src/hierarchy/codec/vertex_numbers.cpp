#include "hierarchy/codec/vertex_numbers.h"

namespace gnomon::hierarchy {

namespace {

/// Lists which vertices are references to earlier vertices, and which are not.
void splitVertices(std::size_t vertices, VertexNumbers& numbers) {
    numbers.referring.resize(vertices);
    numbers.fresh.resize(vertices);
    std::size_t referring = 0;
    std::size_t fresh = 0;
    // The loop writes each vertex to both lists and advances one of them. It has no branch, because the CPU cannot
    // predict which vertices are references.
    for (std::size_t v = 0; v < vertices; ++v) {
        numbers.referring[referring] = static_cast<std::uint32_t>(v);
        numbers.fresh[fresh] = static_cast<std::uint32_t>(v);
        const auto isFresh = static_cast<std::size_t>(numbers.references[v] == 0);
        referring += 1 - isFresh;
        fresh += isFresh;
    }
    numbers.referring.resize(referring);
    numbers.fresh.resize(fresh);
}

} // namespace

Planes takePlanes(ByteReader& in, std::size_t numbers) {
    const auto count = in.take<std::uint8_t>();
    if (count > 4) throw Damage{"a value has more than four bytes"};
    const auto bytes = in.take(numbers * count);
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), count, numbers};
}

void takeVertexNumbers(ByteReader& in, std::size_t vertices, const AttributeLayout& layout, VertexNumbers& numbers) {
    const Planes references = takePlanes(in, vertices);
    numbers.references.resize(vertices + kMaxLanes);
    decodeNumbers(references, numbers.references.data());
    splitVertices(vertices, numbers);
    const std::size_t fresh = numbers.fresh.size();
    std::array<Planes, 4> planes;
    for (std::size_t k = 0; k < 3; ++k)
        planes[k] = takePlanes(in, fresh);
    numbers.positions.resize(fresh + kMaxLanes);
    decodePositions(std::span(planes).first<3>(), numbers.positions.data());
    if (layout.hasNormals) {
        for (std::size_t k = 0; k < 2; ++k)
            planes[k] = takePlanes(in, fresh);
        numbers.normals.resize(fresh + kMaxLanes);
        decodeNormals(std::span(planes).first<2>(), layout.normals.mask(), numbers.normals.data());
    }
    if (layout.hasColors) {
        for (Planes& each : planes)
            each = takePlanes(in, fresh);
        numbers.colors.resize(fresh + kMaxLanes);
        decodeColors(planes, numbers.colors.data());
    }
}

} // namespace gnomon::hierarchy
