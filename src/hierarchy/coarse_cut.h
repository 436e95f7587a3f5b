// Selects a coarse level of detail (a cut) that shows the whole shape of a model. The number of bytes to read for it
// does not grow with the model.
#pragma once

#include "hierarchy/model.h"

#include <limits>
#include <span>

namespace gnomon::hierarchy {

/// Returns true if clusters of the page `info` are drawn when the whole model has the error limit `error`.
inline bool isDrawnOf(const PageInfo& info, double error) {
    return info.maxError == std::numeric_limits<double>::infinity() || info.maxError > error;
}

/// Returns the error limit of a coarse cut of a model, in world units. `diagonal` is the diagonal of the model's
/// bounds, and the limit is 1/400 of it. The limit is larger if the decoded pages without root groups would otherwise
/// exceed `maxBytes`. `pages` is a range of ranges of PageInfo.
template <class Pages>
double coarseError(const Pages& pages, double diagonal, std::uint64_t maxBytes = std::uint64_t{16} << 20U) {
    double error = diagonal / 400;
    for (;; error *= 1.25) {
        std::uint64_t bytes = 0;
        for (const auto& some : pages)
            for (const PageInfo& info : some)
                if (info.maxError != std::numeric_limits<double>::infinity() && info.maxError > error)
                    bytes += decodedPageBytes(info);
        if (bytes <= maxBytes || !(error > 0)) return error;
    }
}

/// Returns the error limit of the coarse level of detail from which the up direction is guessed. `diagonal` is the
/// diagonal of the model's main part. Compared with coarseError, both the limit and `maxBytes` are smaller.
template <class Pages>
double upError(const Pages& pages, double diagonal) {
    return coarseError(pages, 0.4 * diagonal, std::uint64_t{4} << 20U);
}

} // namespace gnomon::hierarchy
