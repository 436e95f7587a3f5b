#include "preprocess/chunk/covered_faces.h"

#include "core/index_table.h"
#include "hierarchy/octahedral.h"
#include "preprocess/proximity/box_tree.h"
#include "preprocess/simplify/color_charge.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace gnomon::chunk {

namespace {

// Max distance in grid steps between coplanar tilted faces. Rounding to the grid causes this distance.
constexpr double kPlaneTolerance = 1.5;
constexpr double kMinWidth = 0.5;           // grid steps; narrower remaining parts are invisible and removed
constexpr double kParallel = 0.99;          // min cosine between the normals of coplanar faces
constexpr std::size_t kMaxCovering = 256;   // max number of triangles that cover one triangle
constexpr std::uint32_t kMaxTested = 16384; // max number of bounding boxes that are tested per triangle
constexpr std::size_t kMaxParts = 128;      // max number of remaining parts of a triangle

using Polygon = std::vector<glm::dvec3>; // corners of a convex polygon

struct Face {
    std::array<glm::dvec3, 3> corners{};
    glm::dvec3 normal{}; // unit length
    double area = 0;     // twice the area
};

glm::dvec3 vectorOf(const hierarchy::GridPoint& p) {
    return {p.x, p.y, p.z};
}

Face faceOf(const simplify::Mesh& mesh, const simplify::Triangle& t) {
    Face face;
    for (std::size_t i = 0; i < 3; ++i)
        face.corners[i] = vectorOf(mesh.vertices[t[i]].position);
    const glm::dvec3 normal = glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    face.area = glm::length(normal);
    face.normal = face.area > 0 ? normal / face.area : glm::dvec3(0);
    return face;
}

std::uint32_t colorOf(const simplify::Mesh& mesh, std::uint32_t triangle) {
    return mesh.vertices[mesh.triangles[triangle][0]].color;
}

/// Returns the triangles whose three corners have the same colour, in order. Returns an empty list if the mesh has only
/// one such colour.
std::vector<std::uint32_t> plainTriangles(const simplify::Mesh& mesh) {
    std::vector<std::uint32_t> plain;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const std::uint32_t color = mesh.vertices[a].color;
        if (mesh.vertices[b].color == color && mesh.vertices[c].color == color) plain.push_back(t);
    }
    const auto isLikeFirst = [&](std::uint32_t t) { return colorOf(mesh, t) == colorOf(mesh, plain.front()); };
    if (std::ranges::all_of(plain, isLikeFirst)) plain.clear();
    return plain;
}

/// Returns the outward normal of the edge that starts at corner `i`, in the plane of `face`.
glm::dvec3 outwards(const Face& face, std::size_t i) {
    return glm::normalize(glm::cross(face.corners[(i + 1) % 3] - face.corners[i], face.normal));
}

bool isInPlaneOf(const Face& small, const Face& large) {
    const glm::dvec3 sides = glm::abs(large.normal);
    // The constant coordinate of an axis-aligned plane is a whole grid coordinate, so half a step of tolerance is
    // sufficient.
    const bool isUpright = std::max({sides.x, sides.y, sides.z}) > 1 - 1e-12;
    return std::ranges::all_of(small.corners, [&](const glm::dvec3& p) {
        return std::abs(glm::dot(p - large.corners[0], large.normal)) <= (isUpright ? 0.5 : kPlaneTolerance);
    });
}

/// Returns true if an edge of the triangle `face` separates it from `other`. The corners of `other` may be up to
/// kMinWidth inside the edge.
bool separates(const Face& face, const Face& other) {
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 away = outwards(face, i);
        const auto isOut = [&](const glm::dvec3& p) { return glm::dot(p - face.corners[i], away) >= -kMinWidth; };
        if (std::ranges::all_of(other.corners, isOut)) return true;
    }
    return false;
}

/// Returns true if `face` and triangle `t` are coplanar and overlap. A cheap first test rejects most triangles without
/// a square root.
bool overlap(const simplify::Mesh& mesh, const Face& face, const simplify::Triangle& t) {
    const glm::dvec3 a = vectorOf(mesh.vertices[t[0]].position);
    const glm::dvec3 b = vectorOf(mesh.vertices[t[1]].position) - a;
    const glm::dvec3 c = vectorOf(mesh.vertices[t[2]].position) - a;
    const glm::dvec3 normal = glm::cross(b, c);
    const double along = glm::dot(normal, face.normal);
    const double square = glm::dot(normal, normal);
    if (along * along <= kParallel * kParallel * square) return false;
    const Face other = faceOf(mesh, t);
    if (!(face.area < other.area ? isInPlaneOf(face, other) : isInPlaneOf(other, face))) return false;
    return !separates(face, other) && !separates(other, face);
}

/// Sorts the indices of `triangles` into four lists by the plane of the triangle: constant x, constant y, constant z,
/// and tilted. Most faces of buildings are in the first three lists. Only faces of one list can be coplanar.
std::array<std::vector<std::uint32_t>, 4> placesByDirection(
    const simplify::Mesh& mesh, std::span<const std::uint32_t> triangles) {
    std::array<std::vector<std::uint32_t>, 4> places;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const simplify::Triangle& t = mesh.triangles[triangles[i]];
        const hierarchy::GridPoint& a = mesh.vertices[t[0]].position;
        const hierarchy::GridPoint& b = mesh.vertices[t[1]].position;
        const hierarchy::GridPoint& c = mesh.vertices[t[2]].position;
        const std::array<bool, 3> isFlat{a.x == b.x && b.x == c.x, a.y == b.y && b.y == c.y, a.z == b.z && b.z == c.z};
        places[isFlat[0] ? 0 : isFlat[1] ? 1 : isFlat[2] ? 2 : 3].push_back(i);
    }
    return places;
}

/// Finds the triangles that overlap a given triangle, have another colour and are earlier in the source.
class Coverings {
public:
    Coverings(const simplify::Mesh& mesh, std::span<const std::uint32_t> triangles)
        : mesh_(mesh),
          triangles_(triangles),
          boxes_(boxesOf(mesh, triangles)),
          colors_(colorsOf(mesh, triangles)),
          tree_(boxes_, colors_) {}

    /// Returns the triangles that cover triangle number `place` of the list, in ascending order. Returns an empty list
    /// if there are too many.
    std::vector<std::uint32_t> of(std::uint32_t place) const {
        proximity::TreeBox box = boxes_[place];
        box.low -= kPlaneTolerance;
        box.high += kPlaneTolerance;
        const Face face = faceOf(mesh_, mesh_.triangles[triangles_[place]]);
        std::vector<std::uint32_t> found;
        std::uint32_t tested = 0;
        if (!(face.area > 0)) return found;
        tree_.forEachOther(box, colors_[place], [&](std::uint32_t other) {
            if (other >= place || ++tested > kMaxTested || found.size() > kMaxCovering) return;
            if (simplify::colorDifference(colors_[place], colors_[other]) <= simplify::kUnseenDifference) return;
            const std::uint32_t triangle = triangles_[other];
            if (overlap(mesh_, face, mesh_.triangles[triangle])) found.push_back(triangle);
        });
        if (tested > kMaxTested || found.size() > kMaxCovering) return {};
        std::sort(found.begin(), found.end());
        return found;
    }

private:
    static std::vector<proximity::TreeBox> boxesOf(
        const simplify::Mesh& mesh, std::span<const std::uint32_t> triangles) {
        std::vector<proximity::TreeBox> boxes(triangles.size());
        for (std::size_t i = 0; i < boxes.size(); ++i)
            for (const std::uint32_t v : mesh.triangles[triangles[i]])
                boxes[i].add(vectorOf(mesh.vertices[v].position));
        return boxes;
    }

    static std::vector<std::uint32_t> colorsOf(const simplify::Mesh& mesh, std::span<const std::uint32_t> triangles) {
        std::vector<std::uint32_t> colors;
        colors.reserve(triangles.size());
        for (const std::uint32_t t : triangles)
            colors.push_back(colorOf(mesh, t));
        return colors;
    }

    const simplify::Mesh& mesh_;
    std::span<const std::uint32_t> triangles_;
    std::vector<proximity::TreeBox> boxes_;
    std::vector<std::uint32_t> colors_;
    proximity::BoxTree tree_;
};

/// Classifies the connected surfaces of a mesh as open or closed.
class OpenSurfaces {
public:
    explicit OpenSurfaces(const simplify::Mesh& mesh)
        : corners_(cornersOf(mesh)),
          adjacency_(mesh.positionCount, corners_),
          state_(mesh.triangles.size(), State::Unknown) {}

    /// Returns true if the connected surface of `triangle` has a boundary edge (an edge of only one triangle).
    bool isOpen(std::uint32_t triangle) {
        if (state_[triangle] == State::Unknown) explore(triangle);
        return state_[triangle] == State::Open;
    }

private:
    enum class State : std::uint8_t { Unknown, Closed, Open };

    static std::vector<simplify::Triangle> cornersOf(const simplify::Mesh& mesh) {
        std::vector<simplify::Triangle> corners;
        corners.reserve(mesh.triangles.size());
        for (const simplify::Triangle& t : mesh.triangles)
            corners.push_back({mesh.positionOf[t[0]], mesh.positionOf[t[1]], mesh.positionOf[t[2]]});
        return corners;
    }

    void explore(std::uint32_t first) {
        std::vector<std::uint32_t> connected{first};
        state_[first] = State::Closed;
        bool isOpen = false;
        for (std::size_t next = 0; next < connected.size(); ++next) {
            const simplify::Triangle& t = corners_[connected[next]];
            for (std::size_t i = 0; i < 3; ++i) {
                bool isShared = false;
                for (const std::uint32_t other : adjacency_.around(t[i])) {
                    const simplify::Triangle& u = corners_[other];
                    if (other == connected[next] || std::ranges::find(u, t[(i + 1) % 3]) == u.end()) continue;
                    isShared = true;
                    if (state_[other] != State::Unknown) continue;
                    state_[other] = State::Closed;
                    connected.push_back(other);
                }
                isOpen = isOpen || !isShared;
            }
        }
        if (!isOpen) return;
        for (const std::uint32_t t : connected)
            state_[t] = State::Open;
    }

    std::vector<simplify::Triangle> corners_;
    simplify::TriangleAdjacency adjacency_;
    std::vector<State> state_;
};

/// Cuts `polygon` by the plane through `point` with the normal `away`. The first result is on the side of the normal,
/// the second on the other side.
std::array<Polygon, 2> cut(const Polygon& polygon, const glm::dvec3& point, const glm::dvec3& away) {
    std::array<Polygon, 2> parts;
    auto& [out, in] = parts;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double sideOfA = glm::dot(a - point, away);
        const double sideOfB = glm::dot(b - point, away);
        if (sideOfA >= 0) out.push_back(a);
        if (sideOfA <= 0) in.push_back(a);
        if ((sideOfA < 0 && sideOfB > 0) || (sideOfA > 0 && sideOfB < 0)) {
            const glm::dvec3 crossing = a + (b - a) * (sideOfA / (sideOfA - sideOfB));
            out.push_back(crossing);
            in.push_back(crossing);
        }
    }
    return parts;
}

/// Returns true if `polygon` is wider than kMinWidth. Narrower polygons are invisible.
bool counts(const Polygon& polygon) {
    if (polygon.size() < 3) return false;
    glm::dvec3 area(0);
    double longest = 0;
    for (std::size_t i = 1; i < polygon.size(); ++i) {
        longest = std::max(longest, glm::length(polygon[i] - polygon[0]));
        area += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    }
    return glm::length(area) > 2 * kMinWidth * longest;
}

/// Returns the pieces of the polygons `parts` that the face `covering` does not cover.
std::vector<Polygon> uncovered(const std::vector<Polygon>& parts, const Face& covering) {
    std::vector<Polygon> left;
    for (Polygon part : parts) {
        std::vector<Polygon> outside;
        for (std::size_t i = 0; i < 3 && !part.empty(); ++i) {
            std::array<Polygon, 2> halves = cut(part, covering.corners[i], outwards(covering, i));
            if (counts(halves[0])) outside.push_back(std::move(halves[0]));
            part = std::move(halves[1]);
        }
        left.insert(left.end(), outside.begin(), outside.end());
    }
    return left;
}

/// Creates mesh vertices for the corners of cut triangles.
class CornerMaker {
    auto isAt(const hierarchy::GridPoint& p) const {
        return [this, p](std::uint32_t v) { return mesh_.vertices[v].position == p; };
    }

public:
    explicit CornerMaker(simplify::Mesh& mesh) : mesh_(mesh), vertexAt_(mesh.vertices.size()) {
        for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
            const hierarchy::GridPoint& p = mesh.vertices[v].position;
            vertexAt_.findOrInsert(hashOf(p.x, p.y, p.z), v, isAt(p));
        }
    }

    /// Returns a mesh vertex at the point `p` in `triangle`. Creates the vertex if the mesh has none there.
    std::uint32_t vertexAt(const simplify::Triangle& triangle, const glm::dvec3& p) {
        const auto rounded = [](double x) { return static_cast<std::uint32_t>(std::llround(std::max(x, 0.0))); };
        const hierarchy::GridPoint point{rounded(p.x), rounded(p.y), rounded(p.z)};
        std::uint32_t nearest = triangle[0];
        for (const std::uint32_t v : triangle) {
            if (mesh_.vertices[v].position == point) return v;
            if (squareFrom(v, p) < squareFrom(nearest, p)) nearest = v;
        }
        hierarchy::Vertex vertex = mesh_.vertices[nearest];
        vertex.position = point;
        vertex.normal = normalAt(triangle, p);
        const std::uint32_t fields = mesh_.fieldsOf(nearest);
        const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
        const auto [found, isNew] = made_.try_emplace({vertex, fields}, next);
        if (!isNew) return found->second;
        mesh_.vertices.push_back(vertex);
        if (mesh_.hasFields()) mesh_.fields.words.push_back(fields);
        mesh_.positionOf.push_back(positionAt(point));
        return next;
    }

private:
    std::uint32_t positionAt(const hierarchy::GridPoint& p) {
        const std::uint32_t known = vertexAt_.find(hashOf(p.x, p.y, p.z), isAt(p));
        if (known != IndexTable::kAbsent) return mesh_.positionOf[known];
        const auto [place, isNew] = newPositionAt_.try_emplace(p, mesh_.positionCount);
        if (isNew) {
            ++mesh_.positionCount;
            mesh_.isBorder.push_back(0);
        }
        return place->second;
    }

    double squareFrom(std::uint32_t v, const glm::dvec3& p) const {
        const glm::dvec3 apart = vectorOf(mesh_.vertices[v].position) - p;
        return glm::dot(apart, apart);
    }

    std::uint32_t normalAt(const simplify::Triangle& t, const glm::dvec3& p) const {
        const std::uint32_t first = mesh_.vertices[t[0]].normal;
        if (mesh_.vertices[t[1]].normal == first && mesh_.vertices[t[2]].normal == first) return first;
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 b = vectorOf(mesh_.vertices[t[(i + 1) % 3]].position) - p;
            const glm::dvec3 c = vectorOf(mesh_.vertices[t[(i + 2) % 3]].position) - p;
            sum += hierarchy::unpackNormal(mesh_.vertices[t[i]].normal) * glm::length(glm::cross(b, c));
        }
        return hierarchy::packNormal(sum);
    }

    simplify::Mesh& mesh_;
    IndexTable vertexAt_; // a vertex of the original mesh at each of its positions
    std::map<hierarchy::GridPoint, std::uint32_t> newPositionAt_;
    std::map<std::pair<hierarchy::Vertex, std::uint32_t>, std::uint32_t> made_;
};

/// Triangulates the remaining parts of a face and appends the triangles to the mesh.
void appendParts(
    CornerMaker& maker,
    const simplify::Triangle& triangle,
    const std::vector<Polygon>& parts,
    const simplify::Mesh& mesh,
    std::vector<simplify::Triangle>& triangles) {
    for (const Polygon& part : parts) {
        std::vector<std::uint32_t> corners;
        for (const glm::dvec3& p : part)
            corners.push_back(maker.vertexAt(triangle, p));
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const simplify::Triangle t{corners[0], corners[i - 1], corners[i]};
            const std::uint32_t a = mesh.positionOf[t[0]];
            const std::uint32_t b = mesh.positionOf[t[1]];
            const std::uint32_t c = mesh.positionOf[t[2]];
            if (a != b && b != c && c != a) triangles.push_back(t);
        }
    }
}

bool isAtBorder(const simplify::Mesh& mesh, const simplify::Triangle& t) {
    return std::ranges::count_if(t, [&](std::uint32_t v) { return mesh.isBorder[mesh.positionOf[v]] != 0; }) > 1;
}

/// Returns the parts of `triangle` that the earlier coplanar triangles in `covering` do not cover. Returns nullopt if
/// the triangle does not change.
std::optional<std::vector<Polygon>> partsOf(
    const simplify::Mesh& mesh,
    std::uint32_t triangle,
    std::span<const std::uint32_t> covering,
    OpenSurfaces& surfaces) {
    const Face face = faceOf(mesh, mesh.triangles[triangle]);
    const std::vector<Polygon> whole{{face.corners.begin(), face.corners.end()}};
    // The parts of `triangle` that no visible face covers. A face of the opposite orientation covers only if both
    // surfaces are open.
    std::vector<Polygon> parts = whole;
    // The same parts, but here one open surface is sufficient for a face of the opposite orientation to cover.
    std::vector<Polygon> unseenParts = whole;
    for (const std::uint32_t other : covering) {
        const Face cover = faceOf(mesh, mesh.triangles[other]);
        const bool facesIt = glm::dot(face.normal, cover.normal) < 0;
        const int open = (surfaces.isOpen(triangle) ? 1 : 0) + (surfaces.isOpen(other) ? 1 : 0);
        if (facesIt && open == 0) continue;
        unseenParts = uncovered(unseenParts, cover);
        if (!facesIt || open == 2) parts = uncovered(parts, cover);
        if (std::max(parts.size(), unseenParts.size()) > kMaxParts) return std::nullopt;
    }
    if (unseenParts.empty()) return unseenParts;
    if (parts == whole) return std::nullopt;
    return parts;
}

} // namespace

std::uint64_t removeCoveredFaces(simplify::Mesh& mesh) {
    const std::vector<std::uint32_t> plain = plainTriangles(mesh);
    std::vector<std::vector<std::uint32_t>> covering(plain.size());
    for (const std::vector<std::uint32_t>& places : placesByDirection(mesh, plain)) {
        std::vector<std::uint32_t> triangles;
        triangles.reserve(places.size());
        for (const std::uint32_t place : places)
            triangles.push_back(plain[place]);
        const Coverings coverings(mesh, triangles);
        tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(places.size()), [&](std::uint32_t i) {
            if (!isAtBorder(mesh, mesh.triangles[triangles[i]])) covering[places[i]] = coverings.of(i);
        });
    }
    if (std::ranges::all_of(covering, [](const auto& some) { return some.empty(); })) return 0;
    OpenSurfaces surfaces(mesh);
    CornerMaker maker(mesh);
    std::vector<simplify::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    std::uint64_t changed = 0;
    std::uint32_t next = 0; // index of the next mesh triangle to copy
    const auto keepUntil = [&](std::size_t end) {
        for (; next < end; ++next)
            triangles.push_back(mesh.triangles[next]);
    };
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (covering[i].empty()) continue;
        const auto parts = partsOf(mesh, plain[i], covering[i], surfaces);
        if (!parts) continue;
        keepUntil(plain[i]);
        appendParts(maker, mesh.triangles[plain[i]], *parts, mesh, triangles);
        ++next;
        ++changed;
    }
    keepUntil(mesh.triangles.size());
    if (triangles.empty()) return 0;
    mesh.triangles = std::move(triangles);
    return changed;
}

} // namespace gnomon::chunk
