// Sorts a source into chunks with parallel tasks, each of which processes a range of the source's rows. For sources
// without ranges, chunk/survey and chunk/binning do the same work in one process.
#pragma once

#include "preprocess/chunk/binning.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/ranges/range_bytes.h"

#include <optional>

namespace gnomon::pipeline {

/// The source, the task runner and the limits for sorting a source by ranges of rows. All objects must outlive the
/// sorting.
struct RangeMeans {
    read::MeshSource& source;
    scratch::ScratchFile& scratch;
    TaskRunner& runner;
    const Perform& perform;
    Progress& progress;
    Bytes room;                  // memory for tasks, per process
    std::size_t threads = 1;     // threads of this process
    std::uint32_t processes = 1; // number of processes; each has about `threads` threads
    chunk::Strays strays = chunk::Strays::Leave;
};

/// Sorts a source into chunks by ranges of rows. It stores the data of each vertex in the scratch file, in one block
/// per range of vertices. These data are first the number of triangle corners at the vertex, and later its chunk.
class RangeBinning {
public:
    explicit RangeBinning(const RangeMeans& means);

    /// Returns the same measurements as chunk::surveySource, but without the corner count of each vertex (valence).
    /// Returns nullopt if the source has a defect or does not match its header. The caller must then use passes over
    /// the whole file.
    std::optional<chunk::SourceSurvey> survey();

    /// Divides the grid into chunks. The result is identical to chunk::planChunks.
    chunk::ChunkTree plan(const chunk::SourceSurvey& survey, std::uint32_t chunkTriangles);

    /// Sorts the source into the chunks of `tree`. The result is identical to chunk::binSource. The tree must not have
    /// heavy points, which are grid points with very many triangles.
    chunk::BinnedSize bin(const chunk::SourceSurvey& survey, const chunk::ChunkTree& tree, scratch::StreamStore& bins);

    /// Returns the corner counts of the vertices for chunk::binSource, which sorts sources with heavy points. Frees the
    /// scratch file blocks of these counts.
    chunk::VertexTable<std::uint8_t> takeValence();

private:
    using Take = std::function<void(std::uint32_t, std::span<const std::byte>)>;

    void run(TaskKind kind, bool isOfFaces, std::function<std::vector<std::byte>(std::uint32_t)> input, Take take);
    RowRange rangeOf(std::uint32_t task, bool isOfFaces) const;
    std::uint32_t rangeCount(bool isOfFaces) const;

    /// Collects the sampled edges of all row ranges, and the corner counts of the vertices in `pages`. Returns false if
    /// the source is irregular (FaceCount::isRegular).
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
    std::uint64_t tableBytes_ = 0; // peak bytes of the tables of one task
    std::uint64_t verticesOfRange_ = 0;
    std::uint64_t facesOfRange_ = 0;
    Blocks index_; // row index of the source, in the scratch file
    bool hasPolygons_ = false;
    std::vector<Blocks> valence_; // for each range of vertices, the blocks with the corner counts
};

} // namespace gnomon::pipeline
