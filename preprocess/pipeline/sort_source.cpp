#include "preprocess/pipeline/sort_source.h"

#include "core/limit_error.h"
#include "preprocess/chunk/binning.h"
#include "preprocess/pipeline/ranges/range_binning.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr std::uint64_t kBytesPerPolygonCorner = 96;

chunk::Strays straysOf(const BuildOptions& options) {
    return options.keepsStrays ? chunk::Strays::Keep : chunk::Strays::Leave;
}

/// Returns the memory needs if this process sorts the source in passes over the whole file.
MemoryNeeds serialNeeds(const SortingMeans& means) {
    MemoryNeeds needs{means.source.summary(), means.options.chunkTriangles, means.options.isInMemory};
    needs.isSerial = true;
    return needs;
}

/// Returns the object that sorts the source by ranges of rows, or nullopt if passes over the whole file are necessary.
std::optional<RangeBinning> rangesOf(const SortingMeans& means) {
    const read::MeshSummary& source = means.source.summary();
    if (!source.hasRanges) return std::nullopt;
    const MemoryNeeds needs{source, means.options.chunkTriangles, means.options.isInMemory};
    return RangeBinning(
        {means.source,
         means.scratch,
         means.runner,
         means.perform,
         means.progress,
         remainingMemory(means.options, needs.ranges()),
         means.threads,
         means.processes,
         straysOf(means.options)});
}

} // namespace

void requireMemory(const read::MeshSummary& source, const BuildOptions& options, Bytes needed) {
    if (needed > options.memory)
        throw LimitError(
            Limit::Memory,
            {source.path,
             "too little memory for this model",
             std::to_string((needed.count >> 20U) + 1) + "M or more",
             readableBytes(options.memory)});
}

Bytes remainingMemory(const BuildOptions& options, Bytes taken) {
    return {options.memory.count > taken.count ? options.memory.count - taken.count : 0};
}

BinnedRecord sortSource(const SortingMeans& means, std::optional<scratch::StreamStore>& bins) {
    read::MeshSource& source = means.source;
    const std::uint32_t chunkTriangles = means.options.chunkTriangles;
    std::optional<RangeBinning> ranges = rangesOf(means);
    std::optional<chunk::SourceSurvey> survey;
    if (ranges) survey = ranges->survey();
    if (!survey) {
        if (ranges) requireMemory(source.summary(), means.options, serialNeeds(means).sorting());
        ranges.reset();
        survey = chunk::surveySource(source, means.progress, straysOf(means.options));
    }
    means.endPhase("count", source.summary().fileBytes);
    const chunk::ChunkTree tree = ranges ? ranges->plan(*survey, chunkTriangles)
                                         : chunk::planChunks(source, *survey, chunkTriangles, means.progress);
    means.endPhase("octree", 0);
    if (ranges && !tree.heavyPoints().empty()) { // which triangles repeat at such points depends on the source order
        requireMemory(source.summary(), means.options, serialNeeds(means).sorting());
        survey->valence = ranges->takeValence();
        ranges.reset();
    }
    BinnedRecord record;
    record.grid = survey->grid;
    record.furthest = survey->furthest;
    record.mainPart = survey->mainPart;
    record.medianEdge = survey->medianEdge;
    record.format = chunk::formatOf(source.summary());
    record.fields = survey->fields;
    record.triangles = survey->triangles;
    record.vertices = survey->vertices;
    record.notAPolygon = survey->notAPolygon;
    record.badNormals = survey->badNormals;
    record.chunkCount = tree.chunkCount();
    const Bytes room = remainingMemory(means.options, serialNeeds(means).binning());
    bins.emplace(
        means.scratch,
        chunk::binStreams(tree.chunkCount()),
        blockBytes({room.count / 2}, std::uint64_t{3} * tree.chunkCount()));
    const chunk::BinnedSize size =
        ranges
            ? ranges->bin(*survey, tree, *bins)
            : chunk::binSource(source, *survey, tree, *bins, room.count / 2 / kBytesPerPolygonCorner, means.progress);
    record.largestChunk = size.largestChunk;
    record.dropped = {size.dropped.degenerate, size.dropped.doubled, size.dropped.collapsedByGrid, 0};
    record.strayed = size.strayed;
    source.requireUnchanged(); // the source is not read after this line
    record.directory = bins->directory();
    return record;
}

} // namespace gnomon::pipeline
