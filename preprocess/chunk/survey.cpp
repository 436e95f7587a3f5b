#include "preprocess/chunk/survey.h"

#include "core/error.h"
#include "core/random.h"
#include "preprocess/chunk/field_numbers.h"
#include "preprocess/chunk/vertex_lookup.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace gnomon::chunk {

namespace {

constexpr std::size_t kMaxSampled = std::size_t{1} << 19U;
constexpr int kExponentBias = 1200;
constexpr int kBinsPerOctave = 16;
constexpr std::size_t kMaxStrayShare = 1000; // strays are at most 1 of this many sampled triangles
constexpr std::size_t kMaxFewStrays = 16;    // max number of strays in the second case of mainPart
constexpr std::size_t kMaxFewStrayShare = 8; // strays in the second case are at most 1 of this many triangles
// Min distance of strays in the second case of mainPart, in widths of the other triangles.
constexpr double kFewStraysDistance = 1000;
constexpr double kUnsampled = 1.0 / 64; // share of the width by which other vertices may exceed the sample
constexpr int kRangeBits = 30;          // bits of a grid coordinate if the whole source is within the grid's range

double maxAbs(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

double maxExtent(const Box& box) {
    const glm::dvec3 extent = box.extent();
    return std::max({extent.x, extent.y, extent.z});
}

/// Returns `box` extended on each side by `widths` times the width of the box.
Box grown(const Box& box, double widths) {
    const glm::dvec3 by(widths * maxExtent(box));
    return {box.min - by, box.max + by};
}

bool contains(const Box& outer, const Box& inner) {
    return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

/// Returns the median of each coordinate of `positions`. It uses at most 65,536 positions at regular intervals of the
/// list. `positions` must not be empty.
glm::dvec3 medianOf(std::span<const glm::dvec3> positions) {
    glm::dvec3 median(0);
    std::vector<double> values(std::min<std::size_t>(positions.size(), 1U << 16U));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = positions[i * positions.size() / values.size()][axis];
        std::nth_element(values.begin(), middle, values.end());
        median[axis] = *middle;
    }
    return median;
}

/// Returns the largest integer e with 2^e <= value.
int floorExponent(double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    return exponent - 1;
}

void countTriangles(read::MeshSource& source, SourceSurvey& survey, EdgeSample& sample, Progress& progress) {
    const read::MeshSummary& summary = source.summary();
    progress.stage("count", "faces", summary.faceCount);
    survey.valence = VertexTable<std::uint8_t>(summary.vertexCount);
    source.readTriangles([&](const read::TriangleBlock& block) {
        std::uint64_t index = block.firstTriangle;
        for (const read::TriangleCorners& triangle : block.triangles) {
            for (const std::uint64_t corner : triangle)
                if (std::uint8_t& valence = survey.valence.at(corner); valence < 255) ++valence;
            sample.offer(index++, triangle);
        }
        survey.triangles += block.triangles.size();
        survey.notAPolygon += block.notAPolygon;
        survey.hasPolygons = survey.hasPolygons || !block.polygons.empty();
        progress.advance(block.faceCount());
    });
}

/// Throws Error if a coordinate of `box` is too large for the computations.
void requireReach(const std::string& path, const Box& box) {
    constexpr double kMaxCoordinate = 1e100; // larger values would overflow squared distances
    const double largest = box.isEmpty() ? 0 : std::max(maxAbs(box.min), maxAbs(box.max));
    if (largest <= kMaxCoordinate) return;
    std::array<char, 32> found{};
    std::snprintf(found.data(), found.size(), "%g", largest);
    throw Error(path, "a coordinate is too large", "at most 1e100", found.data());
}

/// Returns the bounds of all vertices that triangles use. Adds the invalid normals of all vertices to `survey`.
Box boundsOf(read::MeshSource& source, SourceSurvey& survey, Progress& progress) {
    progress.stage("measure", "vertices", source.summary().vertexCount);
    Box box;
    source.readVertices([&](const read::VertexBlock& block) {
        addUsed(source, block, survey.valence, box);
        survey.badNormals += block.badNormals;
        progress.advance(block.positions.size());
    });
    requireReach(source.summary().path, box);
    return box;
}

} // namespace

void addUsed(
    read::MeshSource& source, const read::VertexBlock& block, const VertexTable<std::uint8_t>& valence, Box& box) {
    for (std::size_t i = 0; i < block.positions.size(); ++i) {
        if (valence[block.firstVertex + i] == 0) continue;
        read::requireFinite(source, block.firstVertex + i, block.positions[i]);
        box.add(block.positions[i]);
    }
}

// A triangle is in the sample if its hash is below a threshold. The final threshold is the largest power of two that
// leaves at most kMaxSampled entries, so it does not depend on the order of the triangles. To save memory, this
// constructor does not start at the max threshold, but at an estimate. In practice the estimate is never below the
// final threshold: the margin of 1/50 is 14 standard deviations for random hashes.
EdgeSample::EdgeSample(std::uint64_t triangles) {
    for (; triangles > kMaxSampled + kMaxSampled / 50; triangles /= 2)
        threshold_ /= 2;
}

void EdgeSample::offer(std::uint64_t index, const read::TriangleCorners& corners) {
    take({mix64(index), corners});
}

void EdgeSample::take(const Entry& entry) {
    if (entry.hash > threshold_) return;
    entries_.push_back(entry);
    if (entries_.size() <= kMaxSampled) return;
    threshold_ /= 2;
    std::erase_if(entries_, [&](const Entry& kept) { return kept.hash > threshold_; });
}

void EdgeSample::Lengths::add(double length) {
    if (!(length > 0)) return;
    if (counts_.empty()) counts_.resize(std::size_t{2 * kExponentBias + 1} * kBinsPerOctave);
    const int exponent = std::clamp(floorExponent(length), -kExponentBias, kExponentBias);
    const double scaled = std::ldexp(length, -exponent); // from 1 to 2; an infinite length stays infinite
    const int part = static_cast<int>(std::min((scaled - 1) * kBinsPerOctave, kBinsPerOctave - 1.0));
    ++counts_[static_cast<std::size_t>(exponent + kExponentBias) * kBinsPerOctave + static_cast<std::size_t>(part)];
    ++total_;
}

double EdgeSample::Lengths::quantile(double fraction) const {
    const double rank = static_cast<double>(total_) * fraction;
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        below += counts_[i];
        if (counts_[i] == 0 || static_cast<double>(below) <= rank) continue;
        const int bin = static_cast<int>(i);
        return std::ldexp(1 + bin % kBinsPerOctave / double{kBinsPerOctave}, bin / kBinsPerOctave - kExponentBias);
    }
    return 0;
}

std::vector<std::uint64_t> EdgeSample::vertices() const {
    std::vector<std::uint64_t> vertices;
    vertices.reserve(entries_.size() * 3);
    for (const Entry& entry : entries_)
        vertices.insert(vertices.end(), entry.corners.begin(), entry.corners.end());
    return vertices;
}

EdgeSample::Lengths EdgeSample::measure(const VertexLookup& positions) const {
    Lengths lengths;
    for (const Entry& entry : entries_) {
        const glm::dvec3& a = positions[entry.corners[0]];
        const glm::dvec3& b = positions[entry.corners[1]];
        const glm::dvec3& c = positions[entry.corners[2]];
        for (const glm::dvec3& edge : {a - b, b - c, c - a})
            lengths.add(glm::length(edge));
    }
    return lengths;
}

Box EdgeSample::mainPart(const VertexLookup& positions, const Box& box) const {
    const std::size_t share = entries_.size() / kMaxStrayShare;
    const std::size_t few = std::min(kMaxFewStrays, entries_.size() / kMaxFewStrayShare);
    if (few == 0) return box;
    const glm::dvec3 median = medianOf(positions.positions());
    std::vector<double> distances;
    distances.reserve(entries_.size());
    for (const Entry& entry : entries_) {
        double furthest = 0;
        for (const std::uint64_t corner : entry.corners)
            furthest = std::max(furthest, maxAbs(positions[corner] - median));
        distances.push_back(furthest);
    }
    for (const auto& [strays, widths] : {std::pair(share, 1.0), std::pair(few, kFewStraysDistance)}) {
        const auto last = distances.end() - 1 - static_cast<std::ptrdiff_t>(strays);
        std::nth_element(distances.begin(), last, distances.end());
        Box others;
        for (const glm::dvec3& position : positions.positions())
            if (maxAbs(position - median) <= *last) others.add(position);
        if (!(maxExtent(others) > 0) || contains(grown(others, widths), box)) continue;
        const Box around = grown(others, 1);
        Box part;
        for (const glm::dvec3& position : positions.positions())
            if (contains(around, {position, position})) part.add(position);
        part = grown(part, kUnsampled);
        return {glm::max(part.min, box.min), glm::min(part.max, box.max)};
    }
    return box;
}

hierarchy::Grid chooseGrid(const Box& box, const Box& mainPart, const EdgeSample::Lengths& lengths) {
    hierarchy::Grid grid;
    const double extent = maxExtent(mainPart);
    if (!(extent > 0)) {
        grid.origin = box.isEmpty() ? glm::dvec3(0) : box.min;
        grid.stepExponent = -20;
        return grid;
    }
    int exponent = floorExponent(extent * 0x1p-20);
    for (const double fraction : {0.5, 0.1})
        if (const double edge = lengths.quantile(fraction); edge > 0)
            exponent = std::min(exponent, floorExponent(edge / 64));
    const int coarsest = exponent;
    if (const double shortest = lengths.quantile(2e-5); shortest > 0)
        exponent = std::min(exponent, floorExponent(shortest / 2));
    // A grid step below the spacing of doubles at these coordinates would only store rounding noise.
    const double largest = std::max(glm::length(mainPart.min), glm::length(mainPart.max));
    exponent = std::max(exponent, floorExponent(largest) - 52);
    const int ofAll = floorExponent(maxExtent(box)) + 1 - kRangeBits;
    const bool isAllInRange = ofAll <= std::max(coarsest, exponent);
    const int minExponent = isAllInRange ? ofAll : std::max(coarsest, floorExponent(extent) + 1 - kRangeBits);
    grid.stepExponent = std::max(exponent, minExponent);
    const double range = grid.step() * hierarchy::kMaxGridCoordinate;
    glm::dvec3 origin = box.min;
    for (int axis = 0; axis < 3; ++axis)
        if (box.extent()[axis] > range) origin[axis] = std::max(origin[axis], mainPart.center()[axis] - range / 2);
    grid.origin = glm::floor(origin / grid.step()) * grid.step();
    return grid;
}

void setGrid(
    SourceSurvey& survey,
    const std::string& path,
    const Box& box,
    const EdgeSample& sample,
    const VertexLookup& positions,
    Strays strays) {
    requireReach(path, box);
    const EdgeSample::Lengths lengths = sample.measure(positions);
    survey.mainPart = sample.mainPart(positions, box);
    survey.medianEdge = lengths.quantile(0.5);
    survey.grid = chooseGrid(box, strays == Strays::Keep ? box : survey.mainPart, lengths);
    survey.furthest = GridSnap(survey.grid)(box.isEmpty() ? glm::dvec3(0) : box.max);
}

SourceSurvey surveySource(read::MeshSource& source, Progress& progress, Strays strays) {
    const read::MeshSummary& summary = source.summary();
    SourceSurvey survey;
    survey.vertices = summary.vertexCount;
    EdgeSample sample;
    countTriangles(source, survey, sample, progress);
    const Box box = boundsOf(source, survey, progress);
    setGrid(survey, summary.path, box, sample, VertexLookup(source, sample.vertices()), strays);
    survey.fields = measuredFields(source, survey.valence, progress);
    return survey;
}

} // namespace gnomon::chunk
