// The turbine hall of a generated plant, alone on a level ground.
#pragma once

#include "core/progress.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/plant_units.h"

#include <string>

namespace gnomon::path {

/// The hall of `gnomon make plant`, rotated by quarter turns. `level` is its level of detail.
class TurbineHall final : public make::MadeModel {
public:
    TurbineHall(double level, int quarterTurns) : detail_(level), quarterTurns_(quarterTurns) {
        make::PartSink counter;
        build(counter);
        size_ = counter.size();
    }

    std::size_t blockCount() const override { return 1; }

    make::MeshSize blockSize(std::size_t /*block*/) const override { return size_; }

    void makeBlock(std::size_t /*block*/, std::uint64_t firstVertex, make::MeshSink& sink) const override {
        make::PartSink parts(sink, firstVertex);
        build(parts);
        parts.finish();
    }

    void operator()(const std::string& path) const {
        NoProgress progress;
        make::writeMadeModel(*this, path, "made for a test", 0, progress);
    }

private:
    void build(make::PartSink& parts) const {
        constexpr double kHalf = 24;
        make::addSheet(parts, {-kHalf, 0, kHalf}, {2 * kHalf, 0, 0}, {0, 0, -2 * kHalf}, make::Sides::One);
        parts.place(glm::dvec3(0), make::quarterTurned(quarterTurns_));
        make::Site site{parts, detail_, Random(1)};
        make::addTurbineHall(site);
    }

    make::Detail detail_;
    int quarterTurns_;
    make::MeshSize size_;
};

} // namespace gnomon::path
