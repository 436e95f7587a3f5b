// Selects a coarse cut that shows the whole shape of a model. The bytes to read for it do not grow with the model.
#pragma once

#include "hierarchy/model.h"

#include <limits>
#include <span>

namespace gnomon::hierarchy {

/// Returns true if the uniform cut with the error limit `error` contains clusters of the page `info`.
inline bool isDrawnOf(const PageInfo& info, double error) {
    return info.maxError == std::numeric_limits<double>::infinity() || info.maxError > error;
}

/// Returns the error limit of a coarse uniform cut. `diagonal` is the diagonal of the model's bounds. The limit is
/// 1/400 of the diagonal. It is larger if the decoded pages without root groups would otherwise exceed `maxBytes`.
/// `pages` is a range of ranges of PageInfo.
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

/// Returns the error limit of the cut from which the up direction is guessed. It is smaller than that of coarseError,
/// but `maxBytes` is smaller too. `diagonal` is the diagonal of the model's main part.
template <class Pages>
double upError(const Pages& pages, double diagonal) {
    return coarseError(pages, 0.4 * diagonal, std::uint64_t{4} << 20U);
}

} // namespace gnomon::hierarchy
