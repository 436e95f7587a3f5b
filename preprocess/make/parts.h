// Simple solids and sheets, from which the test models plant and planes are built. The same code can count their
// vertices or create them.
#pragma once

#include "preprocess/make/made_model.h"

#include <vector>

namespace gnomon::make {

/// Receives the solids and sheets (parts) of a test model. It either only counts their vertices and triangles, or also
/// writes them. The counted size therefore always agrees with the written size. A part is a list of vertices and the
/// triangles between them.
class PartSink {
public:
    /// Creates a sink that only counts the vertices and triangles of the parts.
    PartSink() = default;

    /// Creates a sink that writes parts to `sink`. The first vertex has the index `firstVertex` in the whole model.
    PartSink(MeshSink& sink, std::uint64_t firstVertex) : sink_(&sink), firstVertex_(firstVertex) {}

    /// Sets the coordinate frame of the next parts: the origin, and the axes as the columns of the rotation matrix
    /// `axes`.
    void place(const glm::dvec3& origin, const glm::dmat3& axes);

    /// Begins a part with `vertices` vertices and `triangles` triangles. Returns false if the sink only counts. The
    /// caller must then add neither vertices nor triangles.
    bool begin(std::uint64_t vertices, std::uint64_t triangles);

    void vertex(const glm::dvec3& position);

    /// Adds a triangle with counter-clockwise corners, seen from outside. The corners are vertex numbers within the
    /// part.
    void triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        if (triangles_.size() >= kHeldBack) finish();
        triangles_.push_back({part_ + a, part_ + b, part_ + c});
    }

    void quad(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }

    /// Writes the buffered vertices and triangles. The caller must call this function once at the end.
    void finish();

    const MeshSize& size() const { return size_; }

private:
    static constexpr std::size_t kHeldBack = 4096; // max number of buffered vertices and of buffered triangles

    MeshSink* sink_ = nullptr;
    std::uint64_t firstVertex_ = 0;
    std::uint64_t part_ = 0; // index in the whole model of the part's first vertex
    glm::dvec3 origin_{0};
    glm::dmat3 axes_{1};
    MeshSize size_;
    std::vector<glm::vec3> vertices_;
    std::vector<MadeTriangle> triangles_;
};

/// Returns the rotation matrix for `turns` quarter turns about the y axis, without rounding errors. One quarter turn
/// maps x to -z.
glm::dmat3 quarterTurned(int turns);

/// Says whether a sheet has triangles on one side or on both sides. Many exporters write both sides.
enum class Sides { One, Both };

/// Says whether the ends of a tube are open or closed.
enum class Ends { Open, Closed };

/// Adds an axis-aligned box of 12 triangles that share their corner vertices.
void addBox(PartSink& sink, const glm::dvec3& min, const glm::dvec3& max);

/// Adds an axis-aligned box of 12 triangles. Its six sides do not share vertices.
void addUnweldedBox(PartSink& sink, const glm::dvec3& min, const glm::dvec3& max);

/// Adds a rectangle of 2 triangles with the corner `corner` and the edges `u` and `v`. Its front side faces the
/// direction u x v.
void addSheet(
    PartSink& sink, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, Sides sides = Sides::One);

/// A rectangle that is divided into cellsU by cellsV quads, optionally with waves. The waves displace the vertices by
/// up to `waveDepth` along u x v, with one ridge per two cells along u.
struct Panel {
    glm::dvec3 corner{0};
    glm::dvec3 u{0};
    glm::dvec3 v{0};
    std::uint64_t cellsU = 1;
    std::uint64_t cellsV = 1;
    double waveDepth = 0;
    Sides sides = Sides::One;
};

/// Adds the triangles of the rectangle `panel`.
void addPanel(PartSink& sink, const Panel& panel);

/// Adds a steel I-beam of 24 triangles from `a` to `b`, with open ends. Its height along `up` is `depth`.
void addIBeam(PartSink& sink, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up, double depth);

/// Adds an L-shaped beam of 4 triangles from `a` to `b`: two sheets with a common edge on this line.
void addAngle(PartSink& sink, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up, double width);

/// Adds a tube with `sides` sides along the points of `path`.
void addTube(PartSink& sink, std::span<const glm::dvec3> path, double radius, std::uint64_t sides, Ends ends);

/// Adds a straight tube with `sides` sides from `a` to `b`.
void addRod(PartSink& sink, const glm::dvec3& a, const glm::dvec3& b, double radius, std::uint64_t sides, Ends ends);

/// Adds a torus with the centre `center` around the direction `axis`.
void addRing(
    PartSink& sink,
    const glm::dvec3& center,
    const glm::dvec3& axis,
    double radius,
    double thickness,
    std::uint64_t segments);

/// One point of the profile of a body of revolution: its position along the axis and its radius.
struct Station {
    double along = 0;
    double radius = 0;
};

/// Adds a body of revolution around the line from `origin` along the unit vector `axis`. `turn` rotates the body about
/// this line. An end of radius 0 becomes a point and closes the body.
void addLathe(
    PartSink& sink,
    const glm::dvec3& origin,
    const glm::dvec3& axis,
    std::span<const Station> profile,
    std::uint64_t sides,
    double turn = 0);

/// Adds a closed surface through `rings` rings of `around` points each. The points of ring i are shape(i / (rings - 1),
/// j / around). They are counter-clockwise, seen from the last ring. A fan of triangles closes each end.
template <class Shape>
void addSkin(PartSink& sink, std::uint64_t rings, std::uint64_t around, const Shape& shape) {
    if (!sink.begin(rings * around + 2, 2 * around * rings)) return;
    std::array<glm::dvec3, 2> middles{};
    for (std::uint64_t i = 0; i < rings; ++i)
        for (std::uint64_t j = 0; j < around; ++j) {
            const glm::dvec3 point = shape(
                static_cast<double>(i) / static_cast<double>(rings - 1),
                static_cast<double>(j) / static_cast<double>(around));
            sink.vertex(point);
            if (i == 0) middles[0] += point / static_cast<double>(around);
            if (i + 1 == rings) middles[1] += point / static_cast<double>(around);
        }
    for (const glm::dvec3& middle : middles)
        sink.vertex(middle);
    const std::uint64_t last = (rings - 1) * around;
    for (std::uint64_t j = 0; j < around; ++j) {
        const std::uint64_t k = (j + 1) % around;
        sink.triangle(k, j, last + around);
        sink.triangle(last + j, last + k, last + around + 1);
        for (std::uint64_t ring = 0; ring < last; ring += around)
            sink.quad(ring + j, ring + k, ring + around + k, ring + around + j);
    }
}

/// Returns a path through `corners`, whose right angles are rounded to arcs. Each arc has the radius `radius` and
/// `steps` steps.
std::vector<glm::dvec3> roundedPath(std::span<const glm::dvec3> corners, double radius, std::uint64_t steps);

} // namespace gnomon::make
