#include "preprocess/pipeline/counted_memory.h"

#include "preprocess/chunk/binning.h"

#include <algorithm>

namespace gnomon::pipeline {

namespace {

constexpr Bytes kSmallModel = mebibytes(256);

} // namespace

Bytes countedLeast(read::MeshSource& source, const MemoryNeeds& needs, Bytes memory, Progress& progress) {
    MemoryNeeds serial = needs;
    serial.isSerial = true;
    if (std::max(serial.survey(), serial.binning()) > std::max(memory, kSmallModel)) return needs.least();
    const chunk::SourceSurvey survey = chunk::surveySource(source, progress);
    const chunk::ChunkTree tree = chunk::planChunks(source, survey, needs.chunkTriangles, progress);
    const chunk::BinnedSize size = chunk::measureBins(source, survey, tree, progress);
    const bool isInRanges = tree.heavyPoints().empty() && !survey.hasPolygons && survey.notAPolygon == 0;
    return std::max(
        (isInRanges ? needs : serial).least(), Bytes{needs.base().count + MemoryNeeds::node(size.largestChunk).count});
}

} // namespace gnomon::pipeline
