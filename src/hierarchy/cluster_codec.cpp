// One code byte a triangle. High nibble: the age of the open edge across which the triangle is entered (then its first
// two corners are that edge), or 15 for none. Low nibble, entered: 0 if the third corner is the next new vertex, 1-14
// if it is the vertex that many before the next new one, 15 if its index follows in the second stream. Not entered: bit
// k says that corner k is the next new vertex, else its index follows.
//
// A vertex that is new across an edge is predicted as the parallelogram's fourth corner (Touma, Gotsman 1998), its
// normal and colour as the mean of the edge's; any other from the vertex before it. Differences are zigzag-coded and
// stored byte plane by byte plane, since the entropy coder that follows works on bytes.
#include "hierarchy/cluster_codec.h"

#include "hierarchy/edge_window.h"

#include <algorithm>
#include <array>
#include <bit>

namespace gnomon::hierarchy {

namespace {

constexpr unsigned kNotEntered = 15;
constexpr unsigned kExplicit = 15;
constexpr std::size_t kAxes = 3;
constexpr std::size_t kAttributes = 6; // two of the normal, four of the colour
constexpr std::size_t kNormalAttributes = 2;
constexpr std::uint32_t kWhite = 0xFFFFFFFFU;

/// What a vertex is predicted from; `before` alone unless it was new across an edge.
struct Parents {
    std::uint8_t from = 0;
    std::uint8_t to = 0;
    std::uint8_t opposite = 0;
    bool acrossEdge = false;
};

std::uint32_t zigzag(std::uint32_t difference) {
    return (difference << 1U) ^ (0U - (difference >> 31U));
}

std::uint32_t unzigzag(std::uint32_t code) {
    return (code >> 1U) ^ (0U - (code & 1U));
}

/// Reads the codes of one cluster's triangles and remembers what each vertex is predicted from.
class ConnectivityDecoder {
public:
    ConnectivityDecoder(ByteReader& codes, ByteReader& indices, std::uint32_t vertexCount)
        : codes_(codes), indices_(indices), vertexCount_(vertexCount) {}

    void decode(std::span<Triangle> triangles) {
        const auto codes = codes_.take(triangles.size());
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const auto code = static_cast<unsigned>(codes[t]);
            triangles[t] = (code >> 4U) == kNotEntered ? unentered(code) : entered(code);
        }
    }

    /// Parents by vertex; those at and past `next` were never new.
    const std::array<Parents, 256>& parents() const { return parents_; }

private:
    Triangle entered(unsigned code) {
        const unsigned age = code >> 4U;
        if (age >= window_.count()) throw Damage{"a triangle is entered across an edge that is not there"};
        const OpenEdge edge = window_.recent(age);
        const unsigned low = code & 15U;
        unsigned third = next_ - low;
        if (low == 0) {
            if (next_ >= vertexCount_) throw Damage{"a triangle has a corner past the last vertex"};
            const bool known = std::max({edge.from, edge.to, edge.opposite}) < next_;
            parents_[next_++] = {edge.from, edge.to, edge.opposite, known};
        } else if (low == kExplicit) {
            third = index();
        } else if (low > next_) {
            throw Damage{"a triangle has a corner before the first vertex"};
        }
        const auto corner = static_cast<std::uint8_t>(third);
        window_.pushTriangle(edge.from, edge.to, corner, true);
        return {edge.from, edge.to, corner};
    }

    Triangle unentered(unsigned code) {
        Triangle triangle{};
        for (unsigned k = 0; k < 3; ++k) {
            if ((code >> k & 1U) == 0) {
                triangle[k] = static_cast<std::uint8_t>(index());
                continue;
            }
            if (next_ >= vertexCount_) throw Damage{"a triangle has a corner past the last vertex"};
            triangle[k] = static_cast<std::uint8_t>(next_++);
        }
        window_.pushTriangle(triangle[0], triangle[1], triangle[2], false);
        return triangle;
    }

    unsigned index() {
        const auto value = indices_.take<std::uint8_t>();
        if (value >= vertexCount_) throw Damage{"a triangle has a corner past the last vertex"};
        return value;
    }

    ByteReader& codes_;
    ByteReader& indices_;
    std::uint32_t vertexCount_;
    unsigned next_ = 0;
    EdgeWindow window_;
    std::array<Parents, 256> parents_{};
};

/// Writes the codes of one cluster's triangles.
class ConnectivityEncoder {
public:
    ConnectivityEncoder(ByteWriter& codes, ByteWriter& indices) : codes_(codes), indices_(indices) {}

    void encode(std::span<const Triangle> triangles) {
        for (const Triangle& triangle : triangles)
            encode(triangle);
    }

    const std::array<Parents, 256>& parents() const { return parents_; }

private:
    void encode(const Triangle& t) {
        const unsigned ages = std::min(window_.count(), kNotEntered);
        for (unsigned age = 0; age < ages; ++age) {
            const OpenEdge edge = window_.recent(age);
            if (edge.from != t[0] || edge.to != t[1]) continue;
            codes_.put(static_cast<std::uint8_t>(age << 4U | third(t[2], edge)));
            window_.pushTriangle(t[0], t[1], t[2], true);
            return;
        }
        unsigned code = kNotEntered << 4U;
        for (unsigned k = 0; k < 3; ++k) {
            if (t[k] == next_) {
                code |= 1U << k;
                ++next_;
            } else {
                indices_.put(t[k]);
            }
        }
        codes_.put(static_cast<std::uint8_t>(code));
        window_.pushTriangle(t[0], t[1], t[2], false);
    }

    unsigned third(std::uint8_t corner, const OpenEdge& edge) {
        if (corner == next_) {
            const bool known = std::max({edge.from, edge.to, edge.opposite}) < next_;
            parents_[next_++] = {edge.from, edge.to, edge.opposite, known};
            return 0;
        }
        if (corner < next_ && next_ - corner < kExplicit) return next_ - corner;
        indices_.put(corner);
        return kExplicit;
    }

    ByteWriter& codes_;
    ByteWriter& indices_;
    unsigned next_ = 0;
    EdgeWindow window_;
    std::array<Parents, 256> parents_{};
};

GridPoint predictedPosition(std::span<const Vertex> vertices, std::size_t v, const Parents& parents) {
    if (!parents.acrossEdge) return vertices[v - 1].position;
    const GridPoint& a = vertices[parents.from].position;
    const GridPoint& b = vertices[parents.to].position;
    const GridPoint& c = vertices[parents.opposite].position;
    return {a.x + b.x - c.x, a.y + b.y - c.y, a.z + b.z - c.z};
}

/// Values of one kind for all vertices of a page, as differences from their predictions.
using Channel = std::vector<std::uint32_t>;

void putPlanes(const Channel& channel, ByteWriter& out) {
    std::uint32_t any = 0;
    for (const std::uint32_t value : channel)
        any |= value;
    const auto planes = static_cast<std::uint8_t>((std::bit_width(any) + 7) / 8);
    out.put(planes);
    for (unsigned plane = 0; plane < planes; ++plane)
        for (const std::uint32_t value : channel)
            out.put(static_cast<std::uint8_t>(value >> (8U * plane)));
}

void takePlanes(ByteReader& in, Channel& channel) {
    const auto planes = in.take<std::uint8_t>();
    if (planes > 4) throw Damage{"a value has more than four bytes"};
    std::fill(channel.begin(), channel.end(), 0U);
    for (unsigned plane = 0; plane < planes; ++plane) {
        const auto bytes = in.take(channel.size());
        for (std::size_t i = 0; i < bytes.size(); ++i)
            channel[i] |= static_cast<std::uint32_t>(bytes[i]) << (8U * plane);
    }
}

/// Which attributes a page has and how many low bits all its normals lack.
struct AttributeLayout {
    std::size_t begin = kNormalAttributes; // of the attributes that are stored
    std::size_t end = kNormalAttributes;
    unsigned normalShift = 0;

    unsigned width(std::size_t attribute) const { return attribute < kNormalAttributes ? 16U - normalShift : 8U; }

    /// Normals as offset binary, so that a mean of two lies between them.
    std::uint32_t value(const Vertex& vertex, std::size_t attribute) const {
        if (attribute < kNormalAttributes)
            return ((vertex.normal >> (16U * attribute) & 0xFFFFU) ^ 0x8000U) >> normalShift;
        return vertex.color >> (8U * (attribute - kNormalAttributes)) & 0xFFU;
    }

    void set(Vertex& vertex, std::size_t attribute, std::uint32_t value) const {
        if (attribute < kNormalAttributes) {
            const unsigned shift = 16U * static_cast<unsigned>(attribute);
            vertex.normal = (vertex.normal & ~(0xFFFFU << shift)) | ((value << normalShift ^ 0x8000U) << shift);
        } else {
            const unsigned shift = 8U * static_cast<unsigned>(attribute - kNormalAttributes);
            vertex.color = (vertex.color & ~(0xFFU << shift)) | value << shift;
        }
    }

    /// From the vertices before `v` (an index in the page) in its cluster, which begins at `first`.
    std::uint32_t predicted(
        std::span<const Vertex> vertices,
        std::size_t first,
        std::size_t v,
        const Parents& parents,
        std::size_t k) const {
        if (parents.acrossEdge)
            return (value(vertices[first + parents.from], k) + value(vertices[first + parents.to], k)) / 2;
        return v == 0 ? 0 : value(vertices[v - 1], k);
    }
};

AttributeLayout layoutOf(std::span<const Vertex> vertices) {
    AttributeLayout layout;
    std::uint32_t normalBits = 0x8000U;
    for (const Vertex& vertex : vertices) {
        if (vertex.normal != kNoNormal) layout.begin = 0;
        if (vertex.color != kWhite) layout.end = kAttributes;
        normalBits |= vertex.normal | vertex.normal >> 16U;
    }
    layout.normalShift = static_cast<unsigned>(std::countr_zero(normalBits));
    return layout;
}

std::uint32_t positionCode(std::uint32_t value, std::uint32_t prediction) {
    return zigzag(value - prediction);
}

std::uint32_t attributeCode(std::uint32_t value, std::uint32_t prediction, unsigned width) {
    const auto difference = static_cast<std::int32_t>((value - prediction) << (32U - width)) >> (32U - width);
    return zigzag(static_cast<std::uint32_t>(difference));
}

} // namespace

void encodeClusters(const Page& page, ByteWriter& out) {
    const AttributeLayout layout = layoutOf(page.vertices);
    std::array<Channel, kAxes + kAttributes> channels;
    ByteWriter codes;
    ByteWriter indices;
    GridPoint anchor{};
    for (const Cluster& cluster : page.clusters) {
        ConnectivityEncoder connectivity(codes, indices);
        connectivity.encode(std::span(page.triangles).subspan(cluster.firstTriangle, cluster.triangleCount));
        const auto vertices = std::span(page.vertices).subspan(cluster.firstVertex, cluster.vertexCount);
        out.putVarint(positionCode(vertices[0].position.x, anchor.x));
        out.putVarint(positionCode(vertices[0].position.y, anchor.y));
        out.putVarint(positionCode(vertices[0].position.z, anchor.z));
        anchor = vertices[0].position;
        for (std::size_t v = 0; v < vertices.size(); ++v) {
            const Parents& parents = connectivity.parents()[v];
            const GridPoint p = vertices[v].position;
            const GridPoint q = v == 0 ? anchor : predictedPosition(vertices, v, parents);
            channels[0].push_back(positionCode(p.x, q.x));
            channels[1].push_back(positionCode(p.y, q.y));
            channels[2].push_back(positionCode(p.z, q.z));
            const std::size_t inPage = cluster.firstVertex + v;
            for (std::size_t k = layout.begin; k < layout.end; ++k)
                channels[kAxes + k].push_back(attributeCode(
                    layout.value(vertices[v], k),
                    layout.predicted(page.vertices, cluster.firstVertex, inPage, parents, k),
                    layout.width(k)));
        }
    }
    out.put(codes.bytes());
    out.putVarint(indices.size());
    out.put(indices.bytes());
    out.put(static_cast<std::uint8_t>(layout.begin == 0));
    out.put(static_cast<std::uint8_t>(layout.end == kAttributes));
    out.put(static_cast<std::uint8_t>(layout.normalShift));
    for (std::size_t k = 0; k < kAxes; ++k)
        putPlanes(channels[k], out);
    for (std::size_t k = layout.begin; k < layout.end; ++k)
        putPlanes(channels[kAxes + k], out);
}

namespace {

AttributeLayout takeLayout(ByteReader& in) {
    AttributeLayout layout;
    if (in.take<std::uint8_t>() != 0) layout.begin = 0;
    if (in.take<std::uint8_t>() != 0) layout.end = kAttributes;
    layout.normalShift = in.take<std::uint8_t>();
    if (layout.normalShift > 15) throw Damage{"normals lack more bits than they have"};
    return layout;
}

/// Decodes the vertices of one cluster, each from those before it.
class VertexDecoder {
public:
    VertexDecoder(ByteReader& in, Page& page) : page_(page), layout_(takeLayout(in)) {
        for (std::size_t k = 0; k < kAxes; ++k)
            take(in, channels_[k]);
        for (std::size_t k = layout_.begin; k < layout_.end; ++k)
            take(in, channels_[kAxes + k]);
    }

    void decode(Cluster& cluster, const GridPoint& anchor, const std::array<Parents, 256>& parents) {
        const auto vertices = std::span(page_.vertices).subspan(cluster.firstVertex, cluster.vertexCount);
        cluster.box = {};
        for (std::size_t v = 0; v < vertices.size(); ++v) {
            const std::size_t i = cluster.firstVertex + v;
            const GridPoint q = v == 0 ? anchor : predictedPosition(vertices, v, parents[v]);
            vertices[v].position = {
                q.x + unzigzag(channels_[0][i]), q.y + unzigzag(channels_[1][i]), q.z + unzigzag(channels_[2][i])};
            cluster.box.add(vertices[v].position);
        }
        for (std::size_t k = layout_.begin; k < layout_.end; ++k)
            decodeAttribute(cluster, parents, k);
        if (std::max({cluster.box.max.x, cluster.box.max.y, cluster.box.max.z}) > kMaxGridCoordinate)
            throw Damage{"a vertex leaves the grid"};
    }

private:
    void take(ByteReader& in, Channel& channel) {
        channel.resize(page_.vertices.size());
        takePlanes(in, channel);
    }

    void decodeAttribute(const Cluster& cluster, const std::array<Parents, 256>& parents, std::size_t k) {
        const std::uint32_t mask = (1U << layout_.width(k)) - 1U;
        for (std::size_t v = 0; v < cluster.vertexCount; ++v) {
            const std::size_t i = cluster.firstVertex + v;
            const std::uint32_t prediction = layout_.predicted(page_.vertices, cluster.firstVertex, i, parents[v], k);
            layout_.set(page_.vertices[i], k, (prediction + unzigzag(channels_[kAxes + k][i])) & mask);
        }
    }

    Page& page_;
    AttributeLayout layout_;
    std::array<Channel, kAxes + kAttributes> channels_;
};

std::vector<GridPoint> takeAnchors(ByteReader& in, std::size_t count) {
    std::vector<GridPoint> anchors(count);
    GridPoint before{};
    for (GridPoint& anchor : anchors) {
        const auto next = [&in] { return unzigzag(static_cast<std::uint32_t>(in.takeVarint())); };
        anchor.x = before.x + next();
        anchor.y = before.y + next();
        anchor.z = before.z + next();
        before = anchor;
    }
    return anchors;
}

} // namespace

void decodeClusters(ByteReader& in, Page& page) {
    const std::vector<GridPoint> anchors = takeAnchors(in, page.clusters.size());
    const Cluster& last = page.clusters.back();
    ByteReader codes(in.take(last.firstTriangle + last.triangleCount));
    ByteReader indices(in.take(in.takeVarint()));
    page.triangles.resize(codes.remaining());
    page.vertices.resize(last.firstVertex + last.vertexCount);
    VertexDecoder vertices(in, page);
    for (std::size_t c = 0; c < page.clusters.size(); ++c) {
        Cluster& cluster = page.clusters[c];
        ConnectivityDecoder connectivity(codes, indices, cluster.vertexCount);
        connectivity.decode(std::span(page.triangles).subspan(cluster.firstTriangle, cluster.triangleCount));
        vertices.decode(cluster, anchors[c], connectivity.parents());
    }
    indices.expectEnd();
}

} // namespace gnomon::hierarchy
