// A uniform cut of a model as a list of triangles, and the error bounds of the groups in it.
#pragma once

#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/triangle_tree.h"

#include <vector>

namespace gnomon::verify {

/// The triangles and clusters of a uniform cut. Such a cut refines each group whose stored error exceeds a limit.
struct UniformCut {
    struct Part {
        std::uint32_t page = 0;
        std::uint32_t cluster = 0; // index of the cluster in its page
        std::uint32_t firstTriangle = 0;
    };

    TriangleSoup soup;       // in local space
    std::vector<Part> parts; // the clusters, in ascending order of firstTriangle

    /// Returns the cluster that contains the triangle with the index `triangle`.
    const Part& partOf(std::uint32_t triangle) const;
};

/// Returns the uniform cut that refines each group of `model` whose stored error exceeds `limit`.
UniformCut uniformCut(const LoadedModel& model, double limit);

/// Returns an error bound for each group: the max stored error of the group itself and of the coarser groups that
/// replace it in the uniform cut at `limit`. The bound is 0 for a group that the cut refines. Groups are numbered
/// across pages.
std::vector<double> boundsInCut(const LoadedModel& model, double limit);

} // namespace gnomon::verify
