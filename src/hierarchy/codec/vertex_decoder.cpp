#include "hierarchy/codec/vertex_decoder.h"

#include "hierarchy/codec/vertex_kernel.h"

#include <algorithm>

namespace gnomon::hierarchy {

namespace {

/// Decodes cluster after cluster.
class VertexDecoder {
public:
    /// `numbers` is where it keeps what it reads.
    VertexDecoder(ByteReader& in, std::size_t vertexCount, Page& page, const EdgeWords& edges, VertexNumbers& numbers)
        : page_(page), edges_(edges), numbers_(numbers), anchors_(in.take(in.takeVarint())) {
        layout_.hasNormals = in.take<std::uint8_t>() != 0;
        layout_.hasColors = in.take<std::uint8_t>() != 0;
        layout_.normals.shift = in.take<std::uint8_t>();
        if (layout_.normals.shift > 15) throw Damage{"normals lack more bits than they have"};
        takeVertexNumbers(in, vertexCount, layout_, numbers_);
        page.vertices.reserve(vertexCount);
        if (!layout_.hasNormals) vertices_.normals.fill(0);
        if (!layout_.hasColors) vertices_.colors.fill(kWhite);
        vertices_.positions[0] = {};
        vertices_.normals[0] = 0;
        vertices_.colors[0] = kWhite;
    }

    void decode(Cluster& cluster) {
        const std::uint32_t end = cluster.firstVertex + cluster.vertexCount;
        const std::size_t references = refer(cluster.firstVertex, end);
        const std::size_t count = cluster.vertexCount - references;
        if (count > 0 && numbers_.fresh[fresh_] == cluster.firstVertex) takeAnchor();
        FreshVertices fresh;
        fresh.vertices = std::span(numbers_.fresh).subspan(fresh_, count);
        fresh.positions = std::span(numbers_.positions).subspan(fresh_, count);
        if (layout_.hasNormals) fresh.normals = std::span(numbers_.normals).subspan(fresh_, count);
        if (layout_.hasColors) fresh.colors = std::span(numbers_.colors).subspan(fresh_, count);
        fresh.normalMask = joinedNormal(layout_.normals.mask(), layout_.normals.mask());
        fresh.first = cluster.firstVertex;
        fresh.edges = std::span(edges_).subspan(cluster.firstVertex, cluster.vertexCount);
        predictVertices(fresh, vertices_);
        fresh_ += count;
        cluster.box = storeVertices(vertices_, layout_.normals, std::span(stored_).first(cluster.vertexCount));
        page_.vertices.insert(page_.vertices.end(), stored_.begin(), stored_.begin() + cluster.vertexCount);
        const GridPoint& most = cluster.box.max;
        if (std::max({most.x, most.y, most.z}) > kMaxGridCoordinate) throw Damage{"a vertex leaves the grid"};
    }

    void expectEnd() const { anchors_.expectEnd(); }

private:
    /// Copies the references among the vertices from `first` to `end`; how many there are.
    std::size_t refer(std::uint32_t first, std::uint32_t end) {
        const std::size_t before = referring_;
        std::uint32_t expected = first;
        for (; referring_ < numbers_.referring.size() && numbers_.referring[referring_] < end; ++referring_) {
            const std::uint32_t v = numbers_.referring[referring_];
            const std::uint32_t earlier = expected + unzigzag(numbers_.references[v] - 1);
            if (earlier >= first) throw Damage{"a vertex refers to one that is not earlier"};
            expected = earlier + 1;
            const Vertex& vertex = page_.vertices[earlier];
            const std::size_t place = v - first + 1;
            vertices_.positions[place].word = {vertex.position.x, vertex.position.y, vertex.position.z, 0};
            vertices_.normals[place] = joinedNormal(layout_.normals.x(vertex.normal), layout_.normals.y(vertex.normal));
            vertices_.colors[place] = vertex.color;
        }
        return referring_ - before;
    }

    /// Puts the position that the cluster's first vertex is predicted from before it.
    void takeAnchor() {
        for (std::size_t k = 0; k < 3; ++k)
            vertices_.positions[0].word[k] += unzigzag(static_cast<std::uint32_t>(anchors_.takeVarint()));
    }

    Page& page_;
    const EdgeWords& edges_;
    VertexNumbers& numbers_;
    ByteReader anchors_;
    AttributeLayout layout_;
    std::size_t referring_ = 0; // taken so far
    std::size_t fresh_ = 0;
    ClusterVertices vertices_{};
    std::array<Vertex, kMaxClusterVertices> stored_{};
};

} // namespace

void decodeVertices(ByteReader& in, const EdgeWords& edges, Page& page) {
    thread_local VertexNumbers numbers;
    const Cluster& last = page.clusters.back();
    VertexDecoder decoder(in, std::size_t{last.firstVertex} + last.vertexCount, page, edges, numbers);
    for (Cluster& cluster : page.clusters)
        decoder.decode(cluster);
    decoder.expectEnd();
}

} // namespace gnomon::hierarchy
