// The statue: a closed, watertight bust of weathered stone. Its shape does not depend on the number of triangles.
#pragma once

#include "preprocess/make/made_model.h"
#include "preprocess/make/statue_surface.h"

#include <memory>

namespace gnomon::make {

/// One octave of the stone's grain: gradient noise with lattice spacing `spacing` and standard deviation `deviation`,
/// both in metres.
struct GrainOctave {
    double spacing = 0;
    double deviation = 0;
    std::uint32_t seed = 0;
};

/// A closed 2-manifold with the grid of a box: a ring of 4 * cells columns and `rows` rows, and two square lids.
class Statue final : public MadeModel {
public:
    static constexpr std::uint64_t kMinTriangles = 2000;

    /// Creates the statue with `triangles` triangles, within 2%. `triangles` is at least kMinTriangles.
    Statue(std::uint64_t triangles, std::uint64_t seed);

    /// Creates the statue with an existing surface. The surface depends only on the seed.
    Statue(std::uint64_t triangles, std::uint64_t seed, std::shared_ptr<const StatueSurface> surface);

    std::size_t blockCount() const override;
    MeshSize blockSize(std::size_t block) const override;
    void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const override;

    /// Returns the edge length of the equilateral triangles that would cover the surface without grain.
    double meanEdge() const { return meanEdge_; }

    /// Returns the octaves from coarse to fine. All statues of a seed share their octaves. A larger statue only has
    /// more of them. The finest spacing is at least 2.8 and below 5.7 mean edges.
    const std::vector<GrainOctave>& octaves() const { return octaves_; }

    /// Removes the `count` finest octaves, so that a test can measure their effect.
    void dropFinestOctaves(std::size_t count);

private:
    /// The part of the grid that a block covers: whole rows of one of the three parts.
    enum class Part { Base, Side, Crown };

    struct Rows {
        Part part = Part::Side;
        std::uint64_t begin = 0; // rows of vertices and, except the last row, of cells
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
    std::uint64_t cells_ = 0; // cells along each edge of the square lids
    std::uint64_t rows_ = 0;  // rows of cells around the side
    std::uint64_t rowsPerBlock_ = 1;
    double meanEdge_ = 0;
    std::vector<GrainOctave> octaves_;
};

} // namespace gnomon::make
