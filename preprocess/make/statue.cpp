#include "preprocess/make/statue.h"

#include "core/check.h"
#include "preprocess/make/noise.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

namespace {

/// The number of vertices that are computed together. The data of such a batch fit into the fastest caches.
constexpr std::size_t kBatch = 1024;

/// The min number of grid vertices in a block of the statue.
constexpr std::uint64_t kBlockVertices = 1U << 15U;

/// The coarsest lattice spacing of the stone's grain in metres, and the slope of all octaves (deviation / spacing).
/// With a smaller slope, the height of the finest octave would be below 0.3 edge lengths. A larger slope would hide the
/// carving.
constexpr double kCoarsestSpacing = 0.08;
constexpr double kGrainSlope = 0.042;

/// The min lattice spacing of the stone's grain, in edge lengths of the triangles. The triangles could not represent a
/// smaller spacing.
constexpr double kFinestSpacingEdges = 2.83;

std::vector<GrainOctave> grain(double meanEdge, std::uint64_t seed) {
    std::vector<GrainOctave> octaves;
    for (double spacing = kCoarsestSpacing; spacing >= kFinestSpacingEdges * meanEdge; spacing *= 0.5)
        octaves.push_back(
            {spacing, spacing * kGrainSlope, static_cast<std::uint32_t>(mix64(seed * 977 + octaves.size()))});
    return octaves;
}

/// Returns a random shift in (-0.5, 0.5) * `reach`, computed from bits of a hash. The statue's vertices are shifted
/// because real scanners do not sample on a regular grid.
double jitter(std::uint64_t bits, double reach) {
    return (static_cast<double>(bits & 0xFFFFFFU) * 0x1p-24 - 0.5) * reach;
}

constexpr double kJitterCells = 0.34;

} // namespace

Statue::Statue(std::uint64_t triangles, std::uint64_t seed)
    : Statue(triangles, seed, std::make_shared<const StatueSurface>(seed)) {}

Statue::Statue(std::uint64_t triangles, std::uint64_t seed, std::shared_ptr<const StatueSurface> surface)
    : seed_(seed), surface_(std::move(surface)) {
    GNOMON_CHECK_OP(triangles, >=, kMinTriangles);
    const double sideLength =
        surface_->meridian() * (static_cast<double>(surface_->crownBegin()) - static_cast<double>(surface_->baseEnd()));
    const double girth = surface_->area() / surface_->meridian();
    const double ratio = 4 * sideLength / girth; // rows per column width, so that the cells are square on average
    const auto count = static_cast<double>(triangles);
    cells_ = std::max<std::uint64_t>(2, static_cast<std::uint64_t>(std::llround(std::sqrt(count / (8 * ratio + 4)))));
    const double rows = (count / 4 - static_cast<double>(cells_ * cells_)) / (2 * static_cast<double>(cells_));
    rows_ = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(rows)));
    rowsPerBlock_ = std::max<std::uint64_t>(1, kBlockVertices / (4 * cells_));
    meanEdge_ = std::sqrt(4 / std::sqrt(3.0) * surface_->area() / count);
    octaves_ = grain(meanEdge_, seed);
}

void Statue::dropFinestOctaves(std::size_t count) {
    octaves_.resize(octaves_.size() - std::min(count, octaves_.size()));
}

// Returns which rows of the statue's grid a block contains. The blocks are in this order: the lid of the base, the side
// from its lowest to its highest row of vertices, and the lid of the crown. A lid contains only the vertices inside its
// border, because the side contains the border.

Statue::Rows Statue::rowsOf(std::size_t block) const {
    const auto blocksOf = [&](std::uint64_t rows) { return (rows + rowsPerBlock_ - 1) / rowsPerBlock_; };
    const auto range = [&](Part part, std::uint64_t index, std::uint64_t rows) {
        return Rows{part, index * rowsPerBlock_, std::min(rows, (index + 1) * rowsPerBlock_)};
    };
    std::uint64_t index = block;
    if (index < blocksOf(cells_)) return range(Part::Base, index, cells_);
    index -= blocksOf(cells_);
    if (index < blocksOf(rows_ + 1)) return range(Part::Side, index, rows_ + 1);
    return range(Part::Crown, index - blocksOf(rows_ + 1), cells_);
}

std::size_t Statue::blockCount() const {
    const auto blocksOf = [&](std::uint64_t rows) { return (rows + rowsPerBlock_ - 1) / rowsPerBlock_; };
    return static_cast<std::size_t>(2 * blocksOf(cells_) + blocksOf(rows_ + 1));
}

MeshSize Statue::blockSize(std::size_t block) const {
    const Rows rows = rowsOf(block);
    const std::uint64_t count = rows.end - rows.begin;
    if (rows.part == Part::Side) {
        const std::uint64_t cellRows = std::min(rows.end, rows_) - rows.begin;
        return {count * 4 * cells_, cellRows * 8 * cells_};
    }
    // The vertices of row 0 are on the border of the lid, so they belong to the side.
    const std::uint64_t inner = count - (rows.begin == 0 ? 1 : 0);
    return {inner * (cells_ - 1), count * 2 * cells_};
}

std::uint64_t Statue::sideVertex(std::uint64_t row, std::uint64_t column) const {
    return (cells_ - 1) * (cells_ - 1) + row * 4 * cells_ + column % (4 * cells_);
}

std::uint64_t Statue::lidVertex(Part lid, std::uint64_t i, std::uint64_t k) const {
    const std::uint64_t row = lid == Part::Base ? 0 : rows_;
    if (i == cells_) return sideVertex(row, cells_ - k);
    if (k == 0) return sideVertex(row, 2 * cells_ - i);
    if (i == 0) return sideVertex(row, 2 * cells_ + k);
    if (k == cells_) return sideVertex(row, 3 * cells_ + i);
    const std::uint64_t first = lid == Part::Base ? 0 : sideVertex(rows_ + 1, 0);
    return first + (k - 1) * (cells_ - 1) + (i - 1);
}

Statue::GridPlace Statue::sidePlace(std::uint64_t row, std::uint64_t column) const {
    auto y = static_cast<double>(row);
    auto x = static_cast<double>(column);
    if (row > 0 && row < rows_) {
        const std::uint64_t bits = mix64(seed_ ^ mix64(sideVertex(row, column)));
        y += jitter(bits, kJitterCells);
        x += jitter(bits >> 32U, kJitterCells);
    }
    if (x < 0) x += static_cast<double>(4 * cells_);
    const auto base = static_cast<double>(surface_->baseEnd());
    const auto crown = static_cast<double>(surface_->crownBegin());
    return {
        static_cast<float>(base + (crown - base) * y / static_cast<double>(rows_)),
        static_cast<float>(x / static_cast<double>(cells_))};
}

Statue::GridPlace Statue::lidPlace(Part lid, std::uint64_t i, std::uint64_t k) const {
    const std::uint64_t bits = mix64(seed_ ^ mix64(lidVertex(lid, i, k)));
    const double x = (static_cast<double>(i) + jitter(bits, kJitterCells)) * 2 / static_cast<double>(cells_) - 1;
    const double z = (static_cast<double>(k) + jitter(bits >> 32U, kJitterCells)) * 2 / static_cast<double>(cells_) - 1;
    // `m` selects the square ring around the centre that contains the point (x, z).
    const double m = std::max(std::abs(x), std::abs(z));
    double around = 0;
    if (m > 0) {
        if (x == m)
            around = (m - z) / (2 * m);
        else if (z == -m)
            around = 1 + (m - x) / (2 * m);
        else if (x == -m)
            around = 2 + (z + m) / (2 * m);
        else
            around = 3 + (x + m) / (2 * m);
    }
    const auto base = static_cast<double>(surface_->baseEnd());
    const auto crown = static_cast<double>(surface_->crownBegin());
    const double along = lid == Part::Base ? m * base : 1 - m * (1 - crown);
    return {static_cast<float>(along), static_cast<float>(around)};
}

void Statue::carve(std::span<const GridPlace> places, std::span<glm::vec3> positions) const {
    std::array<float, kBatch> x;      // NOLINT(cppcoreguidelines-pro-type-member-init): set below
    std::array<float, kBatch> y;      // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<float, kBatch> z;      // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<float, kBatch> height; // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::array<glm::vec3, kBatch> outward{};
    const std::size_t count = places.size();
    for (std::size_t i = 0; i < count; ++i) {
        const SurfacePoint point = surface_->at(places[i].along, places[i].around);
        positions[i] = point.position;
        outward[i] = point.outward;
        x[i] = point.position.x + 1; // shifts positions, because the noise needs positive coordinates
        y[i] = point.position.y + 1;
        z[i] = point.position.z + 1;
        height[i] = 0;
    }
    for (const GrainOctave& octave : octaves_) {
        const auto frequency = static_cast<float>(1 / octave.spacing);
        const auto scale = static_cast<float>(octave.deviation / kNoiseDeviation);
        for (std::size_t i = 0; i < count; ++i)
            height[i] += scale * gradientNoise(x[i] * frequency, y[i] * frequency, z[i] * frequency, octave.seed);
    }
    for (std::size_t i = 0; i < count; ++i)
        positions[i] += height[i] * outward[i];
}

void Statue::makeVertices(const Rows& rows, MeshSink& sink) const {
    std::array<GridPlace, kBatch> places;
    std::array<glm::vec3, kBatch> positions{};
    std::size_t count = 0;
    const auto flush = [&] {
        carve(std::span(places).first(count), positions);
        sink.addVertices(std::span(positions).first(count));
        count = 0;
    };
    const bool side = rows.part == Part::Side;
    const std::uint64_t firstColumn = side ? 0 : 1; // the border of a lid belongs to the side
    const std::uint64_t lastColumn = side ? 4 * cells_ : cells_;
    for (std::uint64_t row = std::max(rows.begin, firstColumn); row < rows.end; ++row)
        for (std::uint64_t column = firstColumn; column < lastColumn; ++column) {
            places[count++] = side ? sidePlace(row, column) : lidPlace(rows.part, column, row);
            if (count == kBatch) flush();
        }
    flush();
}

void Statue::makeTriangles(const Rows& rows, MeshSink& sink) const {
    std::vector<MadeTriangle> triangles;
    triangles.reserve(2 * kBatch);
    const auto addQuad = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
        if (triangles.size() < 2 * kBatch) return;
        sink.addTriangles(triangles);
        triangles.clear();
    };
    if (rows.part == Part::Side) {
        for (std::uint64_t row = rows.begin; row < std::min(rows.end, rows_); ++row)
            for (std::uint64_t column = 0; column < 4 * cells_; ++column)
                addQuad(
                    sideVertex(row, column),
                    sideVertex(row, column + 1),
                    sideVertex(row + 1, column + 1),
                    sideVertex(row + 1, column));
    } else {
        for (std::uint64_t k = rows.begin; k < rows.end; ++k)
            for (std::uint64_t i = 0; i < cells_; ++i) {
                const std::array<std::uint64_t, 4> q{
                    lidVertex(rows.part, i, k),
                    lidVertex(rows.part, i, k + 1),
                    lidVertex(rows.part, i + 1, k + 1),
                    lidVertex(rows.part, i + 1, k)};
                if (rows.part == Part::Crown)
                    addQuad(q[0], q[1], q[2], q[3]);
                else
                    addQuad(q[3], q[2], q[1], q[0]);
            }
    }
    sink.addTriangles(triangles);
}

void Statue::makeBlock(std::size_t block, std::uint64_t /*firstVertex*/, MeshSink& sink) const {
    const Rows rows = rowsOf(block);
    makeVertices(rows, sink);
    makeTriangles(rows, sink);
}

} // namespace gnomon::make
