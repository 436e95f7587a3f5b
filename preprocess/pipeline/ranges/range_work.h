// Runs the tasks that sort a source by ranges of rows. Each process can run them.
#pragma once

#include "core/progress.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/pipeline/ranges/range_bytes.h"

#include <atomic>
#include <mutex>

namespace gnomon::pipeline {

/// The number of vertices per page of a table of corner counts. A range of vertices consists of whole pages. Only the
/// last range can end inside a page.
constexpr std::uint64_t kPageVertices = std::uint64_t{1} << 16U;

/// Runs tasks on ranges of source rows. Many threads can call the functions at once. All constructor arguments must
/// outlive the object.
class RangeWork {
public:
    RangeWork(read::MeshSource& source, scratch::ScratchFile& scratch, Progress& progress)
        : source_(source), scratch_(scratch), progress_(progress) {}

    FaceCount countFaces(const CountInput& input) const;
    VertexMeasure measureVertices(const MeasureInput& input) const;
    Blocks countCells(const CellsInput& input) const;
    BinnedRange binVertices(const BinVerticesInput& input) const;
    BinnedRange binFaces(const BinFacesInput& input) const;

    /// Returns the peak size in bytes of the per-vertex tables, summed over all tasks that ran at the same time.
    std::uint64_t maxTableBytes() const { return maxTableBytes_; }

private:
    class Held;

    /// Loads the row index of the source from the blocks `index` of the scratch file. The source can then read ranges
    /// of rows.
    void useIndex(const Blocks& index) const;

    Blocks posted(std::span<const std::byte> bytes) const;

    read::MeshSource& source_;
    scratch::ScratchFile& scratch_;
    Progress& progress_;
    mutable std::once_flag isIndexed_;
    mutable std::atomic<std::uint64_t> tableBytes_{0};
    mutable std::atomic<std::uint64_t> maxTableBytes_{0};
};

} // namespace gnomon::pipeline
