// A uniform cut as one soup of triangles, and the bounds that hold in it.
#pragma once

#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/triangle_tree.h"

#include <vector>

namespace gnomon::verify {

/// All clusters that are drawn where every group with an error above some limit is refined.
struct UniformCut {
    struct Part {
        std::uint32_t page = 0;
        std::uint32_t cluster = 0; // in the page
        std::uint32_t firstTriangle = 0;
    };

    TriangleSoup soup;       // local space
    std::vector<Part> parts; // ascending by firstTriangle

    /// The part that a triangle of the soup belongs to.
    const Part& partOf(std::uint32_t triangle) const;
};

UniformCut uniformCut(const LoadedModel& model, double limit);

/// For each group across pages: the largest error of the groups that stand for it in the cut at `limit`, itself
/// included; 0 if it is refined.
std::vector<double> boundsInCut(const LoadedModel& model, double limit);

} // namespace gnomon::verify
