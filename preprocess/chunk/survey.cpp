#include "preprocess/chunk/survey.h"

#include "core/error.h"
#include "core/random.h"
#include "preprocess/chunk/field_numbers.h"
#include "preprocess/chunk/vertex_lookup.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace gnomon::chunk {

namespace {

constexpr std::size_t kMostSampled = std::size_t{1} << 19U;
constexpr int kExponentBias = 1200;

double maxAbs(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// The largest exponent e with 2^e <= value.
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

/// Throws Error for coordinates that cannot be computed with.
void requireReach(const std::string& path, const Box& box) {
    constexpr double kMostCoordinate = 1e100; // beyond, squares of distances leave the range of doubles
    const double largest = box.isEmpty() ? 0 : std::max(maxAbs(box.min), maxAbs(box.max));
    if (largest <= kMostCoordinate) return;
    std::array<char, 32> found{};
    std::snprintf(found.data(), found.size(), "%g", largest);
    throw Error(path, "a coordinate is too large", "at most 1e100", found.data());
}

Box boundsOf(read::MeshSource& source, const VertexTable<std::uint8_t>& valence, Progress& progress) {
    progress.stage("measure", "vertices", source.summary().vertexCount);
    Box box;
    source.readVertices([&](const read::VertexBlock& block) {
        addUsed(source, block, valence, box);
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

// The threshold of the whole sample is the largest power of two that leaves few enough, in whatever order. Hashes as by
// chance leave a fiftieth more than are expected to be left as good as never: it is 14 standard deviations.
EdgeSample::EdgeSample(std::uint64_t triangles) {
    for (; triangles > kMostSampled + kMostSampled / 50; triangles /= 2)
        threshold_ /= 2;
}

void EdgeSample::offer(std::uint64_t index, const read::TriangleCorners& corners) {
    take({mix64(index), corners});
}

void EdgeSample::take(const Entry& entry) {
    if (entry.hash > threshold_) return;
    entries_.push_back(entry);
    if (entries_.size() <= kMostSampled) return;
    threshold_ /= 2;
    std::erase_if(entries_, [&](const Entry& kept) { return kept.hash > threshold_; });
}

void EdgeSample::Lengths::add(double length) {
    if (!(length > 0)) return;
    if (counts_.empty()) counts_.resize(2 * kExponentBias + 1);
    ++counts_[static_cast<std::size_t>(std::clamp(floorExponent(length) + kExponentBias, 0, 2 * kExponentBias))];
    ++total_;
}

double EdgeSample::Lengths::quantile(double fraction) const {
    const double rank = static_cast<double>(total_) * fraction;
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        below += counts_[i];
        if (counts_[i] > 0 && static_cast<double>(below) > rank)
            return std::ldexp(1.0, static_cast<int>(i) - kExponentBias);
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

EdgeSample::Lengths EdgeSample::measure(read::MeshSource& source) const {
    return measure(VertexLookup(source, vertices()));
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

hierarchy::Grid chooseGrid(const Box& box, const EdgeSample::Lengths& lengths) {
    const glm::dvec3 size = box.extent();
    const double extent = std::max({size.x, size.y, size.z});
    hierarchy::Grid grid;
    if (!(extent > 0)) {
        grid.origin = box.isEmpty() ? glm::dvec3(0) : box.min;
        grid.stepExponent = -20;
        return grid;
    }
    int exponent = floorExponent(extent * 0x1p-20);
    if (const double median = lengths.quantile(0.5); median > 0)
        exponent = std::min(exponent, floorExponent(median / 64));
    if (const double shortest = lengths.quantile(2e-5); shortest > 0)
        exponent = std::min(exponent, floorExponent(shortest / 2));
    exponent = std::max(exponent, floorExponent(extent) - 29);
    // A step below the spacing of doubles at these coordinates would only store noise.
    const double largest = std::max(glm::length(box.min), glm::length(box.max));
    exponent = std::max(exponent, floorExponent(largest) - 52);
    grid.stepExponent = exponent;
    grid.origin = glm::floor(box.min / grid.step()) * grid.step();
    return grid;
}

void setGrid(SourceSurvey& survey, const std::string& path, const Box& box, const EdgeSample::Lengths& lengths) {
    requireReach(path, box);
    survey.grid = chooseGrid(box, lengths);
    survey.furthest = GridSnap(survey.grid)(box.isEmpty() ? glm::dvec3(0) : box.max);
}

SourceSurvey surveySource(read::MeshSource& source, Progress& progress) {
    const read::MeshSummary& summary = source.summary();
    SourceSurvey survey;
    survey.vertices = summary.vertexCount;
    EdgeSample sample;
    countTriangles(source, survey, sample, progress);
    const Box box = boundsOf(source, survey.valence, progress);
    setGrid(survey, summary.path, box, sample.measure(source));
    survey.fields = measuredFields(source, survey.valence, progress);
    return survey;
}

} // namespace gnomon::chunk
