#include "preprocess/pipeline/build_model.h"

#include "core/heap.h"
#include "core/limit_error.h"
#include "core/stopwatch.h"
#include "hierarchy/source_cameras.h"
#include "preprocess/pipeline/assemble.h"
#include "preprocess/pipeline/build_key.h"
#include "preprocess/pipeline/counted_memory.h"
#include "preprocess/pipeline/memory_plan.h"
#include "preprocess/pipeline/round_bins.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/sort_source.h"
#include "preprocess/pipeline/tasks/task_work.h"
#include "preprocess/pipeline/tasks/write_pages.h"
#include "preprocess/pipeline/upright_model.h"
#include "preprocess/pipeline/work_directory.h"
#include "preprocess/scratch/damage_error.h"

#include <tbb/global_control.h>

#include <cstdio>
#include <numeric>
#include <utility>

namespace gnomon::pipeline {

namespace {

/// Returns the seconds since `watch` was created or last restarted, and restarts it.
double lap(Stopwatch& watch) {
    return std::exchange(watch, Stopwatch()).elapsed().count / 1000;
}

void requireFewIrreducible(
    const std::string& output, std::uint64_t irreducible, std::uint64_t triangles, double maxPercent) {
    const double percent = 100.0 * static_cast<double>(irreducible) / static_cast<double>(triangles);
    if (percent <= maxPercent) return;
    const auto text = [](double value) {
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), "%.2f%%", value);
        return std::string(digits.data());
    };
    throw LimitError(
        Limit::IrreducibleTriangles,
        {output, "too many triangles stay at full detail", "at most " + text(maxPercent), text(percent)});
}

RoundReport reportOf(const RoundRecord& record) {
    RoundReport report{record.nodes.size(), 0, record.locks.locked, record.locks.lockedBefore};
    for (const ClusterSums& node : record.nodes)
        report.triangles += node.triangles;
    return report;
}

/// Builds one model. It runs the phases in order, and skips the phases that the checkpoint log lists as finished.
class Build {
public:
    /// Prepares a build. `team` is null if this process builds alone.
    Build(
        read::MeshSource& source,
        const BuildOptions& options,
        std::size_t threads,
        ProcessTeam* team,
        Progress& progress)
        : source_(source),
          options_(options),
          team_(team),
          progress_(progress),
          threads_(threads),
          needs_(affordableNeeds()),
          workDirectory_(
              {options.output,
               options.temporaryFolder,
               keyOf(options),
               options.isInMemory,
               options.isResumed,
               options.onKeptFolder,
               options.scratchBytesPerSecond},
              progress) {}

    BuildReport run() {
        source_.pollWith(progress_);
        try {
            if (team_ != nullptr) team_->gather(options_, threads_, progress_);
            runPhases();
        } catch (const scratch::DamageError&) {
            throw;
        } catch (const hierarchy::Damage& damage) {
            throw scratch::DamageError(options_.output + ": temporary data", damage.what);
        } catch (...) {
            // A distributed build preserves its temporary files after an error, because the results of many machines
            // are worth more than the disk space.
            if (team_ != nullptr && log().binned()) workDirectory_.leave();
            throw;
        }
        report_.temporaryBytes = workDirectory_.space().peakBytes();
        report_.scratchRead = workDirectory_.space().bytesRead();
        report_.scratchWritten = workDirectory_.space().bytesWritten();
        report_.tableBytes = work_->maxTableBytes();
        return std::move(report_);
    }

private:
    void runPhases() {
        beginTasks();
        bin();
        shareBorders();
        buildRounds();
        assemble();
    }

    /// Returns the memory needs of the build. Throws LimitError if they exceed the limit. The build calls this function
    /// before it writes any file.
    MemoryNeeds affordableNeeds() const {
        MemoryNeeds needs{source_.summary(), options_.chunkTriangles, options_.isInMemory};
        needs.threads = threads_;
        if (needs.peak() > options_.memory) {
            source_.pollWith(progress_);
            requireMemory(source_.summary(), options_, countedNeed(source_, needs, options_.memory, progress_));
        }
        return needs;
    }

    Bytes room() const { return remainingMemory(options_, needs_.base()); }

    void endPhase(const std::string& name, std::uint64_t sourceBytes) {
        scratch::TemporarySpace& space = workDirectory_.space();
        const TeamShare team = team_ != nullptr ? team_->endPhase() : TeamShare{};
        space.takeOfOthers(team.bytesWritten);
        report_.phases.push_back(
            {name,
             lap(watch_),
             team.bytesRead + sourceBytes + space.bytesRead() - std::exchange(bytesRead_, space.bytesRead()),
             team.bytesWritten + space.bytesWritten() - std::exchange(bytesWritten_, space.bytesWritten()),
             team});
    }

    /// Creates the objects that run tasks. From now on tasks read the source and build the model, in any process.
    void beginTasks() {
        work_.emplace(source_, options_.level, workDirectory_.scratch(), progress_);
        perform_ = [this](TaskKind kind, std::span<const std::byte> input) { return work_->perform(kind, input); };
        if (team_ == nullptr) return;
        workDirectory_.expectProcesses(team_->processCount());
        workDirectory_.scratch().handOver();
        team_->begin(workDirectory_.scratchPlace(), progress_);
    }

    /// Sorts the triangles and vertices of the source into chunks.
    void bin() {
        const bool isResumed = log().binned().has_value();
        if (isResumed) {
            bins_.emplace(workDirectory_.scratch(), log().binned()->directory);
        } else {
            workDirectory_.finish(sortSource(
                {source_,
                 options_,
                 workDirectory_.scratch(),
                 runner(),
                 perform_,
                 progress_,
                 threads_,
                 team_ != nullptr ? team_->processCount() : 1,
                 [this](const std::string& name, std::uint64_t sourceBytes) { endPhase(name, sourceBytes); }},
                bins_));
            endPhase("bin", source_.summary().fileBytes);
        }
        const Bytes needed = needs_.building(log().binned()->largestChunk);
        // Preserves the finished work, so that a build with more memory can resume it.
        if (isResumed && needed > options_.memory) workDirectory_.leave();
        requireMemory(source_.summary(), options_, needed);
        if (countAtOnce(room(), MemoryNeeds::node(log().binned()->largestChunk, threads_), threads_) < 2)
            returnFreedMemoryAtOnce(); // memory is scarce in the following phases
        const TaskFacts facts{log().binned()->grid, log().binned()->format};
        work_->tell(facts);
        workDirectory_.scratch().handOver();
        if (team_ != nullptr) team_->tell(facts);
    }

    TaskRunner& runner() { return team_ != nullptr ? static_cast<TaskRunner&>(*team_) : localTasks_; }

    /// Exchanges the vertices and normals that several chunks use between these chunks.
    void shareBorders() {
        if (log().bordered()) {
            borders_.emplace(workDirectory_.scratch(), log().bordered()->directory);
            return;
        }
        const std::uint32_t chunks = log().binned()->chunkCount;
        progress_.stage("borders", "chunks", std::uint64_t{2} * chunks);
        borders_.emplace(workDirectory_.scratch(), chunk::borderStreams(chunks), 1);
        exchange(TaskKind::AnswerVertices, chunk::BorderStream::Vertices);
        if (log().binned()->format.hasNormals)
            progress_.advance(chunks);
        else
            exchange(TaskKind::AnswerNormals, chunk::BorderStream::Normals);
        workDirectory_.finish(BorderedRecord{borders_->directory()});
        endPhase("borders", 0);
    }

    void exchange(TaskKind kind, chunk::BorderStream stream) {
        TaskPhase phase;
        phase.kind = kind;
        phase.tasks.resize(log().binned()->chunkCount);
        std::iota(phase.tasks.begin(), phase.tasks.end(), 0U);
        phase.atOnce = atOnce(MemoryNeeds::borders(log().binned()->largestChunk));
        phase.weight = [this](std::uint32_t chunk) { return chunkBytes(chunk); };
        phase.input = [this](std::uint32_t chunk) { return chunkInput(streamsOfChunk(*bins_, &*borders_, chunk)); };
        std::vector<Mail> mail(phase.tasks.size());
        phase.take = [&](std::uint32_t chunk, std::span<const std::byte> result) {
            hierarchy::ByteReader in(result);
            mail[chunk] = takeMail(in);
            progress_.advance(1);
        };
        runner().run(phase, perform_);
        // The results are stored in chunk order, so that the bytes do not depend on the order in which tasks finish.
        for (const Mail& answers : mail)
            for (const auto& [chunk, block] : answers)
                borders_->adopt(chunk::streamOf(stream, chunk), block);
    }

    /// Returns the number of bytes that a task reads to build `chunk`.
    std::uint64_t chunkBytes(std::uint32_t chunk) const {
        std::uint64_t bytes = 0;
        for (std::uint32_t kind = 0; kind < static_cast<std::uint32_t>(chunk::BinStream::Count); ++kind)
            bytes += bins_->bytes(chunk::streamOf(static_cast<chunk::BinStream>(kind), chunk));
        return bytes;
    }

    /// Returns how many tasks fit into memory at the same time if each needs the memory `each`. The result is at least
    /// one, because one task always fits.
    std::size_t atOnce(const Bytes& each) const {
        return std::max<std::size_t>(countAtOnce(room(), each, threads_), 1);
    }

    void buildRounds() {
        roundBins_.emplace(workDirectory_, progress_);
        progress_.stage("build", "triangles", 2 * log().binned()->triangles);
        Round round = firstRound(log().binned()->chunkCount);
        for (;;) {
            buildRound(round);
            endPhase("round " + std::to_string(round.number), 0);
            if (round.number == 0) requireTriangles();
            if (round.isLast) break;
            round = roundBins_->next(round, {room(), threads_, options_.chunkTriangles, runner(), perform_});
            endPhase("bin round " + std::to_string(round.number), 0);
            expectWhatIsLeft(round);
            report_.rounds.push_back(reportOf(*log().binnedRound(round.number)));
        }
    }

    /// Estimates the remaining work for the progress display. The estimate assumes that the remaining rounds need the
    /// same work per triangle as the finished rounds.
    void expectWhatIsLeft(const Round& round) {
        const std::uint64_t source = log().binned()->triangles;
        std::uint64_t left = 0;
        for (const auto& node : log().binnedRound(round.number)->nodes)
            left += node.triangles;
        std::uint64_t done = 0;
        for (std::uint32_t before = 0; before < round.number; ++before)
            done += log().builtTriangles(before);
        if (left >= source) return;
        const double perTriangle = static_cast<double>(done) / static_cast<double>(source - left);
        progress_.expect(done + static_cast<std::uint64_t>(perTriangle * static_cast<double>(left)));
    }

    void buildRound(const Round& round) {
        workDirectory_.beginRound(round.number);
        TaskPhase phase;
        phase.kind = TaskKind::BuildNode;
        for (std::uint32_t node = 0; node < round.nodeCount; ++node) {
            if (log().isBuilt(round.number, node))
                workDirectory_.release(takeInputs(round, node));
            else
                phase.tasks.push_back(node);
        }
        progress_.advance(log().builtTriangles(round.number));
        const chunk::PartSize& largest = round.number == 0 ? log().binned()->largestChunk : round.largestNode;
        phase.atOnce = atOnce(MemoryNeeds::node(largest, threads_));
        phase.weight = [&](std::uint32_t node) {
            return round.number == 0 ? chunkBytes(node) : log().binnedRound(round.number)->nodes[node].triangles;
        };
        phase.input = [&](std::uint32_t node) { return encoded(inputOf(round, node)); };
        phase.take = [&](std::uint32_t node, std::span<const std::byte> result) {
            workDirectory_.finish(decodedNode(result), takeInputs(round, node));
        };
        runner().run(phase, perform_);
    }

    NodeInput inputOf(const Round& round, std::uint32_t node) const {
        if (round.number > 0) return roundBins_->input(round, node);
        NodeInput input;
        input.node = node;
        input.isLast = round.isLast;
        input.chunk = streamsOfChunk(*bins_, &*borders_, node);
        return input;
    }

    /// Returns the scratch file blocks that a finished node has read as its input. They can be freed, because no later
    /// phase reads them.
    Blocks takeInputs(const Round& round, std::uint32_t node) {
        if (round.number > 0) return roundBins_->takeBlocks(node);
        Blocks all;
        const auto take = [&](scratch::StreamStore& store, std::uint32_t stream) {
            const Blocks blocks = store.takeBlocks(stream);
            all.insert(all.end(), blocks.begin(), blocks.end());
        };
        for (std::uint32_t kind = 0; kind < static_cast<std::uint32_t>(chunk::BinStream::Count); ++kind)
            take(*bins_, chunk::streamOf(static_cast<chunk::BinStream>(kind), node));
        for (std::uint32_t kind = 0; kind < static_cast<std::uint32_t>(chunk::BorderStream::Count); ++kind)
            take(*borders_, chunk::streamOf(static_cast<chunk::BorderStream>(kind), node));
        return all;
    }

    void requireTriangles() const {
        std::uint64_t triangles = 0;
        for (const NodeRecord& node : log().nodes(0))
            if (!node.levels.empty()) triangles += node.levels.front().info.triangles;
        if (triangles > 0) return;
        const DroppedCounts dropped = droppedTriangles(log());
        throw Error(
            source_.summary().path,
            "no triangles are left",
            "at least 1",
            std::to_string(dropped[0]) + " without area, " + std::to_string(dropped[2]) + " smaller than the grid, " +
                std::to_string(log().binned()->strayed.triangles) + " beyond its range");
    }

    /// Writes the pages and tables of the model file.
    void assemble() {
        Totals totals = totalsOf(log(), optionsOf(options_));
        hierarchy::ModelSummary& summary = totals.summary;
        if (options_.maxIrreduciblePercent)
            requireFewIrreducible(
                options_.output,
                totals.irreducibleTriangles,
                summary.levels.front().triangles,
                *options_.maxIrreduciblePercent);
        hierarchy::ModelWriter writer(options_.output);
        workDirectory_.scratch().reopenOthers();
        UprightModel upright(options_, summary, pagesOf(log()));
        const PagesToWrite pages{
            log(),
            workDirectory_.scratch(),
            writer,
            progress_,
            [&](const hierarchy::PageInfo& page) { return upright.isSeen(page); },
            [&](const hierarchy::EncodedPage& page) { upright.see(page); }};
        if (team_ != nullptr && writer.unfinishedPath())
            writePagesInTasks(pages, options_.output, team_->processCount(), *team_, perform_);
        else
            appendPages(pages);
        source_.requireUnchanged();
        upright.tell(summary);
        if (const auto& cameras = source_.summary().cameras; !cameras.empty())
            summary.options[hierarchy::kCamerasOption] = hierarchy::camerasText(cameras);
        report_.contentHash = writer.finish(summary);
        report_.fileBytes = writer.bytesWritten();
        report_.pages = totals.pages;
        report_.irreducibleTriangles = totals.irreducibleTriangles;
        report_.summary = summary;
        report_.strays = log().binned()->strayed.corners;
        report_.medianEdge = log().binned()->medianEdge;
        report_.badNormals = log().binned()->badNormals;
        bytesWritten_ -= report_.fileBytes;
        endPhase("write", writer.bytesRead());
    }

    const CheckpointLog& log() const { return workDirectory_.log(); }

    read::MeshSource& source_;
    const BuildOptions& options_;
    ProcessTeam* team_;
    Progress& progress_;
    std::size_t threads_;
    MemoryNeeds needs_;
    WorkDirectory workDirectory_;
    BuildReport report_;
    Stopwatch watch_;
    std::uint64_t bytesRead_ = 0;
    std::uint64_t bytesWritten_ = 0;
    std::optional<scratch::StreamStore> bins_;
    std::optional<scratch::StreamStore> borders_;
    std::optional<RoundBins> roundBins_;
    LocalTasks localTasks_;
    std::optional<TaskWork> work_;
    Perform perform_;
};

BuildReport built(read::MeshSource& source, const BuildOptions& options, ProcessTeam* team, Progress& progress) {
    constexpr auto kLimit = tbb::global_control::max_allowed_parallelism;
    const std::size_t threads =
        options.threads > 0 ? static_cast<std::size_t>(options.threads) : tbb::global_control::active_value(kLimit);
    std::optional<tbb::global_control> limit;
    if (team == nullptr) limit.emplace(kLimit, threads); // in a distributed build each process limits its own threads
    Stopwatch watch;
    const auto run = [&](const BuildOptions& given) { return Build(source, given, threads, team, progress).run(); };
    BuildReport report;
    try {
        report = run(options);
    } catch (const scratch::DamageError& damage) {
        if (!options.isResumed) throw;
        if (team != nullptr) throw Error(std::string(damage.what()) + "; start the build anew");
        if (options.onDamage) options.onDamage(damage.what());
        BuildOptions anew = options;
        anew.isResumed = false;
        report = run(anew);
    }
    report.seconds = lap(watch); // includes the time for removing temporary files
    return report;
}

} // namespace

BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, Progress& progress) {
    return built(source, options, nullptr, progress);
}

BuildReport buildModel(read::MeshSource& source, const BuildOptions& options, ProcessTeam& team, Progress& progress) {
    return built(source, options, &team, progress);
}

} // namespace gnomon::pipeline
