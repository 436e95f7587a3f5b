#include "hierarchy/codec/cluster_codec.h"

#include "core/index_table.h"
#include "core/random.h"
#include "hierarchy/codec/connectivity_decoder.h"
#include "hierarchy/codec/connectivity_encoder.h"
#include "hierarchy/codec/vertex_code.h"
#include "hierarchy/codec/vertex_decoder.h"

#include <algorithm>
#include <array>
#include <bit>

namespace gnomon::hierarchy {

namespace {

/// One component, for example x or red, of all vertices of a page, as integers.
using Channel = std::vector<std::uint32_t>;

/// Returns the zigzag code of the difference between `value` and `prediction`, modulo 2^width.
std::uint32_t wrapped(std::uint32_t value, std::uint32_t prediction, unsigned width) {
    const auto difference = static_cast<std::int32_t>((value - prediction) << (32U - width)) >> (32U - width);
    return zigzag(static_cast<std::uint32_t>(difference));
}

/// Writes the numbers of `channel` as byte planes: first the lowest byte of each number, then the next. Appends the end
/// of each plane to `streamEnds`.
void putPlanes(const Channel& channel, ByteWriter& out, std::vector<std::size_t>& streamEnds) {
    std::uint32_t any = 0;
    for (const std::uint32_t value : channel)
        any |= value;
    const auto planes = static_cast<std::uint8_t>((std::bit_width(any) + 7) / 8);
    out.put(planes);
    for (unsigned plane = 0; plane < planes; ++plane) {
        const std::span<std::byte> bytes = out.room(channel.size());
        for (std::size_t i = 0; i < channel.size(); ++i)
            bytes[i] = static_cast<std::byte>(channel[i] >> (8U * plane));
        streamEnds.push_back(out.size());
    }
}

std::uint32_t channelOf(std::uint32_t color, unsigned k) {
    return color >> (8U * k) & 0xFFU;
}

GridPoint predictedPosition(std::span<const Vertex> vertices, std::size_t v, const Parents& parents) {
    if (parents.acrossEdge == 0) return vertices[v - 1].position;
    const GridPoint& a = vertices[parents.from].position;
    const GridPoint& b = vertices[parents.to].position;
    const GridPoint& c = vertices[parents.opposite].position;
    return {a.x + b.x - c.x, a.y + b.y - c.y, a.z + b.z - c.z};
}

/// The vertex that serves as the prediction of a cluster's first vertex.
constexpr Vertex kNoVertex{};

/// Returns the two vertices whose mean predicts the normal and colour of vertex `v`.
std::pair<const Vertex&, const Vertex&> attributeParents(
    std::span<const Vertex> vertices, std::size_t v, const Parents& parents) {
    if (v == 0) return {kNoVertex, kNoVertex};
    if (parents.acrossEdge != 0) return {vertices[parents.from], vertices[parents.to]};
    return {vertices[v - 1], vertices[v - 1]};
}

std::uint64_t hashOf(const Vertex& vertex, std::uint32_t fields) {
    const std::uint64_t a = (static_cast<std::uint64_t>(vertex.position.x) << 32U | vertex.position.y) + fields;
    const std::uint64_t b = static_cast<std::uint64_t>(vertex.position.z) << 32U | vertex.normal;
    return mix64(a ^ mix64(b));
}

/// All vertices of a page as sequences of numbers, one sequence per component.
struct VertexChannels {
    // One number per vertex. It is 0 for a new vertex. If the vertex refers to an earlier one, it is 1 + zigzag(d),
    // where d is the distance from the vertex after the last referenced one.
    Channel references;
    // This member and the following ones have one number per vertex that does not refer to an earlier vertex.
    std::array<Channel, 3> positions;
    std::array<Channel, 2> normals;
    std::array<Channel, 4> colors;
    std::array<Channel, kMaxFields> fields;

    /// Reserves memory for the numbers of `vertices` vertices: references to earlier vertices, positions and normals.
    /// Most sources have normals.
    void reserve(std::size_t vertices) {
        references.reserve(vertices);
        for (Channel& channel : positions)
            channel.reserve(vertices);
        for (Channel& channel : normals)
            channel.reserve(vertices);
    }
};

AttributeLayout layoutOf(std::span<const Vertex> vertices) {
    AttributeLayout layout;
    std::uint32_t normalBits = 0x8000U;
    for (const Vertex& vertex : vertices) {
        layout.hasNormals |= vertex.normal != kNoNormal;
        layout.hasColors |= vertex.color != kWhite;
        normalBits |= vertex.normal | vertex.normal >> 16U;
    }
    layout.normals.shift = static_cast<unsigned>(std::countr_zero(normalBits));
    return layout;
}

/// Converts the vertices of a page to sequences of numbers, cluster by cluster.
class VertexEncoder {
public:
    VertexEncoder(const Page& page, const PageFields& fields)
        : page_(page), fields_(fields), layout_(layoutOf(page.vertices)), table_(page.vertices.size()) {
        channels_.reserve(page.vertices.size());
        last_.reserve(page.vertices.size());
    }

    void encode(const Cluster& cluster, const ParentTable& parents) {
        const auto vertices = std::span(page_.vertices).subspan(cluster.firstVertex, cluster.vertexCount);
        hashes_.resize(vertices.size());
        for (std::uint32_t v = 0; v < vertices.size(); ++v) {
            hashes_[v] = hashOf(vertices[v], fieldsOf(cluster.firstVertex + v));
            table_.prefetch(hashes_[v]);
        }
        std::uint32_t expected = cluster.firstVertex;
        for (std::uint32_t v = 0; v < vertices.size(); ++v) {
            if (const std::uint32_t earlier = seen(cluster.firstVertex + v, hashes_[v]); earlier != kNone) {
                channels_.references.push_back(1 + zigzag(earlier - expected));
                expected = earlier + 1;
            } else {
                channels_.references.push_back(0);
                encodeFresh(vertices, v, parents[v]);
                encodeFields(cluster, v, parents[v]);
            }
        }
        for (std::uint32_t v = 0; v < vertices.size(); ++v)
            see(cluster.firstVertex + v, hashes_[v]);
    }

    void write(ByteWriter& out, std::vector<std::size_t>& streamEnds) const {
        out.putVarint(anchors_.size());
        out.put(anchors_.bytes());
        out.put(static_cast<std::uint8_t>(layout_.hasNormals));
        out.put(static_cast<std::uint8_t>(layout_.hasColors));
        out.put(static_cast<std::uint8_t>(layout_.normals.shift));
        putPlanes(channels_.references, out, streamEnds);
        for (const Channel& channel : channels_.positions)
            putPlanes(channel, out, streamEnds);
        if (layout_.hasNormals)
            for (const Channel& channel : channels_.normals)
                putPlanes(channel, out, streamEnds);
        if (layout_.hasColors)
            for (const Channel& channel : channels_.colors)
                putPlanes(channel, out, streamEnds);
        if (fields_.words.empty()) return;
        out.put(static_cast<std::uint8_t>(fields_.layout.count()));
        for (std::size_t field = 0; field < fields_.layout.count(); ++field)
            out.put(fields_.layout.bits[field]);
        for (std::size_t field = 0; field < fields_.layout.count(); ++field)
            putPlanes(channels_.fields[field], out, streamEnds);
    }

private:
    std::uint32_t fieldsOf(std::uint32_t v) const { return fields_.words.empty() ? 0 : fields_.words[v]; }

    bool areEqual(std::uint32_t a, std::uint32_t b) const {
        return page_.vertices[a] == page_.vertices[b] && fieldsOf(a) == fieldsOf(b);
    }

    /// Returns the last vertex of earlier clusters that is equal to vertex `v`, or kNone if there is none.
    std::uint32_t seen(std::uint32_t v, std::uint64_t hash) const {
        const auto isEqual = [&](std::uint32_t entry) { return areEqual(last_[entry], v); };
        const std::uint32_t entry = table_.find(hash, isEqual);
        return entry == IndexTable::kAbsent ? kNone : last_[entry];
    }

    void see(std::uint32_t v, std::uint64_t hash) {
        const auto next = static_cast<std::uint32_t>(last_.size());
        const auto isEqual = [&](std::uint32_t entry) { return areEqual(last_[entry], v); };
        const std::uint32_t entry = table_.findOrInsert(hash, next, isEqual);
        if (entry == next) last_.emplace_back();
        last_[entry] = v;
    }

    void encodeFresh(std::span<const Vertex> vertices, std::uint32_t v, const Parents& parents) {
        const Vertex& vertex = vertices[v];
        const GridPoint p = vertex.position;
        if (v == 0) putAnchor(p);
        const GridPoint q = v == 0 ? p : predictedPosition(vertices, v, parents);
        channels_.positions[0].push_back(zigzag(p.x - q.x));
        channels_.positions[1].push_back(zigzag(p.y - q.y));
        channels_.positions[2].push_back(zigzag(p.z - q.z));
        if (layout_.hasNormals) encodeNormal(vertices, v, parents);
        if (layout_.hasColors) encodeColor(vertices, v, parents);
    }

    void encodeNormal(std::span<const Vertex> vertices, std::uint32_t v, const Parents& parents) {
        const auto& [a, b] = attributeParents(vertices, v, parents);
        const NormalCode& code = layout_.normals;
        const std::uint32_t normal = vertices[v].normal;
        const std::uint32_t meanX = (code.x(a.normal) + code.x(b.normal)) / 2;
        const std::uint32_t meanY = (code.y(a.normal) + code.y(b.normal)) / 2;
        channels_.normals[0].push_back(wrapped(code.x(normal), meanX, code.width()));
        channels_.normals[1].push_back(wrapped(code.y(normal), meanY, code.width()));
    }

    void encodeColor(std::span<const Vertex> vertices, std::uint32_t v, const Parents& parents) {
        const auto& [a, b] = attributeParents(vertices, v, parents);
        for (unsigned k = 0; k < 4; ++k) {
            const std::uint32_t mean = (channelOf(a.color, k) + channelOf(b.color, k)) / 2;
            channels_.colors[k].push_back(wrapped(channelOf(vertices[v].color, k), mean, 8));
        }
    }

    void encodeFields(const Cluster& cluster, std::uint32_t v, const Parents& parents) {
        if (fields_.words.empty()) return;
        const auto words = std::span(fields_.words).subspan(cluster.firstVertex, cluster.vertexCount);
        const FieldLayout& layout = fields_.layout;
        const std::uint32_t before = v == 0 ? 0 : words[v - 1];
        const std::uint32_t a = v > 0 && parents.acrossEdge != 0 ? words[parents.from] : before;
        const std::uint32_t b = v > 0 && parents.acrossEdge != 0 ? words[parents.to] : before;
        for (std::size_t field = 0; field < layout.count(); ++field) {
            const std::uint32_t mean = (layout.number(a, field) + layout.number(b, field)) / 2;
            channels_.fields[field].push_back(wrapped(layout.number(words[v], field), mean, layout.bits[field]));
        }
    }

    /// Writes the position of a cluster's first vertex to a separate stream. This vertex is far from the previous one,
    /// and its large differences would need more byte planes for all positions.
    void putAnchor(const GridPoint& p) {
        anchors_.putVarint(zigzag(p.x - anchor_.x));
        anchors_.putVarint(zigzag(p.y - anchor_.y));
        anchors_.putVarint(zigzag(p.z - anchor_.z));
        anchor_ = p;
    }

    const Page& page_;
    const PageFields& fields_;
    AttributeLayout layout_;
    VertexChannels channels_;
    ByteWriter anchors_;
    IndexTable table_;                  // numbers the distinct vertices so far
    std::vector<std::uint32_t> last_;   // per distinct vertex: its last occurrence
    std::vector<std::uint64_t> hashes_; // per vertex of the current cluster
    GridPoint anchor_;
};

} // namespace

std::vector<std::size_t> encodeClusters(const Page& page, ByteWriter& out, const PageFields& fields) {
    std::vector<std::size_t> streamEnds;
    ByteWriter codes;
    ByteWriter indices;
    VertexEncoder vertices(page, fields);
    for (const Cluster& cluster : page.clusters) {
        ConnectivityEncoder connectivity(codes, indices);
        connectivity.encode(std::span(page.triangles).subspan(cluster.firstTriangle, cluster.triangleCount));
        vertices.encode(cluster, connectivity.parents());
    }
    out.put(codes.bytes());
    streamEnds.push_back(out.size());
    out.putVarint(indices.size());
    out.put(indices.bytes());
    streamEnds.push_back(out.size());
    vertices.write(out, streamEnds);
    return streamEnds;
}

void decodeClusters(ByteReader& in, Page& page, PageFields* fields) {
    const Cluster& last = page.clusters.back();
    const auto codes = in.take(std::size_t{last.firstTriangle} + last.triangleCount);
    const auto indices = in.take(in.takeVarint());
    if (in.remaining() == 0) throw Damage{"the bytes end too early"};
    thread_local EdgeWords edges;
    decodeConnectivity(codes, indices, page, edges);
    decodeVertices(in, edges, page, fields);
}

} // namespace gnomon::hierarchy
