// A uniform cut as one triangle soup, with the error bounds of its groups.
#pragma once

#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/triangle_tree.h"

#include <vector>

namespace gnomon::verify {

/// The clusters of a uniform cut. The cut refines each group whose error exceeds a limit.
struct UniformCut {
    struct Part {
        std::uint32_t page = 0;
        std::uint32_t cluster = 0; // index in the page
        std::uint32_t firstTriangle = 0;
    };

    TriangleSoup soup;       // local space
    std::vector<Part> parts; // ascending by firstTriangle

    /// Returns the part that contains a triangle of the soup.
    const Part& partOf(std::uint32_t triangle) const;
};

/// Returns the cut that refines each group with an error above `limit`.
UniformCut uniformCut(const LoadedModel& model, double limit);

/// Returns for each group across pages the max error of the groups that replace it in the cut at `limit`, including
/// itself. The value is 0 for a refined group.
std::vector<double> boundsInCut(const LoadedModel& model, double limit);

} // namespace gnomon::verify
