// The lines in which section planes meet a model, kept from frame to frame.
#pragma once

#include "executor/executor.h"
#include "executor/view/closed_lines.h"

#include <unordered_map>
#include <vector>

namespace gnomon::executor {

/// The lines of each section plane of the last frames of a model, as long as the plane and the clusters that lie near
/// it stay the same.
class SectionLines {
public:
    /// Finds those of `frame`, in cells of the grid, and marks those that are closed.
    void find(const FrameDrawing& frame);

    /// Of a plane of the frame that they were found for.
    const std::vector<SectionLine>& of(std::size_t plane) const { return held_[plane].lines; }

private:
    struct Held {
        Plane plane;
        std::vector<selection::ClusterRange> ranges;
        std::vector<SectionLine> lines;
        std::unordered_map<std::uint64_t, std::vector<SectionLine>> ofClusters; // by page and cluster
        std::size_t known = 0;                                                  // lines in these
    };

    struct ClusterName {
        const hierarchy::Page* page = nullptr;
        std::uint32_t cluster = 0;
    };

    static void gather(const FrameDrawing& frame, Held& held);

    std::vector<Held> held_;
};

} // namespace gnomon::executor
