// The statue: a closed, watertight bust of weathered stone, with the same shape at every number of triangles.
#pragma once

#include "preprocess/make/made_model.h"
#include "preprocess/make/statue_surface.h"

#include <memory>

namespace gnomon::make {

/// One band of the stone's grain: gradient noise of lattice spacing `spacing`, `deviation` metres (standard) high.
struct GrainOctave {
    double spacing = 0;
    double deviation = 0;
    std::uint32_t seed = 0;
};

/// A closed 2-manifold on a grid like a box's: a ring of 4 * cells columns and `rows` rows, and two square lids.
class Statue final : public MadeModel {
public:
    static constexpr std::uint64_t kFewestTriangles = 2000;

    /// `triangles` is at least kFewestTriangles and met within 2%.
    Statue(std::uint64_t triangles, std::uint64_t seed);

    /// The same with a surface made before, which depends on the seed alone.
    Statue(std::uint64_t triangles, std::uint64_t seed, std::shared_ptr<const StatueSurface> surface);

    std::size_t blockCount() const override;
    MeshSize blockSize(std::size_t block) const override;
    void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const override;

    /// The length of an edge of the equilateral triangles that would cover the ungrained surface.
    double meanEdge() const { return meanEdge_; }

    /// Coarse to fine. Every statue of a seed has the same octaves as far as they go; the finest spacing is at least
    /// 2.8 and below 5.7 mean edges.
    const std::vector<GrainOctave>& octaves() const { return octaves_; }

    /// Leaves out the `count` finest octaves, so that a test can see what they add.
    void dropFinestOctaves(std::size_t count);

private:
    /// What part of the grid a block covers: whole grid rows of one of the three parts.
    enum class Part { Base, Side, Crown };

    struct Rows {
        Part part = Part::Side;
        std::uint64_t begin = 0; // of rows of vertices and, but for the last, of cells
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
    std::uint64_t cells_ = 0; // along each edge of the square lids
    std::uint64_t rows_ = 0;  // of cells around the side
    std::uint64_t rowsPerBlock_ = 1;
    double meanEdge_ = 0;
    std::vector<GrainOctave> octaves_;
};

} // namespace gnomon::make
