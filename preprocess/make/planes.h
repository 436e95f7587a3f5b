// Fifteen aeroplanes in the air over a ground: the scene of Lloyd et al. 2006, figure 14.
#pragma once

#include "preprocess/make/parts.h"

#include <vector>

namespace gnomon::make {

/// Single-engined fighters of 11 m span in a loose formation, 4 to 14 m over rolling ground of 500 m; y up, metres.
/// The aeroplanes take 98% of the triangles, the ground the rest.
class Planes final : public MadeModel {
public:
    static constexpr std::size_t kCount = 15;
    static constexpr std::uint64_t kFewestTriangles = 20'000;

    /// `triangles` is at least kFewestTriangles and met within 1%.
    Planes(std::uint64_t triangles, std::uint64_t seed);

    /// The aeroplanes one by one, then the ground.
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
    double fineness_ = 1; // 1 is about 18,000 triangles an aeroplane
    MeshSize planeSize_;
    std::uint64_t groundColumns_ = 1;
    std::uint64_t groundRows_ = 1;
    std::uint32_t groundSeed_ = 0;
};

} // namespace gnomon::make
