// What rounds leave to each other: the clusters of finished nodes, binned anew for the nodes of the next round.
#pragma once

#include "preprocess/levels/pending_level.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/pipeline/work_directory.h"
#include "preprocess/scratch/stream_store.h"

namespace gnomon::pipeline {

/// What binning may use.
struct BinningMeans {
    Bytes room; // of memory
    std::size_t threads = 1;
    std::uint32_t chunkTriangles = 0;
};

class RoundBins {
public:
    /// With the scratch files as far as the checkpoint log tells of them. Both must outlive this.
    RoundBins(WorkDirectory& workDirectory, Progress& progress);

    /// Stores what a node of the round leaves, and enters into `record` where it lies.
    void keep(const levels::EncodedPendingLevel& left, NodeRecord& record);

    /// The round after `round`, whose nodes are all finished: bins their clusters, or takes up what the checkpoint log
    /// has as binned. What the nodes left is gone afterwards.
    Round next(const Round& round, const BinningMeans& means);

    /// The clusters of a node of the round that `next` returned; safe from many threads.
    levels::PendingLevel load(std::uint32_t node) const;

    /// Gives the space of a finished node's clusters back.
    void release(std::uint32_t node);

private:
    /// The streams of a node.
    enum class Stream : std::uint32_t { Records, Locks, Borders, Count };

    const CheckpointLog& log() const { return workDirectory_.log(); }

    std::vector<levels::ClusterPlace> placesOf(const Round& round) const;
    RoundRecord bin(const Round& round, const BinningMeans& means);
    void routeAll(const Round& round, const BinningMeans& means, const ClusterPlan& plan, LockCounts& locks);
    void shareBorders(std::uint32_t nodeCount, std::size_t atOnce, LockCounts& locks);
    void releaseLeft(const Round& round);

    WorkDirectory& workDirectory_;
    Progress& progress_;
    std::unique_ptr<scratch::ScratchFile> leftFile_;
    std::unique_ptr<scratch::ScratchFile> binsFile_;
    std::optional<scratch::StreamStore> bins_; // of the round that is under way
    std::uint32_t round_ = 0;
};

} // namespace gnomon::pipeline
