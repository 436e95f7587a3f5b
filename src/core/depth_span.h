// An interval of view depth.
#pragma once

namespace gnomon {

/// A range of view depths in world units, with near <= far.
struct DepthSpan {
    double near = 0;
    double far = 0;
    bool operator==(const DepthSpan&) const = default;
};

} // namespace gnomon
