// A uniform cut as one triangle soup, and the error bounds of the groups in it.
#pragma once

#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/triangle_tree.h"

#include <vector>

namespace gnomon::verify {

/// The triangles and clusters of a uniform cut. The cut refines each group whose stored error exceeds a limit.
struct UniformCut {
    struct Part {
        std::uint32_t page = 0;
        std::uint32_t cluster = 0; // index of the cluster in its page
        std::uint32_t firstTriangle = 0;
    };

    TriangleSoup soup;       // local space
    std::vector<Part> parts; // ascending by firstTriangle

    /// Returns the part (cluster) that contains a triangle of the soup.
    const Part& partOf(std::uint32_t triangle) const;
};

/// Returns the uniform cut that refines each group with a stored error above `limit`.
UniformCut uniformCut(const LoadedModel& model, double limit);

/// Returns for each group the max stored error of the group itself and of the coarser groups that replace it in the cut
/// at `limit`. The value is 0 for a group that the cut refines. Groups are numbered across pages.
std::vector<double> boundsInCut(const LoadedModel& model, double limit);

} // namespace gnomon::verify
