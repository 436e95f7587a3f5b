// A test model of fifteen aeroplanes above the ground, like the scene of Lloyd et al. 2006, figure 14.
#pragma once

#include "preprocess/make/parts.h"

#include <vector>

namespace gnomon::make {

/// A loose formation of single-engine fighter aeroplanes. Their span is 11 m, and they fly 4 to 14 m above hilly ground
/// of 500 m side length. The y axis points up, and the unit is metres. 98% of the triangles belong to the aeroplanes.
class Planes final : public MadeModel {
public:
    static constexpr std::size_t kCount = 15;
    static constexpr std::uint64_t kMinTriangles = 20'000;

    /// Creates the scene with `triangles` triangles, within 1%. `triangles` is at least kMinTriangles.
    Planes(std::uint64_t triangles, std::uint64_t seed);

    /// Returns the number of blocks: one per aeroplane and one for the ground.
    std::size_t blockCount() const override { return kCount + 1; }

    MeshSize blockSize(std::size_t block) const override;
    void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const override;

private:
    struct Place {
        glm::dvec3 origin{0};
        glm::dmat3 axes{1};
        double propellerTurns = 0;
    };

    std::vector<Place> places_;
    double fineness_ = 1; // detail factor; at 1 an aeroplane has about 18,000 triangles
    MeshSize planeSize_;
    std::uint64_t groundColumns_ = 1;
    std::uint64_t groundRows_ = 1;
    std::uint32_t groundSeed_ = 0;
};

} // namespace gnomon::make
