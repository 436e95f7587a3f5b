#include "preprocess/pipeline/build_model.h"

#include "core/heap.h"
#include "core/limit_error.h"
#include "core/stopwatch.h"
#include "preprocess/chunk/binning.h"
#include "preprocess/chunk/borders.h"
#include "preprocess/chunk/chunk_mesh.h"
#include "preprocess/chunk/in_order.h"
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/node.h"
#include "preprocess/pipeline/assemble.h"
#include "preprocess/pipeline/build_key.h"
#include "preprocess/pipeline/counted_memory.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/round_bins.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/upright_model.h"
#include "preprocess/pipeline/work_directory.h"

#include <tbb/global_control.h>

#include <cstdio>
#include <utility>

namespace gnomon::pipeline {

namespace {

using hierarchy::kNone;

/// Seconds since the last lap, or since `watch` was made; begins the next.
double lap(Stopwatch& watch) {
    return std::exchange(watch, Stopwatch()).elapsed().count / 1000;
}

void requireFewStuck(const std::string& output, std::uint64_t stuck, std::uint64_t triangles, double maxPercent) {
    const double percent = 100.0 * static_cast<double>(stuck) / static_cast<double>(triangles);
    if (percent <= maxPercent) return;
    const auto text = [](double value) {
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), "%.2f%%", value);
        return std::string(digits.data());
    };
    throw LimitError(
        Limit::StuckTriangles,
        {output, "too many triangles stay at full detail", "at most " + text(maxPercent), text(percent)});
}

RoundReport reportOf(const RoundRecord& record) {
    RoundReport report{record.nodes.size(), 0, record.locks.locked, record.locks.lockedBefore};
    for (const ClusterSums& node : record.nodes)
        report.triangles += node.triangles;
    return report;
}

/// One build, phase after phase. A phase that the checkpoint log has as finished is skipped.
class Build {
public:
    Build(read::MeshSource& source, const BuildOptions& options, Progress& progress)
        : source_(source),
          options_(options),
          progress_(progress),
          needs_(affordableNeeds()),
          threads_(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)),
          workDirectory_(
              {options.output,
               options.temporaryFolder,
               keyOf(options),
               options.isInMemory,
               options.isResumed,
               options.onKeptFolder},
              progress) {}

    BuildReport run() {
        source_.pollWith(progress_);
        bin();
        shareBorders();
        buildRounds();
        assemble();
        report_.temporaryBytes = workDirectory_.space().peakBytes();
        return std::move(report_);
    }

private:
    /// Before anything is touched.
    MemoryNeeds affordableNeeds() const {
        const MemoryNeeds needs{source_.summary(), options_.chunkTriangles, options_.isInMemory};
        if (needs.least() > options_.memory) {
            source_.pollWith(progress_);
            requireMemory(countedLeast(source_, needs, options_.memory, progress_));
        }
        return needs;
    }

    void requireMemory(const Bytes& needed) const {
        if (needed > options_.memory)
            throw LimitError(
                Limit::Memory,
                {source_.summary().path,
                 "too little memory for this model",
                 std::to_string((needed.count >> 20U) + 1) + "M or more",
                 readableBytes(options_.memory)});
    }

    Bytes roomBeside(const Bytes& taken) const {
        return {options_.memory.count > taken.count ? options_.memory.count - taken.count : 0};
    }

    void endPhase(const std::string& name, std::uint64_t sourceBytes) {
        scratch::TemporarySpace& space = workDirectory_.space();
        report_.phases.push_back(
            {name,
             lap(watch_),
             sourceBytes + space.bytesRead() - std::exchange(bytesRead_, space.bytesRead()),
             space.bytesWritten() - std::exchange(bytesWritten_, space.bytesWritten())});
    }

    /// Sorts the source into chunks.
    void bin() {
        const bool isResumed = log().binned().has_value();
        if (isResumed) {
            binsFile_ = workDirectory_.scratch("bins", log().binned()->scratchEnd);
            bins_.emplace(*binsFile_, log().binned()->directory);
        } else {
            chunk::SourceSurvey survey = chunk::surveySource(source_, progress_);
            endPhase("count", source_.summary().fileBytes);
            const chunk::ChunkTree tree = chunk::planChunks(source_, survey, options_.chunkTriangles, progress_);
            endPhase("octree", 0);
            BinnedRecord record;
            record.grid = survey.grid;
            record.furthest = survey.furthest;
            record.format = chunk::formatOf(source_.summary());
            record.fields = survey.fields;
            record.triangles = survey.triangles;
            record.vertices = survey.vertices;
            record.notAPolygon = survey.notAPolygon;
            record.chunkCount = tree.chunkCount();
            binsFile_ = workDirectory_.scratch("bins");
            const Bytes room = roomBeside(needs_.binning());
            bins_.emplace(
                *binsFile_,
                chunk::binStreams(tree.chunkCount()),
                blockBytes({room.count / 2}, std::uint64_t{3} * tree.chunkCount()));
            const chunk::BinnedSize size =
                chunk::binSource(source_, survey, tree, *bins_, room.count / 2 / kBytesPerPolygonCorner, progress_);
            record.largestChunk = size.largestChunk;
            record.dropped = {size.dropped.degenerate, size.dropped.doubled, size.dropped.collapsedByGrid};
            source_.requireUnchanged(); // it is not read again
            record.scratchEnd = binsFile_->end();
            record.directory = bins_->directory();
            workDirectory_.finish(std::move(record));
            endPhase("bin", source_.summary().fileBytes);
        }
        const Bytes needed = {needs_.base().count + MemoryNeeds::node(log().binned()->largestChunk).count};
        if (isResumed && needed > options_.memory) workDirectory_.leave(); // what is finished waits for more memory
        requireMemory(needed);
        if (const chunk::PartSize& most = log().binned()->largestChunk;
            countAtOnce(roomBeside(needs_.base()), MemoryNeeds::node(most), threads_) < 2)
            returnFreedMemoryAtOnce(); // memory is tight
    }

    /// Lets the chunks exchange what they share.
    void shareBorders() {
        const std::uint32_t chunks = log().binned()->chunkCount;
        if (log().bordered()) {
            bordersFile_ = workDirectory_.scratch("borders", log().bordered()->scratchEnd);
            borders_.emplace(*bordersFile_, log().bordered()->directory);
            return;
        }
        bordersFile_ = workDirectory_.scratch("borders");
        const Bytes room = roomBeside(needs_.base());
        const BorderShare share = borderShare(room, MemoryNeeds::borders(log().binned()->largestChunk), threads_);
        borders_.emplace(
            *bordersFile_, chunk::borderStreams(chunks), blockBytes(share.blocks, chunk::borderStreams(chunks)));
        chunk::shareBorders(binnedSource(), *borders_, share.chunksAtOnce, progress_);
        workDirectory_.finish(BorderedRecord{bordersFile_->end(), borders_->directory()});
        endPhase("borders", 0);
    }

    void buildRounds() {
        reopenResults();
        progress_.stage("build", "triangles", 2 * log().binned()->triangles);
        Round round = firstRound(log().binned()->chunkCount);
        for (;;) {
            buildRound(round);
            endPhase("round " + std::to_string(round.number), 0);
            if (round.number == 0) requireTriangles();
            if (round.isLast) break;
            round = roundBins_->next(round, {roomBeside(needs_.base()), threads_, options_.chunkTriangles});
            endPhase("bin round " + std::to_string(round.number), 0);
            report_.rounds.push_back(reportOf(*log().binnedRound(round.number)));
        }
    }

    /// The scratch files of pages and of what rounds leave, as far as the checkpoint log tells of them.
    void reopenResults() {
        std::uint64_t pagesEnd = 0;
        for (std::uint32_t round = 0; round < log().roundCount(); ++round)
            for (const NodeRecord& node : log().nodes(round))
                for (const NodeRecord::LevelOfNode& level : node.levels)
                    for (const hierarchy::PageInfo& page : level.pages)
                        pagesEnd = std::max(pagesEnd, page.offset + page.storedBytes);
        pagesFile_ =
            log().roundCount() > 0 ? workDirectory_.scratch("pages", pagesEnd) : workDirectory_.scratch("pages");
        roundBins_.emplace(workDirectory_, progress_);
    }

    void buildRound(const Round& round) {
        workDirectory_.beginRound(round.number);
        const std::size_t finished = log().nodes(round.number).size();
        for (std::size_t node = 0; node < finished; ++node) {
            releaseInputs(round, node);
            for (const NodeRecord::LevelOfNode& level : log().nodes(round.number)[node].levels)
                progress_.advance(level.info.triangles);
        }
        const chunk::PartSize& most = round.number == 0 ? log().binned()->largestChunk : round.largestNode;
        const std::size_t atOnce = countAtOnce(roomBeside(needs_.base()), MemoryNeeds::node(most), threads_);
        chunk::makeInOrder(
            finished,
            round.nodeCount,
            std::max<std::size_t>(atOnce, 1),
            [&](std::size_t node) { return make(round, node); },
            [&](std::size_t node, Made made) {
                finish(round, std::move(made));
                releaseInputs(round, node);
            });
    }

    struct Made {
        levels::BuiltNode node;
        NodeRecord record; // what is known before the node has its place
    };

    Made make(const Round& round, std::size_t node) const {
        Made made;
        made.record.round = round.number;
        made.record.firstLevel = round.firstLevel;
        const levels::NodePlan plan{round.firstLevel, round.isLast ? kNone : kLevelsPerRound};
        if (round.number == 0) {
            chunk::ChunkMesh chunk =
                chunk::loadChunk(binnedSource(), *borders_, static_cast<std::uint32_t>(node), progress_);
            made.record.dropped = {chunk.dropped.degenerate, chunk.dropped.doubled, chunk.dropped.collapsedByGrid};
            made.record.bounds = chunk.bounds;
            made.record.hasNormals = chunk.hasNormals;
            made.node = levels::buildNode(
                chunk.mesh, levels::firstLevel(chunk.mesh, options_.level), plan, options_.level, progress_);
        } else {
            levels::PendingLevel pending = roundBins_->load(static_cast<std::uint32_t>(node));
            made.node = levels::buildNode(pending.mesh, std::move(pending.level), plan, options_.level, progress_);
        }
        return made;
    }

    /// Stores what was made and enters it into the log.
    void finish(const Round& round, Made made) {
        NodeRecord& record = made.record;
        const std::vector<std::uint32_t>& pageCounts = log().pageCounts();
        for (levels::NodeLevel& level : made.node.levels) {
            NodeRecord::LevelOfNode& own = record.levels.emplace_back();
            own.info = level.info;
            for (hierarchy::EncodedPage& page : level.pages) {
                page.info.offset = pagesFile_->append(page.bytes);
                for (std::uint32_t& child : page.info.children) {
                    // Pages of this node's levels were counted from its own first.
                    const levels::PageOfLevel place = levels::placeOfProvisional(child);
                    if (place.level >= round.firstLevel && place.level < pageCounts.size())
                        child = levels::provisionalId(place.level, place.page + pageCounts[place.level]);
                }
                own.pages.push_back(std::move(page.info));
            }
        }
        roundBins_->keep(made.node.pending, record);
        record.rootTriangles = made.node.rootTriangles;
        record.stuckTriangles = made.node.stuckTriangles;
        workDirectory_.finish(std::move(record));
    }

    /// Gives the space of what a finished node was made from back.
    void releaseInputs(const Round& round, std::size_t node) {
        if (round.number == 0) {
            const auto chunk = static_cast<std::uint32_t>(node);
            for (const chunk::BinStream kind :
                 {chunk::BinStream::Vertices,
                  chunk::BinStream::Triangles,
                  chunk::BinStream::Ghosts,
                  chunk::BinStream::Requests})
                bins_->release(chunk::streamOf(kind, chunk));
            for (const chunk::BorderStream kind : {chunk::BorderStream::Vertices, chunk::BorderStream::Normals})
                borders_->release(chunk::streamOf(kind, chunk));
            return;
        }
        roundBins_->release(static_cast<std::uint32_t>(node));
    }

    void requireTriangles() const {
        std::uint64_t triangles = 0;
        for (const NodeRecord& node : log().nodes(0))
            if (!node.levels.empty()) triangles += node.levels.front().info.triangles;
        if (triangles > 0) return;
        const std::array<std::uint64_t, 3> dropped = droppedTriangles(log());
        throw Error(
            source_.summary().path,
            "no triangles are left",
            "at least 1",
            std::to_string(dropped[0]) + " without area, " + std::to_string(dropped[2]) + " smaller than the grid");
    }

    /// Writes the model.
    void assemble() {
        Totals totals = totalsOf(log(), optionsOf(options_));
        hierarchy::ModelSummary& summary = totals.summary;
        if (options_.maxStuckPercent)
            requireFewStuck(
                options_.output, totals.stuckTriangles, summary.levels.front().triangles, *options_.maxStuckPercent);
        hierarchy::ModelWriter writer(options_.output);
        UprightModel upright(options_, summary, pagesOf(log()));
        writePages(
            log(), *pagesFile_, writer, progress_, [&](const hierarchy::EncodedPage& page) { upright.see(page); });
        source_.requireUnchanged();
        report_.upBecause = upright.tell(summary);
        report_.contentHash = writer.finish(summary);
        report_.fileBytes = writer.bytesWritten();
        report_.pages = totals.pages;
        report_.stuckTriangles = totals.stuckTriangles;
        report_.summary = summary;
        bytesWritten_ -= report_.fileBytes;
        endPhase("write", 0);
    }

    const CheckpointLog& log() const { return workDirectory_.log(); }

    chunk::BinnedSource binnedSource() const {
        const BinnedRecord& binned = *log().binned();
        return {*bins_, binned.grid, binned.format, binned.chunkCount};
    }

    static constexpr std::uint64_t kBytesPerPolygonCorner = 96;

    read::MeshSource& source_;
    const BuildOptions& options_;
    Progress& progress_;
    MemoryNeeds needs_;
    std::size_t threads_;
    WorkDirectory workDirectory_;
    BuildReport report_;
    Stopwatch watch_;
    std::uint64_t bytesRead_ = 0;
    std::uint64_t bytesWritten_ = 0;
    std::unique_ptr<scratch::ScratchFile> binsFile_;
    std::unique_ptr<scratch::ScratchFile> bordersFile_;
    std::unique_ptr<scratch::ScratchFile> pagesFile_;
    std::optional<scratch::StreamStore> bins_;
    std::optional<scratch::StreamStore> borders_;
    std::optional<RoundBins> roundBins_;
};

} // namespace

BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, Progress& progress) {
    const tbb::global_control threads(
        tbb::global_control::max_allowed_parallelism,
        options.threads > 0 ? static_cast<std::size_t>(options.threads)
                            : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
    Stopwatch watch;
    BuildReport report = Build(source, options, progress).run();
    report.seconds = lap(watch); // with the temporary files gone
    return report;
}

} // namespace gnomon::pipeline
