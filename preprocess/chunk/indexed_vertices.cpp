#include "preprocess/chunk/indexed_vertices.h"

#include "core/check.h"

#include <algorithm>

namespace gnomon::chunk {

IndexedVertices::IndexedVertices(std::vector<ChunkVertex> own, const std::vector<ChunkVertex>& foreign)
    : vertices_(std::move(own)), ownCount_(vertices_.size()) {
    vertices_.insert(vertices_.end(), foreign.begin(), foreign.end());
    findRuns();
    bucketRuns();
}

void IndexedVertices::findRuns() {
    const auto own = static_cast<std::uint32_t>(ownCount_);
    std::vector<std::uint32_t> foreign(vertices_.size() - ownCount_);
    for (std::uint32_t i = 0; i < foreign.size(); ++i)
        foreign[i] = own + i;
    const auto indexOf = [&](std::uint32_t vertex) { return vertices_[vertex].index; };
    std::sort(
        foreign.begin(), foreign.end(), [&](std::uint32_t a, std::uint32_t b) { return indexOf(a) < indexOf(b); });
    std::uint64_t least = 0; // what the next index may be
    const auto add = [&](std::uint32_t vertex) {
        const std::uint32_t index = indexOf(vertex);
        GNOMON_CHECK_OP(index, >=, least);
        const bool follows = !runs_.empty() && index == least && vertex == runs_.back().vertex + runs_.back().count;
        if (!follows) runs_.push_back({index, vertex, 0});
        ++runs_.back().count;
        least = std::uint64_t{index} + 1;
    };
    std::uint32_t vertex = 0;
    for (const std::uint32_t other : foreign) {
        while (vertex < own && indexOf(vertex) < indexOf(other))
            add(vertex++);
        add(other);
    }
    while (vertex < own)
        add(vertex++);
}

void IndexedVertices::bucketRuns() {
    if (runs_.empty()) return;
    const std::uint32_t range = runs_.back().index + runs_.back().count - 1 - runs_.front().index;
    while (range >> bucketShift_ >= runs_.size())
        ++bucketShift_;
    firstRun_.reserve((range >> bucketShift_) + 2);
    for (std::uint32_t run = 0; run < runs_.size(); ++run) {
        const std::uint32_t bucket = (runs_[run].index - runs_.front().index) >> bucketShift_;
        while (firstRun_.size() <= bucket)
            firstRun_.push_back(run);
    }
    firstRun_.resize((range >> bucketShift_) + 2, static_cast<std::uint32_t>(runs_.size()));
}

std::uint32_t IndexedVertices::find(std::uint32_t sourceIndex) const {
    GNOMON_CHECK(!runs_.empty() && sourceIndex >= runs_.front().index);
    const std::size_t bucket = (sourceIndex - runs_.front().index) >> bucketShift_;
    GNOMON_CHECK_OP(bucket + 1, <, firstRun_.size());
    const auto after = std::upper_bound(
        runs_.begin() + firstRun_[bucket],
        runs_.begin() + firstRun_[bucket + 1],
        sourceIndex,
        [](std::uint32_t index, const Run& run) { return index < run.index; });
    const Run& run = *(after - 1);
    GNOMON_CHECK_OP(sourceIndex - run.index, <, run.count);
    return run.vertex + (sourceIndex - run.index);
}

} // namespace gnomon::chunk
