// What rounds leave to each other: the clusters of finished nodes, binned anew for the nodes of the next round.
#pragma once

#include "preprocess/levels/pending_level.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/tasks/task_bytes.h"
#include "preprocess/pipeline/work_directory.h"
#include "preprocess/scratch/stream_store.h"

namespace gnomon::pipeline {

/// What binning may use.
struct BinningMeans {
    Bytes room; // of memory
    std::size_t threads = 1;
    std::uint32_t chunkTriangles = 0;
    TaskRunner& runner;
    const Perform& perform;
};

class RoundBins {
public:
    /// All must outlive this.
    RoundBins(WorkDirectory& workDirectory, Progress& progress) : workDirectory_(workDirectory), progress_(progress) {}

    /// The round after `round`, whose nodes are all finished: bins their clusters, or takes up what the checkpoint log
    /// has as binned. What the nodes left is gone afterwards.
    Round next(const Round& round, const BinningMeans& means);

    /// What builds a node of `round`, which `next` returned; safe from many threads.
    NodeInput input(const Round& round, std::uint32_t node) const;

    /// Returns the blocks of a finished node's clusters, which nobody reads again.
    Blocks takeBlocks(std::uint32_t node);

private:
    /// The streams of a node.
    enum class Stream : std::uint32_t { Records, Locks, Borders, Count };
    static_assert(static_cast<std::uint32_t>(Stream::Count) == kStreamsOfNode);

    const CheckpointLog& log() const { return workDirectory_.log(); }

    std::vector<levels::ClusterPlace> placesOf(const Round& round) const;
    RoundRecord bin(const Round& round, const BinningMeans& means);
    void routeAll(const Round& round, const BinningMeans& means, const ClusterPlan& plan, LockCounts& locks);
    void shareBorders(std::uint32_t streams, std::size_t atOnce, const BinningMeans& means, LockCounts& locks);
    void deliver(Stream kind, const Mail& mail);
    Blocks leftBlocks(const Round& round) const;

    WorkDirectory& workDirectory_;
    Progress& progress_;
    std::optional<scratch::StreamStore> bins_; // of the round that is under way
};

} // namespace gnomon::pipeline
