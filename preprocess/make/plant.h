// A test model of a power plant in a wide, fenced yard. It has many small, open, unwelded and duplicate parts.
#pragma once

#include "preprocess/make/plant_kit.h"

#include <vector>

namespace gnomon::make {

/// A power plant of 320 m side length in a yard of 400 m. The y axis points up, the ground is at y = 0, and the unit is
/// metres. With more triangles the plant first gets more parts (bars, bolts, tubes, fins, gravel), and then rounder
/// parts. With fewer than about 300,000 triangles some lots of the yard are empty.
class Plant final : public MadeModel {
public:
    static constexpr std::uint64_t kMinTriangles = 20'000;

    /// Creates the plant with `triangles` triangles, within 0.1%. `triangles` is at least kMinTriangles.
    Plant(std::uint64_t triangles, std::uint64_t seed);

    std::size_t blockCount() const override { return jobs_.size(); }

    MeshSize blockSize(std::size_t block) const override { return jobs_[block].size; }

    void makeBlock(std::size_t block, std::uint64_t firstVertex, MeshSink& sink) const override;

private:
    using MakeParts = void (*)(Site& site, std::uint64_t piece);

    /// The content of one block of the model: one building or machine (unit), one piece of a unit, or a bed of gravel.
    struct Job {
        MakeParts make = nullptr; // null for gravel
        std::uint64_t piece = 0;  // index of the piece of the unit; for gravel: number of stones
        glm::dvec3 origin{0};
        int quarterTurns = 0;
        std::uint64_t seed = 0;
        MeshSize size;
    };

    void layOut(std::uint64_t seed, std::size_t lotsBuilt);
    void addLot(char kind, const glm::dvec3& center, std::uint64_t seed);
    std::uint64_t countParts(double level);
    void addGravel(std::uint64_t triangles, std::uint64_t seed);
    void makeJob(const Job& job, PartSink& parts, const Detail& detail) const;

    std::vector<Job> jobs_;
    double level_ = 1;
    double stoneRadius_ = 0.05;
};

} // namespace gnomon::make
