#include "hierarchy/codec/vertex_decoder.h"

#include "hierarchy/codec/vertex_kernel.h"

#include <algorithm>

namespace gnomon::hierarchy {

namespace {

/// Decodes the vertices of a page, cluster by cluster.
class VertexDecoder {
public:
    /// Reads the stored numbers of all vertices into `numbers`, which the caller owns and can reuse.
    VertexDecoder(ByteReader& in, std::size_t vertexCount, Page& page, const EdgeWords& edges, VertexNumbers& numbers)
        : page_(page), edges_(edges), numbers_(numbers), anchors_(in.take(in.takeVarint())) {
        layout_.hasNormals = in.take<std::uint8_t>() != 0;
        layout_.hasColors = in.take<std::uint8_t>() != 0;
        layout_.normals.shift = in.take<std::uint8_t>();
        if (layout_.normals.shift > 15) throw Damage{"the shift of the normals is too large"};
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
        const GridPoint& furthest = cluster.box.max;
        if (std::max({furthest.x, furthest.y, furthest.z}) > kMaxGridCoordinate)
            throw Damage{"a vertex is outside the grid"};
    }

    void expectEnd() const { anchors_.expectEnd(); }

private:
    /// Copies earlier vertices to those among the vertices [first, end) that refer to them. Returns the number of these
    /// references.
    std::size_t refer(std::uint32_t first, std::uint32_t end) {
        const std::size_t before = referring_;
        std::uint32_t expected = first;
        for (; referring_ < numbers_.referring.size() && numbers_.referring[referring_] < end; ++referring_) {
            const std::uint32_t v = numbers_.referring[referring_];
            const std::uint32_t earlier = expected + unzigzag(numbers_.references[v] - 1);
            if (earlier >= first) throw Damage{"a vertex refers to a later vertex"};
            expected = earlier + 1;
            const Vertex& vertex = page_.vertices[earlier];
            const std::size_t place = v - first + 1;
            vertices_.positions[place].word = {vertex.position.x, vertex.position.y, vertex.position.z, 0};
            vertices_.normals[place] = joinedNormal(layout_.normals.x(vertex.normal), layout_.normals.y(vertex.normal));
            vertices_.colors[place] = vertex.color;
        }
        return referring_ - before;
    }

    /// Reads the difference for the next cluster and adds it to the anchor, which is the position that predicts the
    /// first vertex of a cluster.
    void takeAnchor() {
        for (std::size_t k = 0; k < 3; ++k)
            vertices_.positions[0].word[k] += unzigzag(static_cast<std::uint32_t>(anchors_.takeVarint()));
    }

    Page& page_;
    const EdgeWords& edges_;
    VertexNumbers& numbers_;
    ByteReader anchors_;
    AttributeLayout layout_;
    std::size_t referring_ = 0; // number of references decoded so far
    std::size_t fresh_ = 0;
    ClusterVertices vertices_{};
    std::array<Vertex, kMaxClusterVertices> stored_{};
};

FieldLayout takeFieldLayout(ByteReader& in) {
    const auto count = in.take<std::uint8_t>();
    if (count < 1 || count > kMaxFields) throw Damage{"vertices have " + std::to_string(count) + " fields"};
    FieldLayout layout;
    unsigned sum = 0;
    for (std::size_t field = 0; field < count; ++field) {
        layout.bits[field] = in.take<std::uint8_t>();
        sum += layout.bits[field];
        if (layout.bits[field] < 1 || layout.bits[field] > 16) throw Damage{"a field has too many bits, or none"};
    }
    if (sum > 32) throw Damage{"fields have more than 32 bits together"};
    return layout;
}

/// Decodes the fields of a page, one field after the other. It adds each stored difference to its prediction. The
/// prediction is the mean of the ends of the edge across which the vertex was new, or the value of the previous vertex.
/// `numbers` contains the references and their targets.
class FieldDecoder {
public:
    FieldDecoder(ByteReader& in, const VertexNumbers& numbers, PageFields& fields)
        : numbers_(numbers), fields_(fields) {
        fields_.layout = takeFieldLayout(in);
        for (std::size_t field = 0; field < fields_.layout.count(); ++field) {
            const Planes planes = takePlanes(in, numbers.fresh.size());
            differences_[field].resize(numbers.fresh.size() + kMaxLanes);
            decodeNumbers(planes, differences_[field].data());
        }
    }

    void decode(const Page& page, const EdgeWords& edges) {
        fields_.words.assign(page.vertices.size(), 0);
        for (const Cluster& cluster : page.clusters) {
            std::uint32_t expected = cluster.firstVertex;
            for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
                const std::uint32_t at = cluster.firstVertex + v;
                if (const std::uint32_t reference = numbers_.references[at]; reference != 0) {
                    // The vertex decoder has already checked the range of this number.
                    const std::uint32_t earlier = expected + unzigzag(reference - 1);
                    expected = earlier + 1;
                    fields_.words[at] = fields_.words[earlier];
                } else {
                    fields_.words[at] = next(std::span(fields_.words).subspan(cluster.firstVertex), v, edges[at]);
                }
            }
        }
    }

private:
    /// Returns the field value of the next vertex that does not refer to an earlier vertex. The vertex has the index
    /// `v` in its cluster and was new across `edge`.
    std::uint32_t next(std::span<const std::uint32_t> words, std::uint32_t v, std::uint32_t edge) {
        const std::uint32_t from = edge & 0xFFU;
        const std::uint32_t to = edge >> 8U & 0xFFU;
        const bool isAcross = std::max({from, to, edge >> 16U}) < v;
        const std::uint32_t before = v == 0 ? 0 : words[v - 1];
        const std::uint32_t a = isAcross ? words[from] : before;
        const std::uint32_t b = isAcross ? words[to] : before;
        std::uint32_t word = 0;
        for (std::size_t field = 0; field < fields_.layout.count(); ++field) {
            const std::uint32_t mean = (fields_.layout.number(a, field) + fields_.layout.number(b, field)) / 2;
            const std::uint32_t number = mean + unzigzag(differences_[field][next_]);
            word |= (number & fields_.layout.maxNumber(field)) << fields_.layout.shift(field);
        }
        ++next_;
        return word;
    }

    const VertexNumbers& numbers_;
    PageFields& fields_;
    std::array<std::vector<std::uint32_t>, kMaxFields> differences_;
    std::size_t next_ = 0; // index of the next vertex among those that are not references
};

} // namespace

void decodeVertices(ByteReader& in, const EdgeWords& edges, Page& page, PageFields* fields) {
    thread_local VertexNumbers numbers;
    const Cluster& last = page.clusters.back();
    VertexDecoder decoder(in, std::size_t{last.firstVertex} + last.vertexCount, page, edges, numbers);
    for (Cluster& cluster : page.clusters)
        decoder.decode(cluster);
    decoder.expectEnd();
    if (fields != nullptr) FieldDecoder(in, numbers, *fields).decode(page, edges);
}

} // namespace gnomon::hierarchy
