#include "plain_codec.h"

#include "hierarchy/codec/connectivity_code.h"
#include "hierarchy/codec/vertex_code.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace gnomon::hierarchy {

namespace {

struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t opposite = 0;
};

/// By vertex of a cluster, the edge across which it was new.
using NewAcross = std::vector<std::optional<Edge>>;

std::uint32_t byteOf(ByteReader& in) {
    return in.take<std::uint8_t>();
}

/// The triangles of one cluster.
class PlainTriangles {
public:
    PlainTriangles(ByteReader& codes, ByteReader& indices, std::uint32_t vertexCount)
        : codes_(codes), indices_(indices), vertexCount_(vertexCount) {}

    Triangle next() {
        const std::uint32_t code = byteOf(codes_);
        const bool isEntered = code >> 4U != kNotEntered;
        const auto [a, b, c] = isEntered ? entered(code >> 4U, code & 15U) : unentered(code & 15U);
        if (!isEntered) open_.push_back({b, a, c});
        open_.push_back({a, c, b});
        open_.push_back({c, b, a});
        return {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)};
    }

    NewAcross newAcross() const {
        NewAcross across = across_;
        across.resize(vertexCount_);
        return across;
    }

private:
    using Corners = std::array<std::uint32_t, 3>;

    Corners unentered(std::uint32_t isNew) {
        Corners corners{};
        for (unsigned k = 0; k < 3; ++k)
            corners[k] = (isNew >> k & 1U) != 0 ? newCorner({}) : explicitCorner();
        return corners;
    }

    Corners entered(std::uint32_t age, std::uint32_t low) {
        if (age >= open_.size()) throw Damage{"no such edge"};
        const Edge edge = open_[open_.size() - 1 - age];
        if (low == 0) return {edge.from, edge.to, newCorner(edge)};
        if (low == kExplicit) return {edge.from, edge.to, explicitCorner()};
        if (low > across_.size()) throw Damage{"no such vertex"};
        return {edge.from, edge.to, static_cast<std::uint32_t>(across_.size()) - low};
    }

    std::uint32_t newCorner(const std::optional<Edge>& edge) {
        if (across_.size() >= vertexCount_) throw Damage{"no such vertex"};
        across_.push_back(edge);
        return static_cast<std::uint32_t>(across_.size() - 1);
    }

    std::uint32_t explicitCorner() {
        const std::uint32_t corner = byteOf(indices_);
        if (corner >= vertexCount_) throw Damage{"no such vertex"};
        return corner;
    }

    ByteReader& codes_;
    ByteReader& indices_;
    std::uint32_t vertexCount_;
    NewAcross across_;
    std::vector<Edge> open_;
};

std::vector<std::uint32_t> takeNumbers(ByteReader& in, std::size_t count) {
    const std::uint32_t planes = byteOf(in);
    if (planes > 4) throw Damage{"too many planes"};
    std::vector<std::uint32_t> numbers(count, 0);
    for (std::uint32_t plane = 0; plane < planes; ++plane)
        for (std::uint32_t& number : numbers)
            number |= byteOf(in) << (8 * plane);
    return numbers;
}

/// One vertex after the other, its numbers taken as they come.
class PlainVertices {
public:
    PlainVertices(ByteReader& in, std::size_t count) : anchors_(in.take(in.takeVarint())) {
        hasNormals_ = byteOf(in) != 0;
        hasColors_ = byteOf(in) != 0;
        code_.shift = byteOf(in);
        if (code_.shift > 15) throw Damage{"shift"};
        references_ = takeNumbers(in, count);
        const auto fresh = static_cast<std::size_t>(std::count(references_.begin(), references_.end(), 0U));
        const std::size_t channels = 3U + (hasNormals_ ? 2U : 0U) + (hasColors_ ? 4U : 0U);
        for (std::size_t k = 0; k < channels; ++k)
            differences_.push_back(takeNumbers(in, fresh));
    }

    void decode(Cluster& cluster, const NewAcross& across, Page& page) {
        const auto vertices = std::span(page.vertices).subspan(cluster.firstVertex, cluster.vertexCount);
        std::uint32_t expected = cluster.firstVertex;
        cluster.box = {};
        for (std::uint32_t v = 0; v < cluster.vertexCount; ++v) {
            const std::uint32_t reference = references_[cluster.firstVertex + v];
            if (reference != 0) {
                const std::uint32_t earlier = expected + unzigzag(reference - 1);
                if (earlier >= cluster.firstVertex) throw Damage{"reference"};
                vertices[v] = page.vertices[earlier];
                expected = earlier + 1;
            } else {
                vertices[v] = fresh(vertices, v, across[v]);
            }
            const GridPoint& p = vertices[v].position;
            if (p.x > kMaxGridCoordinate || p.y > kMaxGridCoordinate || p.z > kMaxGridCoordinate)
                throw Damage{"off the grid"};
            cluster.box.add(p);
        }
    }

    void expectEnd() const { anchors_.expectEnd(); }

private:
    Vertex fresh(std::span<const Vertex> vertices, std::uint32_t v, const std::optional<Edge>& edge) {
        const bool isAcross = edge && edge->from < v && edge->to < v && edge->opposite < v;
        Vertex none;
        if (v == 0) none.position = anchor_ = nextAnchor();
        const Vertex& before = v == 0 ? none : vertices[v - 1];
        const Vertex& a = isAcross ? vertices[edge->from] : before;
        const Vertex& b = isAcross ? vertices[edge->to] : before;
        const Vertex& c = isAcross ? vertices[edge->opposite] : before;
        const auto difference = [&](std::size_t channel) { return unzigzag(differences_[channel][fresh_]); };
        Vertex vertex;
        vertex.position = {
            a.position.x + b.position.x - c.position.x + difference(0),
            a.position.y + b.position.y - c.position.y + difference(1),
            a.position.z + b.position.z - c.position.z + difference(2)};
        if (hasNormals_)
            vertex.normal = code_.normal(
                (code_.x(a.normal) + code_.x(b.normal)) / 2 + difference(3),
                (code_.y(a.normal) + code_.y(b.normal)) / 2 + difference(4));
        if (hasColors_) {
            vertex.color = 0;
            for (unsigned k = 0; k < 4; ++k) {
                const std::uint32_t mean = ((a.color >> 8U * k & 0xFFU) + (b.color >> 8U * k & 0xFFU)) / 2;
                vertex.color |= ((mean + difference((hasNormals_ ? 5U : 3U) + k)) & 0xFFU) << 8U * k;
            }
        }
        ++fresh_;
        return vertex;
    }

    GridPoint nextAnchor() {
        const auto next = [this] { return unzigzag(static_cast<std::uint32_t>(anchors_.takeVarint())); };
        GridPoint p = anchor_;
        p.x += next();
        p.y += next();
        p.z += next();
        return p;
    }

    ByteReader anchors_;
    bool hasNormals_ = false;
    bool hasColors_ = false;
    NormalCode code_;
    std::vector<std::uint32_t> references_;
    std::vector<std::vector<std::uint32_t>> differences_; // by channel
    GridPoint anchor_;
    std::size_t fresh_ = 0; // taken so far
};

} // namespace

void plainlyDecodeClusters(ByteReader& in, Page& page) {
    const Cluster& last = page.clusters.back();
    page.triangles.resize(last.firstTriangle + last.triangleCount);
    page.vertices.resize(last.firstVertex + last.vertexCount);
    ByteReader codes(in.take(page.triangles.size()));
    ByteReader indices(in.take(in.takeVarint()));
    std::vector<NewAcross> across;
    for (const Cluster& cluster : page.clusters) {
        PlainTriangles triangles(codes, indices, cluster.vertexCount);
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t)
            page.triangles[cluster.firstTriangle + t] = triangles.next();
        across.push_back(triangles.newAcross());
    }
    indices.expectEnd();
    PlainVertices vertices(in, page.vertices.size());
    for (std::size_t c = 0; c < page.clusters.size(); ++c)
        vertices.decode(page.clusters[c], across[c], page);
    vertices.expectEnd();
}

} // namespace gnomon::hierarchy
