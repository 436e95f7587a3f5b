// Finds pages that a cut need not read, because it certainly draws none of their clusters.
#include "lod/cut.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::lod {

bool isSkippable(const CutQuery& query, std::uint32_t page) {
    const hierarchy::PageInfo& info = query.passable[page];
    if (std::isinf(info.maxError)) return false;
    // The clusters that refine a page are in its child pages. Casters can only require more detail, so testing the view
    // alone is sufficient.
    return !info.children.empty() && std::all_of(info.children.begin(), info.children.end(), [&](std::uint32_t child) {
        const hierarchy::PageInfo& finer = query.passable[child];
        const Box box = query.trees->grid().local(finer.box);
        return query.rule->minViewPixels(box, finer.minError) > query.errorPixels;
    });
}

void replacePassed(const CutQuery& query, Cut& cut) {
    // Pages are processed by ascending id, because only pages with higher ids refine a page. All coarser pages of a
    // page are therefore complete before the page.
    std::map<std::uint32_t, double> pixelsOf;
    for (const hierarchy::PageDemand& wanted : cut.wanted)
        pixelsOf[wanted.page] = wanted.pixels;
    cut.wanted.clear();
    std::map<std::uint32_t, double> used;
    for (const hierarchy::PageDemand& known : cut.used)
        used[known.page] = known.pixels;
    for (; !pixelsOf.empty(); pixelsOf.erase(pixelsOf.begin())) {
        const auto [page, pixels] = *pixelsOf.begin();
        if (!isSkippable(query, page)) {
            cut.wanted.push_back({page, pixels});
            continue;
        }
        cut.passed.push_back(page);
        for (const std::uint32_t child : query.passable[page].children) {
            double& maxPixels = (query.resident[child] != nullptr ? used : pixelsOf)[child];
            maxPixels = std::max(maxPixels, pixels);
        }
    }
    cut.used.clear();
    for (const auto& [page, pixels] : used)
        cut.used.push_back({page, pixels});
}

} // namespace gnomon::lod
