#include "preprocess/pipeline/counted_memory.h"

#include "preprocess/chunk/binning.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr Bytes kSmallModel = mebibytes(256);

} // namespace

Bytes countedNeed(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress) {
    MemoryNeeds serial = needs;
    serial.isSerial = true;
    const bool isRefused = needs.sorting() > memory; // the error message of the caller needs the required memory
    if (serial.sorting() > (isRefused ? std::max(memory, kSmallModel) : memory))
        return isRefused ? needs.peak() : needs.sorting();
    const chunk::SourceSurvey survey = chunk::surveySource(source, progress);
    read::MeshSummary counted = source.summary();
    counted.likelyTriangles = survey.triangles; // for a file with strips, the header gives a larger number
    counted.faceCount = std::min(counted.faceCount, survey.triangles);
    const chunk::ChunkTree tree = chunk::planChunks(source, survey, needs.chunkTriangles, progress);
    const chunk::BinnedSize size = chunk::measureBins(source, survey, tree, progress);
    const bool isInRanges = tree.heavyPoints().empty() && !survey.hasPolygons && survey.notAPolygon == 0;
    const MemoryNeeds exact{counted, needs.chunkTriangles, needs.isInMemory, !isInRanges, needs.threads};
    return std::max(exact.sorting(), needs.building(size.largestChunk));
}

} // namespace gnomon::pipeline
