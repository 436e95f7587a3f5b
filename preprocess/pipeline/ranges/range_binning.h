// Sorting a source into chunks by ranges of its rows, in tasks: what chunk/survey and chunk/binning do in one process
// where a source has no ranges.
#pragma once

#include "preprocess/chunk/binning.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/ranges/range_bytes.h"

#include <optional>

namespace gnomon::pipeline {

/// What it may use. All must outlive it.
struct RangeMeans {
    read::MeshSource& source;
    scratch::ScratchFile& scratch;
    TaskRunner& runner;
    const Perform& perform;
    Progress& progress;
    Bytes room;                  // of memory for tasks, in each process
    std::size_t threads = 1;     // of this process
    std::uint32_t processes = 1; // all with about as many
    chunk::Strays strays = chunk::Strays::Leave;
};

/// What is known of each vertex lies in the scratch file, by ranges of vertices: first how many corners are there, then
/// the number of its chunk.
class RangeBinning {
public:
    explicit RangeBinning(const RangeMeans& means);

    /// As chunk::surveySource, but for the valence. Nothing where the source has a defect or is not what its size told:
    /// then only whole passes will do.
    std::optional<chunk::SourceSurvey> survey();

    /// As chunk::planChunks.
    chunk::ChunkTree plan(const chunk::SourceSurvey& survey, std::uint32_t chunkTriangles);

    /// As chunk::binSource, for a tree without heavy points.
    chunk::BinnedSize bin(const chunk::SourceSurvey& survey, const chunk::ChunkTree& tree, scratch::StreamStore& bins);

    /// What chunk::binSource needs instead, where there are heavy points; nothing is left in the scratch file.
    chunk::VertexTable<std::uint8_t> takeValence();

private:
    using Take = std::function<void(std::uint32_t, std::span<const std::byte>)>;

    void run(TaskKind kind, bool isOfFaces, std::function<std::vector<std::byte>(std::uint32_t)> input, Take take);
    RowRange rangeOf(std::uint32_t task, bool isOfFaces) const;
    std::uint32_t rangeCount(bool isOfFaces) const;

    /// The edges of all parts, and what was told of pages of vertices, by range. False where it is irregular.
    bool countFaces(chunk::SourceSurvey& survey, chunk::EdgeSample& sample, std::vector<Mail>& pages);
    Box measure(
        const std::vector<Mail>& pages,
        const std::vector<std::uint64_t>& sampled,
        chunk::SourceSurvey& survey,
        std::vector<glm::dvec3>& positions);

    Blocks posted(std::span<const std::byte> bytes);
    void release(Blocks& blocks);

    RangeMeans means_;
    std::size_t atOnce_ = 1;
    std::uint64_t tableBytes_ = 0; // of a task
    std::uint64_t verticesOfRange_ = 0;
    std::uint64_t facesOfRange_ = 0;
    Blocks index_; // of the source's rows
    bool hasPolygons_ = false;
    std::vector<Blocks> valence_; // by range of vertices
};

} // namespace gnomon::pipeline
