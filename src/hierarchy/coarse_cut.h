// Selection of a coarse cut that shows the whole shape of a model. Its read cost does not grow with the model.
#pragma once

#include "hierarchy/model.h"

#include <limits>
#include <span>

namespace gnomon::hierarchy {

/// Returns true if a uniform cut of `error` draws clusters of the page `info`.
inline bool isDrawnOf(const PageInfo& info, double error) {
    return info.maxError == std::numeric_limits<double>::infinity() || info.maxError > error;
}

/// Returns the error of this cut, for pages whose bounds have this diagonal. The error is 1/400 of the diagonal, or
/// larger if the decoded pages without root groups would otherwise exceed `maxBytes`. `pages` is a range of ranges of
/// PageInfo.
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

/// Returns the error of the cut from which the up direction is guessed. This cut has a smaller error but fewer bytes.
/// `diagonal` belongs to the main part of the model.
template <class Pages>
double upError(const Pages& pages, double diagonal) {
    return coarseError(pages, 0.4 * diagonal, std::uint64_t{4} << 20U);
}

} // namespace gnomon::hierarchy
