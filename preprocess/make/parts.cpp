#include "preprocess/make/parts.h"

#include "preprocess/make/noise.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

namespace {

using glm::dvec3;

/// Returns a unit vector perpendicular to `direction`. It is horizontal unless `direction` is steep.
dvec3 sideways(const dvec3& direction) {
    const dvec3 helper = std::abs(direction.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    return glm::normalize(glm::cross(helper, direction));
}

/// Adds the quads between two rings of `sides` vertices. The first vertex of each ring has the number `a` or `b`. Seen
/// from ring `b`, the vertices of both rings are in counter-clockwise order.
void addRingQuads(PartSink& sink, std::uint64_t a, std::uint64_t b, std::uint64_t sides) {
    for (std::uint64_t i = 0; i < sides; ++i) {
        const std::uint64_t j = (i + 1) % sides;
        sink.quad(a + i, a + j, b + j, b + i);
    }
}

void addFan(PartSink& sink, std::uint64_t ring, std::uint64_t tip, std::uint64_t sides, bool forward) {
    for (std::uint64_t i = 0; i < sides; ++i) {
        const std::uint64_t j = (i + 1) % sides;
        if (forward)
            sink.triangle(ring + i, ring + j, tip);
        else
            sink.triangle(ring + j, ring + i, tip);
    }
}

void addCircle(
    PartSink& sink, const dvec3& center, const dvec3& u, const dvec3& v, std::uint64_t sides, double turn = 0) {
    for (std::uint64_t i = 0; i < sides; ++i) {
        const double t = turn + static_cast<double>(i) / static_cast<double>(sides);
        sink.vertex(center + u * cosTurns(t) + v * sinTurns(t));
    }
}

std::array<dvec3, 8> boxCorners(const dvec3& min, const dvec3& max) {
    std::array<dvec3, 8> corners{};
    for (std::size_t i = 0; i < 8; ++i)
        corners.at(i) = {(i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y, (i & 4U) != 0 ? max.z : min.z};
    return corners;
}

/// The corners of each face of a box, counter-clockwise seen from outside. Bits 0, 1 and 2 of a corner number select
/// the min or max x, y and z.
constexpr std::array<std::array<std::size_t, 4>, 6> kBoxFaces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// Adds the triangles of one side of the rectangle `panel`. The back side has the triangles of the front side with
/// reversed corners.
void addPanelSide(PartSink& sink, const Panel& panel, bool back) {
    const std::uint64_t n = panel.cellsU;
    const std::uint64_t m = panel.cellsV;
    if (!sink.begin((n + 1) * (m + 1), 2 * n * m)) return;
    const std::array<dvec3, 2> wave{dvec3(0), glm::normalize(glm::cross(panel.u, panel.v)) * panel.waveDepth};
    for (std::uint64_t j = 0; j <= m; ++j)
        for (std::uint64_t i = 0; i <= n; ++i) {
            const double u = static_cast<double>(i) / static_cast<double>(n);
            const double v = static_cast<double>(j) / static_cast<double>(m);
            sink.vertex(panel.corner + u * panel.u + v * panel.v + wave.at(i % 2));
        }
    for (std::uint64_t j = 0; j < m; ++j)
        for (std::uint64_t i = 0; i < n; ++i) {
            const std::uint64_t a = j * (n + 1) + i;
            const std::uint64_t c = a + n + 2;
            if (back)
                sink.triangle(a, c, a + 1);
            else
                sink.triangle(a, a + 1, c);
            if (back)
                sink.triangle(a, c - 1, c);
            else
                sink.triangle(a, c, c - 1);
        }
}

/// Returns the numbers of vertices and triangles of a body of revolution with the profile `profile`.
MeshSize latheSize(std::span<const Station> profile, std::uint64_t sides) {
    MeshSize size;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const bool tip = profile[i].radius == 0;
        const bool tipBefore = i > 0 && profile[i - 1].radius == 0;
        size += {tip ? 1 : sides, i == 0 ? 0 : (tip || tipBefore ? sides : 2 * sides)};
    }
    return size;
}

} // namespace

void PartSink::place(const dvec3& origin, const glm::dmat3& axes) {
    origin_ = origin;
    axes_ = axes;
}

bool PartSink::begin(std::uint64_t vertices, std::uint64_t triangles) {
    part_ = firstVertex_ + size_.vertices;
    size_ += {vertices, triangles};
    return sink_ != nullptr;
}

void PartSink::vertex(const dvec3& position) {
    if (vertices_.size() >= kHeldBack) finish();
    vertices_.emplace_back(origin_ + axes_ * position);
}

void PartSink::finish() {
    if (sink_ == nullptr) return;
    sink_->addVertices(vertices_);
    sink_->addTriangles(triangles_);
    vertices_.clear();
    triangles_.clear();
}

glm::dmat3 quarterTurned(int turns) {
    constexpr std::array<std::array<double, 2>, 4> kTurns{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};
    const auto [c, s] = kTurns.at(static_cast<std::size_t>(turns) % 4);
    return {c, 0, s, 0, 1, 0, -s, 0, c};
}

void addBox(PartSink& sink, const dvec3& min, const dvec3& max) {
    if (!sink.begin(8, 12)) return;
    for (const dvec3& corner : boxCorners(min, max))
        sink.vertex(corner);
    for (const auto& face : kBoxFaces)
        sink.quad(face[0], face[1], face[2], face[3]);
}

void addUnweldedBox(PartSink& sink, const dvec3& min, const dvec3& max) {
    const auto corners = boxCorners(min, max);
    for (const auto& face : kBoxFaces) {
        const dvec3 a = corners.at(face[0]);
        addSheet(sink, a, corners.at(face[1]) - a, corners.at(face[3]) - a);
    }
}

void addSheet(PartSink& sink, const dvec3& corner, const dvec3& u, const dvec3& v, Sides sides) {
    for (int side = 0; side < (sides == Sides::Both ? 2 : 1); ++side) {
        if (!sink.begin(4, 2)) continue;
        sink.vertex(corner);
        sink.vertex(corner + u);
        sink.vertex(corner + u + v);
        sink.vertex(corner + v);
        if (side == 0) {
            sink.quad(0, 1, 2, 3);
        } else {
            sink.triangle(2, 1, 0);
            sink.triangle(3, 2, 0);
        }
    }
}

void addPanel(PartSink& sink, const Panel& panel) {
    addPanelSide(sink, panel, false);
    if (panel.sides == Sides::Both) addPanelSide(sink, panel, true);
}

void addIBeam(PartSink& sink, const dvec3& a, const dvec3& b, const dvec3& up, double depth) {
    if (!sink.begin(24, 24)) return;
    constexpr std::array<std::array<double, 2>, 12> kProfile{
        {{-0.35, -0.5},
         {0.35, -0.5},
         {0.35, -0.42},
         {0.04, -0.42},
         {0.04, 0.42},
         {0.35, 0.42},
         {0.35, 0.5},
         {-0.35, 0.5},
         {-0.35, 0.42},
         {-0.04, 0.42},
         {-0.04, -0.42},
         {-0.35, -0.42}}};
    const dvec3 along = glm::normalize(b - a);
    const dvec3 across = glm::normalize(glm::cross(up, along));
    const dvec3 upright = glm::cross(along, across);
    for (const dvec3& end : {a, b})
        for (const auto& [x, y] : kProfile)
            sink.vertex(end + depth * (x * across + y * upright));
    addRingQuads(sink, 0, 12, 12);
}

void addAngle(PartSink& sink, const dvec3& a, const dvec3& b, const dvec3& up, double width) {
    if (!sink.begin(6, 4)) return;
    const dvec3 across = glm::normalize(glm::cross(up, b - a)) * width;
    const dvec3 upright = glm::normalize(up) * width;
    for (const dvec3& offset : {across, dvec3(0), upright}) {
        sink.vertex(a + offset);
        sink.vertex(b + offset);
    }
    sink.quad(0, 1, 3, 2);
    sink.quad(2, 3, 5, 4);
}

void addTube(PartSink& sink, std::span<const dvec3> path, double radius, std::uint64_t sides, Ends ends) {
    const std::uint64_t rings = path.size();
    const bool closed = ends == Ends::Closed;
    if (!sink.begin(rings * sides + (closed ? 2 : 0), 2 * sides * (rings - 1) + (closed ? 2 * sides : 0))) return;
    dvec3 u = sideways(glm::normalize(path[1] - path[0]));
    for (std::size_t i = 0; i < path.size(); ++i) {
        const dvec3 before = i > 0 ? glm::normalize(path[i] - path[i - 1]) : dvec3(0);
        const dvec3 after = i + 1 < path.size() ? glm::normalize(path[i + 1] - path[i]) : dvec3(0);
        const dvec3 along = glm::normalize(before + after);
        u = glm::normalize(u - along * glm::dot(u, along));
        addCircle(sink, path[i], u * radius, glm::cross(along, u) * radius, sides);
    }
    if (closed) {
        sink.vertex(path.front());
        sink.vertex(path.back());
        addFan(sink, 0, rings * sides, sides, false);
        addFan(sink, (rings - 1) * sides, rings * sides + 1, sides, true);
    }
    for (std::uint64_t ring = 0; ring + 1 < rings; ++ring)
        addRingQuads(sink, ring * sides, (ring + 1) * sides, sides);
}

void addRod(PartSink& sink, const dvec3& a, const dvec3& b, double radius, std::uint64_t sides, Ends ends) {
    const std::array<dvec3, 2> path{a, b};
    addTube(sink, path, radius, sides, ends);
}

void addRing(
    PartSink& sink, const dvec3& center, const dvec3& axis, double radius, double thickness, std::uint64_t segments) {
    constexpr std::uint64_t kSides = 4;
    if (!sink.begin(segments * kSides, 2 * segments * kSides)) return;
    const dvec3 u = sideways(axis);
    const dvec3 v = glm::cross(axis, u);
    for (std::uint64_t i = 0; i < segments; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(segments);
        const dvec3 out = u * cosTurns(t) + v * sinTurns(t);
        addCircle(sink, center + out * radius, axis * thickness, out * thickness, kSides);
    }
    for (std::uint64_t i = 0; i < segments; ++i)
        addRingQuads(sink, i * kSides, (i + 1) % segments * kSides, kSides);
}

void addLathe(
    PartSink& sink,
    const dvec3& origin,
    const dvec3& axis,
    std::span<const Station> profile,
    std::uint64_t sides,
    double turn) {
    const MeshSize size = latheSize(profile, sides);
    if (!sink.begin(size.vertices, size.triangles)) return;
    const dvec3 u = sideways(axis);
    const dvec3 v = glm::cross(axis, u);
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const dvec3 center = origin + axis * profile[i].along;
        const std::uint64_t first = next;
        const bool tip = profile[i].radius == 0;
        if (tip)
            sink.vertex(center);
        else
            addCircle(sink, center, u * profile[i].radius, v * profile[i].radius, sides, turn);
        next += tip ? 1 : sides;
        if (i == 0) continue;
        const bool tipBefore = profile[i - 1].radius == 0;
        const std::uint64_t before = first - (tipBefore ? 1 : sides);
        if (tip)
            addFan(sink, before, first, sides, true);
        else if (tipBefore)
            addFan(sink, first, before, sides, false);
        else
            addRingQuads(sink, before, first, sides);
    }
}

std::vector<dvec3> roundedPath(std::span<const dvec3> corners, double radius, std::uint64_t steps) {
    std::vector<dvec3> path{corners.front()};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const dvec3 in = glm::normalize(corners[i] - corners[i - 1]);
        const dvec3 out = glm::normalize(corners[i + 1] - corners[i]);
        const dvec3 center = corners[i] + radius * (out - in);
        for (std::uint64_t step = 0; step <= steps; ++step) {
            const double t = 0.25 * static_cast<double>(step) / static_cast<double>(steps);
            path.push_back(center + radius * (in * sinTurns(t) - out * cosTurns(t)));
        }
    }
    path.push_back(corners.back());
    return path;
}

} // namespace gnomon::make
