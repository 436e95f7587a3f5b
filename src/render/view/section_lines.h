// The intersection lines of section planes with a model, cached from frame to frame.
#pragma once

#include "render/backend.h"
#include "render/view/closed_lines.h"

#include <unordered_map>
#include <vector>

namespace gnomon::render {

/// A cache of the intersection lines per section plane. Lines stay valid as long as the plane and the clusters near it
/// do not change.
class SectionLines {
public:
    /// Computes the lines of `frame`, in cells of the grid, and marks the closed ones.
    void find(const DrawInputs& frame);

    /// Returns the lines of a plane of the last frame.
    const std::vector<SectionLine>& of(std::size_t plane) const { return held_[plane].lines; }

private:
    struct Held {
        Plane plane;
        std::vector<lod::ClusterRange> ranges;
        std::vector<SectionLine> lines;
        std::unordered_map<std::uint64_t, std::vector<SectionLine>> ofClusters; // per page and cluster
        std::size_t known = 0;                                                  // number of lines in ofClusters
    };

    struct ClusterName {
        const hierarchy::Page* page = nullptr;
        std::uint32_t cluster = 0;
    };

    static void gather(const DrawInputs& frame, Held& held);

    std::vector<Held> held_;
};

} // namespace gnomon::render
