// A test model of a statue. It is a closed, watertight bust of weathered stone. Its shape does not depend on the number
// of triangles.
#pragma once

#include "preprocess/make/made_model.h"
#include "preprocess/make/statue_surface.h"

#include <memory>

namespace gnomon::make {

/// One octave of the grain of the statue's stone. It is gradient noise with the lattice spacing `spacing` and the
/// standard deviation `deviation`, both in metres.
struct GrainOctave {
    double spacing = 0;
    double deviation = 0;
    std::uint32_t seed = 0;
};

/// A statue as a closed 2-manifold. Its vertices form the grid of a box: a side of 4 * cells_ columns and rows_ rows,
/// and two square lids.
class Statue final : public MadeModel {
public:
    static constexpr std::uint64_t kMinTriangles = 2000;

    /// Creates the statue with `triangles` triangles, within 2%. `triangles` must be at least kMinTriangles.
    Statue(std::uint64_t triangles, std::uint64_t seed);

    /// Creates the statue from an existing surface. The surface must belong to the same seed.
    Statue(std::uint64_t triangles, std::uint64_t seed, std::shared_ptr<const StatueSurface> surface);

    std::size_t blockCount() const override;
    MeshSize blockSize(std::size_t block) const override;
    void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const override;

    /// Returns the mean edge length in metres. Equilateral triangles of this size, as many as the statue has triangles,
    /// would cover the surface without grain.
    double meanEdge() const { return meanEdge_; }

    /// Returns the octaves of the stone's grain from coarse to fine. All statues of a seed have the same octaves, but a
    /// statue with more triangles has additional fine octaves. The finest spacing is at least 2.8 and below 5.7 mean
    /// edges.
    const std::vector<GrainOctave>& octaves() const { return octaves_; }

    /// Removes the `count` finest octaves of the stone's grain, so that a test can measure their effect.
    void dropFinestOctaves(std::size_t count);

private:
    /// The part of the statue's grid to which the rows of a block belong: one of two lids, or the side.
    enum class Part { Base, Side, Crown };

    struct Rows {
        Part part = Part::Side;
        std::uint64_t begin = 0; // first row of vertices; except for the last row also of cells
        std::uint64_t end = 0;
    };

    struct GridPlace {
        float along = 0;
        float around = 0;
    };

    Rows rowsOf(std::size_t block) const;
    std::uint64_t sideVertex(std::uint64_t row, std::uint64_t column) const;
    std::uint64_t lidVertex(Part lid, std::uint64_t i, std::uint64_t k) const;
    GridPlace sidePlace(std::uint64_t row, std::uint64_t column) const;
    GridPlace lidPlace(Part lid, std::uint64_t i, std::uint64_t k) const;
    void makeVertices(const Rows& rows, MeshSink& sink) const;
    void makeTriangles(const Rows& rows, MeshSink& sink) const;
    void carve(std::span<const GridPlace> places, std::span<glm::vec3> positions) const;

    std::uint64_t seed_;
    std::shared_ptr<const StatueSurface> surface_;
    std::uint64_t cells_ = 0; // number of cells along each edge of the square lids
    std::uint64_t rows_ = 0;  // number of rows of cells on the side
    std::uint64_t rowsPerBlock_ = 1;
    double meanEdge_ = 0;
    std::vector<GrainOctave> octaves_;
};

} // namespace gnomon::make
