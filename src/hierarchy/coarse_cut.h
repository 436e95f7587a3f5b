// Which cut of a model tells enough of its shape as a whole, and costs the same to read for a model of any size.
#pragma once

#include "hierarchy/model.h"

#include <limits>
#include <span>

namespace gnomon::hierarchy {

/// Whether a uniform cut of `error` draws anything of the page `info`.
inline bool isDrawnOf(const PageInfo& info, double error) {
    return info.maxError == std::numeric_limits<double>::infinity() || info.maxError > error;
}

/// The error of that cut of the pages whose bounds have this diagonal: 1/400 of it, or as much more as it takes to read
/// `mostBytes` of decoded pages beside those of the roots. `pages` is a range of ranges of PageInfo.
template <class Pages>
double coarseError(const Pages& pages, double diagonal, std::uint64_t mostBytes = std::uint64_t{16} << 20U) {
    double error = diagonal / 400;
    for (;; error *= 1.25) {
        std::uint64_t bytes = 0;
        for (const auto& some : pages)
            for (const PageInfo& info : some)
                if (info.maxError != std::numeric_limits<double>::infinity() && info.maxError > error)
                    bytes += decodedPageBytes(info);
        if (bytes <= mostBytes || !(error > 0)) return error;
    }
}

/// The error of the cut of a model, whose main part has this diagonal, by which up is guessed: finer, but of fewer
/// bytes.
template <class Pages>
double upError(const Pages& pages, double diagonal) {
    return coarseError(pages, 0.4 * diagonal, std::uint64_t{4} << 20U);
}

} // namespace gnomon::hierarchy
