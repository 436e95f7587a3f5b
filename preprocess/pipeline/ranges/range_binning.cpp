#include "preprocess/pipeline/ranges/range_binning.h"

#include "preprocess/chunk/field_numbers.h"
#include "preprocess/pipeline/ranges/range_work.h"

#include <algorithm>
#include <numeric>

namespace gnomon::pipeline {

namespace {

/// The number of row ranges per thread. Several ranges per thread let all threads end at about the same time.
constexpr std::uint64_t kRangesPerThread = 4;

constexpr std::uint64_t kMinRows = std::uint64_t{1} << 16U;
constexpr std::uint64_t kMaxRows = std::uint64_t{1} << 22U;
// Memory in bytes per polygon corner, for its vertex number twice (during sorting) and its position.
constexpr std::uint64_t kBytesPerCorner = 64;

/// Returns the number of source rows per task, at most `maxRows`. It is a multiple of the page size.
std::uint64_t rowsOfRange(std::uint64_t rows, std::uint64_t threads, std::uint64_t maxRows) {
    const std::uint64_t wanted = std::clamp(rows / (threads * kRangesPerThread) + 1, kMinRows, kMaxRows);
    return std::max(std::min(wanted, maxRows) / kPageVertices, std::uint64_t{1}) * kPageVertices;
}

template <class T>
void append(std::vector<T>& values, std::span<const std::byte> bytes) {
    scratch::forEachRecord<T>(bytes, [&](const T& value) { values.push_back(value); });
}

} // namespace

RangeBinning::RangeBinning(const RangeMeans& means) : means_(means) {
    const read::MeshSummary& source = means_.source.summary();
    const Bytes each = MemoryNeeds::rangeTask(source);
    atOnce_ = std::max<std::size_t>(countAtOnce(means_.room, each, means_.threads), 1);
    const std::uint64_t share = std::max(means_.room.count / atOnce_, each.count);
    tableBytes_ = share - (each.count - MemoryNeeds::minRangeTables(source).count);
    const std::uint64_t threads = means_.threads * means_.processes;
    verticesOfRange_ = rowsOfRange(source.vertexCount, threads, tableBytes_ / 4);
    facesOfRange_ = rowsOfRange(source.faceCount, threads, kMaxRows);
}

std::uint32_t RangeBinning::rangeCount(bool isOfFaces) const {
    const read::MeshSummary& source = means_.source.summary();
    const std::uint64_t rows = isOfFaces ? source.faceCount : source.vertexCount;
    const std::uint64_t each = isOfFaces ? facesOfRange_ : verticesOfRange_;
    return static_cast<std::uint32_t>((rows + each - 1) / each);
}

RowRange RangeBinning::rangeOf(std::uint32_t task, bool isOfFaces) const {
    const read::MeshSummary& source = means_.source.summary();
    const std::uint64_t rows = isOfFaces ? source.faceCount : source.vertexCount;
    const std::uint64_t each = isOfFaces ? facesOfRange_ : verticesOfRange_;
    return {task * each, std::min((task + 1) * each, rows), index_};
}

void RangeBinning::run(
    TaskKind kind, bool isOfFaces, std::function<std::vector<std::byte>(std::uint32_t)> input, Take take) {
    TaskPhase phase;
    phase.kind = kind;
    phase.tasks.resize(rangeCount(isOfFaces));
    std::iota(phase.tasks.begin(), phase.tasks.end(), 0U);
    phase.atOnce = atOnce_;
    phase.weight = [&](std::uint32_t task) {
        const RowRange range = rangeOf(task, isOfFaces);
        return range.end - range.begin;
    };
    phase.input = std::move(input);
    phase.take = std::move(take);
    means_.scratch.handOver();
    means_.runner.run(phase, means_.perform);
    means_.scratch.reopenOthers();
}

Blocks RangeBinning::posted(std::span<const std::byte> bytes) {
    if (bytes.empty()) return {};
    return {means_.scratch.append(bytes)};
}

void RangeBinning::release(Blocks& blocks) {
    for (const scratch::Block& block : std::exchange(blocks, {}))
        means_.scratch.release(block);
}

bool RangeBinning::countFaces(chunk::SourceSurvey& survey, chunk::EdgeSample& sample, std::vector<Mail>& pages) {
    means_.progress.stage("count", "faces", means_.source.summary().faceCount);
    std::vector<FaceCount> counts(rangeCount(true));
    run(
        TaskKind::CountFaces,
        true,
        [&](std::uint32_t task) {
            return encoded(CountInput{rangeOf(task, true), tableBytes_ / kPageVertices});
        },
        [&](std::uint32_t task, std::span<const std::byte> result) { counts[task] = decodedFaceCount(result); });
    bool isRegular = true;
    pages.resize(rangeCount(false));
    for (FaceCount& count : counts) {
        isRegular = isRegular && count.isRegular;
        survey.triangles += count.triangles;
        survey.notAPolygon += count.notAPolygon;
        survey.hasPolygons = survey.hasPolygons || count.hasPolygons;
        scratch::forEachRecord<chunk::EdgeSample::Entry>(
            means_.scratch.read(count.sample), [&](const chunk::EdgeSample::Entry& entry) { sample.take(entry); });
        release(count.sample);
        for (const auto& [page, block] : count.pages)
            pages[page * kPageVertices / verticesOfRange_].push_back({page, block});
    }
    return isRegular && survey.triangles > 0;
}

Box RangeBinning::measure(
    const std::vector<Mail>& pages,
    const std::vector<std::uint64_t>& sampled,
    chunk::SourceSurvey& survey,
    std::vector<glm::dvec3>& positions) {
    means_.progress.stage("measure", "vertices", means_.source.summary().vertexCount);
    std::vector<Blocks> asked;
    auto next = sampled.begin();
    for (std::uint32_t task = 0; task < rangeCount(false); ++task) {
        const auto end = std::lower_bound(next, sampled.end(), rangeOf(task, false).end);
        asked.push_back(posted(std::as_bytes(std::span(next, end))));
        next = end;
    }
    std::vector<VertexMeasure> measures(rangeCount(false));
    run(
        TaskKind::MeasureVertices,
        false,
        [&](std::uint32_t task) {
            return encoded(MeasureInput{rangeOf(task, false), pages[task], asked[task]});
        },
        [&](std::uint32_t task, std::span<const std::byte> result) { measures[task] = decodedMeasure(result); });
    Box box;
    positions.reserve(sampled.size());
    for (VertexMeasure& measure : measures) {
        box.add(measure.box);
        survey.badNormals += measure.badNormals;
        for (std::size_t i = 0; i < survey.fields.size(); ++i) {
            hierarchy::Field& field = survey.fields[i];
            field.min = std::min(field.min, measure.fields.at(i)[0]);
            field.max = std::max(field.max, measure.fields.at(i)[1]);
        }
        append(positions, means_.scratch.read(measure.positions));
        release(measure.positions);
        valence_.push_back(std::move(measure.valence));
    }
    for (Blocks& blocks : asked)
        release(blocks);
    return box;
}

std::optional<chunk::SourceSurvey> RangeBinning::survey() {
    const read::MeshSummary& source = means_.source.summary();
    const std::optional<read::RowIndex> index = means_.source.indexRows(means_.progress);
    if (!index) return std::nullopt;
    index_ = posted(encoded(*index));
    chunk::SourceSurvey survey;
    survey.vertices = source.vertexCount;
    survey.fields = chunk::unmeasuredFields(source);
    chunk::EdgeSample sample;
    std::vector<Mail> pages;
    const bool isRegular = countFaces(survey, sample, pages);
    hasPolygons_ = survey.hasPolygons;
    std::vector<std::uint64_t> sampled = sample.vertices();
    std::sort(sampled.begin(), sampled.end());
    sampled.erase(std::unique(sampled.begin(), sampled.end()), sampled.end());
    std::vector<glm::dvec3> positions;
    if (isRegular) {
        const Box box = measure(pages, sampled, survey, positions);
        const chunk::VertexLookup lookup(std::move(sampled), std::move(positions));
        chunk::setGrid(survey, source.path, box, sample, lookup, means_.strays);
        chunk::endRanges(source.path, survey.fields);
    }
    for (const Mail& mail : pages)
        for (const auto& [page, block] : mail)
            means_.scratch.release(block);
    if (isRegular) return survey;
    release(index_);
    return std::nullopt;
}

chunk::ChunkTree RangeBinning::plan(const chunk::SourceSurvey& survey, std::uint32_t chunkTriangles) {
    const std::uint64_t limit = std::uint64_t{3} * chunkTriangles;
    chunk::CellCounts counts(survey.furthest, chunk::rootBitsFor(survey.vertices));
    do {
        means_.progress.stage("octree", "vertices", survey.vertices);
        Blocks shape = posted(counts.shape());
        run(
            TaskKind::CountCells,
            false,
            [&](std::uint32_t task) {
                return encoded(CellsInput{rangeOf(task, false), {survey.grid, survey.furthest}, valence_[task], shape});
            },
            [&](std::uint32_t, std::span<const std::byte> result) {
                hierarchy::ByteReader in(result);
                Blocks weights = takeBlocks(in);
                means_.scratch.reopenOthers();
                counts.addOpenWeights(means_.scratch.read(weights));
                release(weights);
            });
        release(shape);
    } while (counts.refine(limit / 8));
    return chunk::treeOf(counts, limit, means_.source.summary().path);
}

chunk::VertexTable<std::uint8_t> RangeBinning::takeValence() {
    chunk::VertexTable<std::uint8_t> table(means_.source.summary().vertexCount);
    for (std::uint32_t range = 0; range < valence_.size(); ++range) {
        const std::vector<std::byte> bytes = means_.scratch.read(valence_[range]);
        for (std::size_t i = 0; i < bytes.size(); ++i)
            if (bytes[i] != std::byte{0})
                table.at(rangeOf(range, false).begin + i) = std::to_integer<std::uint8_t>(bytes[i]);
        release(valence_[range]);
    }
    release(index_);
    return table;
}

chunk::BinnedSize RangeBinning::bin(
    const chunk::SourceSurvey& survey, const chunk::ChunkTree& tree, scratch::StreamStore& bins) {
    const std::uint64_t block =
        blockBytes({tableBytes_ / 2}, std::uint64_t{3} * std::max(tree.chunkCount(), std::uint32_t{1}));
    const std::uint64_t numberBytes = tree.chunkCount() > chunk::kNarrowChunks ? 4 : 2;
    Blocks treeBytes = posted(tree.encoded());
    std::vector<chunk::PartSize> sizes(tree.chunkCount());
    chunk::BinnedSize size;
    const auto deliver = [&](const BinnedRange& range) {
        for (const auto& [stream, streamBlock] : range.streams)
            bins.adopt(stream, streamBlock);
        for (const auto& [chunk, more] : range.sizes) {
            sizes[chunk].triangles += more.triangles;
            sizes[chunk].vertices += more.vertices;
        }
        size.strayed.triangles += range.strayed.triangles;
        size.strayed.corners.add(range.strayed.corners);
    };
    means_.progress.stage("bin", "vertices", survey.vertices);
    std::vector<BinnedRange> ofVertices(rangeCount(false));
    run(
        TaskKind::BinVertices,
        false,
        [&](std::uint32_t task) {
            return encoded(BinVerticesInput{
                rangeOf(task, false), {survey.grid, survey.furthest}, survey.fields, valence_[task], treeBytes, block});
        },
        [&](std::uint32_t task, std::span<const std::byte> result) { ofVertices[task] = decodedBinnedRange(result); });
    Blocks numbers;
    // The ranges are processed in order, so that the result does not depend on the order in which tasks finish.
    for (const BinnedRange& range : ofVertices) {
        deliver(range);
        numbers.insert(numbers.end(), range.chunks.begin(), range.chunks.end());
    }
    for (Blocks& valence : valence_)
        release(valence);
    release(treeBytes);
    means_.progress.stage("bin", "faces", means_.source.summary().faceCount);
    std::vector<BinnedRange> ofFaces(rangeCount(true));
    const std::uint64_t pageBytes = tableBytes_ / (hasPolygons_ ? 4 : 2);
    const std::uint64_t maxCorners = hasPolygons_ ? tableBytes_ / 4 / kBytesPerCorner : 0;
    run(
        TaskKind::BinFaces,
        true,
        [&](std::uint32_t task) {
            return encoded(BinFacesInput{
                rangeOf(task, true),
                tree.chunkCount(),
                numbers,
                pageBytes / (kPageVertices * numberBytes),
                maxCorners,
                block});
        },
        [&](std::uint32_t task, std::span<const std::byte> result) { ofFaces[task] = decodedBinnedRange(result); });
    for (const BinnedRange& range : ofFaces)
        deliver(range);
    release(numbers);
    release(index_);
    for (const chunk::PartSize& chunk : sizes)
        size.largestChunk.growTo(chunk);
    return size;
}

} // namespace gnomon::pipeline
