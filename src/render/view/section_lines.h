// The intersection lines of section planes with a model, cached from frame to frame.
#pragma once

#include "render/backend.h"
#include "render/view/closed_lines.h"

#include <unordered_map>
#include <vector>

namespace gnomon::render {

/// A cache of the intersection lines of each section plane with the model. The lines stay valid until the plane or the
/// clusters near the plane change.
class SectionLines {
public:
    /// Computes the intersection lines of all section planes of `frame` with the model, in grid cells, and marks closed
    /// outlines.
    void find(const DrawInputs& frame);

    /// Returns the intersection lines of section plane `plane` in the last frame.
    const std::vector<SectionLine>& of(std::size_t plane) const { return held_[plane].lines; }

private:
    struct Held {
        Plane plane;
        std::vector<lod::ClusterRange> ranges;
        std::vector<SectionLine> lines;
        // Intersection lines of each cluster with the section plane, keyed by page and cluster.
        std::unordered_map<std::uint64_t, std::vector<SectionLine>> ofClusters;
        std::size_t known = 0; // total number of lines in ofClusters
    };

    struct ClusterName {
        const hierarchy::Page* page = nullptr;
        std::uint32_t cluster = 0;
    };

    static void gather(const DrawInputs& frame, Held& held);

    std::vector<Held> held_;
};

} // namespace gnomon::render
