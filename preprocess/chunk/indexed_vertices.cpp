#include "preprocess/chunk/indexed_vertices.h"

#include "core/check.h"

#include <algorithm>
#include <numeric>

namespace gnomon::chunk {

IndexedVertices::IndexedVertices(std::vector<ChunkVertex> vertices, std::size_t ownCount)
    : vertices_(std::move(vertices)), ownCount_(ownCount) {
    findRuns();
    bucketRuns();
}

template <class Begin, class Extend>
void IndexedVertices::forEachRun(
    const std::vector<std::uint32_t>& foreign, const Begin& begin, const Extend& extend) const {
    const auto own = static_cast<std::uint32_t>(ownCount_);
    std::uint64_t nextIndex = 0;
    std::uint32_t nextVertex = 0;
    bool isFirst = true;
    const auto add = [&](std::uint32_t vertex) {
        const std::uint64_t index = vertices_[vertex].index;
        GNOMON_CHECK_OP(index, >=, nextIndex);
        if (isFirst || index != nextIndex || vertex != nextVertex) begin(index, vertex);
        extend();
        isFirst = false;
        nextIndex = index + 1;
        nextVertex = vertex + 1;
    };
    std::uint32_t vertex = 0;
    for (const std::uint32_t other : foreign) {
        while (vertex < own && vertices_[vertex].index < vertices_[other].index)
            add(vertex++);
        add(other);
    }
    while (vertex < own)
        add(vertex++);
}

void IndexedVertices::findRuns() {
    std::vector<std::uint32_t> foreign(vertices_.size() - ownCount_);
    std::iota(foreign.begin(), foreign.end(), static_cast<std::uint32_t>(ownCount_));
    std::sort(foreign.begin(), foreign.end(), [&](std::uint32_t a, std::uint32_t b) {
        return vertices_[a].index < vertices_[b].index;
    });
    // The runs are counted first to reserve exactly their memory, because there can be as many runs as vertices.
    std::size_t count = 0;
    forEachRun(
        foreign, [&](std::uint64_t, std::uint32_t) { ++count; }, [] {});
    runs_.reserve(count);
    forEachRun(
        foreign,
        [&](std::uint64_t index, std::uint32_t vertex) {
            runs_.push_back({index, vertex, 0});
        },
        [&] { ++runs_.back().count; });
}

void IndexedVertices::bucketRuns() {
    if (runs_.empty()) return;
    const std::uint64_t range = runs_.back().index + runs_.back().count - 1 - runs_.front().index;
    while (range >> bucketShift_ >= runs_.size())
        ++bucketShift_;
    firstRun_.reserve((range >> bucketShift_) + 2);
    for (std::uint32_t run = 0; run < runs_.size(); ++run) {
        const std::uint64_t bucket = (runs_[run].index - runs_.front().index) >> bucketShift_;
        while (firstRun_.size() <= bucket)
            firstRun_.push_back(run);
    }
    firstRun_.resize((range >> bucketShift_) + 2, static_cast<std::uint32_t>(runs_.size()));
}

std::uint32_t IndexedVertices::find(std::uint64_t sourceIndex) const {
    GNOMON_CHECK(!runs_.empty() && sourceIndex >= runs_.front().index);
    const std::size_t bucket = (sourceIndex - runs_.front().index) >> bucketShift_;
    GNOMON_CHECK_OP(bucket + 1, <, firstRun_.size());
    const auto after = std::upper_bound(
        runs_.begin() + firstRun_[bucket],
        runs_.begin() + firstRun_[bucket + 1],
        sourceIndex,
        [](std::uint64_t index, const Run& run) { return index < run.index; });
    const Run& run = *(after - 1);
    GNOMON_CHECK_OP(sourceIndex - run.index, <, run.count);
    return run.vertex + static_cast<std::uint32_t>(sourceIndex - run.index);
}

} // namespace gnomon::chunk
