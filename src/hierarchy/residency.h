// Data that page streaming and the selection of detail exchange: the pages in memory, the used pages and the requested
// pages.
#pragma once

#include "hierarchy/page.h"

#include <set>
#include <span>

namespace gnomon::hierarchy {

/// All decoded pages of a model, indexed by page id. The entry of a page that is not in memory is null. If a page is in
/// memory, each coarser page that refers to it is in memory too. There are two exceptions: damaged pages, and pages of
/// frames that draw nothing until their cut is complete.
using ResidentPages = std::span<const Page* const>;

/// Groups of clusters that must not be refined, because a part of their finer geometry depends on a damaged page.
using BlockedGroups = std::set<GroupRef>;

/// A page that a view uses or requests, and its priority. The priority is the screen-space error in pixels that
/// disappears from the image when the page is used. It is infinite for a page with a root group.
struct PageDemand {
    std::uint32_t page = kNone;
    double pixels = 0;
};

} // namespace gnomon::hierarchy
