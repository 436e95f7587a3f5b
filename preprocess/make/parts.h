// The simple solids and sheets that plants and aeroplanes are put together from, counted or made by the same code.
#pragma once

#include "preprocess/make/made_model.h"

#include <vector>

namespace gnomon::make {

/// Takes parts one after another and either only counts them or makes them, so that the two never disagree. A part is
/// a run of vertices and the triangles between them.
class PartSink {
public:
    /// Only counts.
    PartSink() = default;

    /// Makes: parts go to `sink`, whose next vertex has the index `firstVertex` in the whole model.
    PartSink(MeshSink& sink, std::uint64_t firstVertex) : sink_(&sink), firstVertex_(firstVertex) {}

    /// Parts from here on stand at `origin`, their axes along the columns of `axes` (a rotation).
    void place(const glm::dvec3& origin, const glm::dmat3& axes);

    /// Begins a part of exactly that size. False if it is only counted: then the part ends here.
    bool begin(std::uint64_t vertices, std::uint64_t triangles);

    void vertex(const glm::dvec3& position);

    /// Corners count from the part's first vertex; counter-clockwise seen from outside.
    void triangle(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
        if (triangles_.size() >= kHeldBack) finish();
        triangles_.push_back({part_ + a, part_ + b, part_ + c});
    }

    void quad(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }

    /// Hands on what is still held back; to be called once, at the end.
    void finish();

    const MeshSize& size() const { return size_; }

private:
    static constexpr std::size_t kHeldBack = 4096; // vertices, triangles

    MeshSink* sink_ = nullptr;
    std::uint64_t firstVertex_ = 0;
    std::uint64_t part_ = 0; // the part's first vertex
    glm::dvec3 origin_{0};
    glm::dmat3 axes_{1};
    MeshSize size_;
    std::vector<glm::vec3> vertices_;
    std::vector<MadeTriangle> triangles_;
};

/// Axes turned by `turns` quarters about y: x goes to -z for one. Exact.
glm::dmat3 quarterTurned(int turns);

/// Whether a sheet is written once or, as exporters like to, once for each side.
enum class Sides { One, Both };

/// Whether the ends of something long are left open.
enum class Ends { Open, Closed };

/// An axis-aligned box. 12 triangles.
void addBox(PartSink& sink, const glm::dvec3& min, const glm::dvec3& max);

/// The same of six sheets that share no vertex. 12 triangles.
void addUnweldedBox(PartSink& sink, const glm::dvec3& min, const glm::dvec3& max);

/// A rectangle of 2 triangles with corner `corner` and edges `u` and `v`; faces u x v.
void addSheet(
    PartSink& sink, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, Sides sides = Sides::One);

/// A rectangle of n by m cells, its cells pushed along u x v by a wave of `depth` with one ridge every two cells of u.
struct Panel {
    glm::dvec3 corner{0};
    glm::dvec3 u{0};
    glm::dvec3 v{0};
    std::uint64_t cellsU = 1;
    std::uint64_t cellsV = 1;
    double waveDepth = 0;
    Sides sides = Sides::One;
};

void addPanel(PartSink& sink, const Panel& panel);

/// A rolled steel I-section from `a` to `b`, `depth` high along `up`, open at its ends. 24 triangles.
void addIBeam(PartSink& sink, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up, double depth);

/// An angle section of two sheets that share the line from `a` to `b`. 4 triangles.
void addAngle(PartSink& sink, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& up, double width);

/// A hose of `sides` around the line through `path`.
void addTube(PartSink& sink, std::span<const glm::dvec3> path, double radius, std::uint64_t sides, Ends ends);

/// A straight tube.
void addRod(PartSink& sink, const glm::dvec3& a, const glm::dvec3& b, double radius, std::uint64_t sides, Ends ends);

/// A closed ring of tube around `axis` through `center`.
void addRing(
    PartSink& sink,
    const glm::dvec3& center,
    const glm::dvec3& axis,
    double radius,
    double thickness,
    std::uint64_t segments);

/// A station of a turned body: how far along the axis, and the radius there.
struct Station {
    double along = 0;
    double radius = 0;
};

/// A body turned about the line from `origin` along the unit vector `axis`; `turn` shifts where its sides begin. Ends
/// of radius 0 become points and close it.
void addLathe(
    PartSink& sink,
    const glm::dvec3& origin,
    const glm::dvec3& axis,
    std::span<const Station> profile,
    std::uint64_t sides,
    double turn = 0);

/// A closed skin around rings: ring i of `rings` has `around` points shape(i / (rings - 1), j / around),
/// counter-clockwise seen from the last ring, and both ends are closed around the middle of their ring.
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

/// The way through `corners` with each right angle rounded over `radius` in `steps` steps.
std::vector<glm::dvec3> roundedPath(std::span<const glm::dvec3> corners, double radius, std::uint64_t steps);

} // namespace gnomon::make
