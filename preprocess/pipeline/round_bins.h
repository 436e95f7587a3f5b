// Stores the data between two rounds of a build: the clusters of finished nodes, sorted by the nodes of the next round.
#pragma once

#include "preprocess/levels/open_clusters.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/tasks/task_bytes.h"
#include "preprocess/pipeline/work_directory.h"
#include "preprocess/scratch/stream_store.h"

namespace gnomon::pipeline {

/// The memory limit and the task runner for sorting clusters into the nodes of the next round.
struct BinningMeans {
    Bytes room; // memory for the sorting
    std::size_t threads = 1;
    std::uint32_t chunkTriangles = 0;
    TaskRunner& runner;
    const Perform& perform;
};

/// Sorts clusters between two rounds of a build. The clusters that have no groups after a round become the input of the
/// next round's nodes.
class RoundBins {
public:
    /// Creates an empty object. `workDirectory` and `progress` must outlive it.
    RoundBins(WorkDirectory& workDirectory, Progress& progress) : workDirectory_(workDirectory), progress_(progress) {}

    /// Returns the round after `round`. All nodes of `round` must be finished. The function sorts their clusters by the
    /// nodes of the next round, or restores the sorted clusters from the checkpoint log. It then frees the unsorted
    /// clusters.
    Round next(const Round& round, const BinningMeans& means);

    /// Returns the input for building the part `node` of the model in `round`. `round` must be a result of `next`. Many
    /// threads can call it at once.
    NodeInput input(const Round& round, std::uint32_t node) const;

    /// Returns the scratch file blocks with the input clusters of a finished node. The caller can free these blocks,
    /// because no later phase reads them.
    Blocks takeBlocks(std::uint32_t node);

private:
    /// The kinds of byte streams between rounds. Each node has one stream of each kind.
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
    std::optional<scratch::StreamStore> bins_; // the clusters of the current round, sorted by node
};

} // namespace gnomon::pipeline
