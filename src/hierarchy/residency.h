// The data about pages that streaming and cut selection exchange: resident pages, used pages and requested pages.
#pragma once

#include "hierarchy/page.h"

#include <set>
#include <span>

namespace gnomon::hierarchy {

/// The decoded pages, indexed by page id. A page that is not resident is null. Residency is ancestor-complete: if a
/// page is resident, each page with a refinement into this page is resident too. There are two exceptions: damaged
/// pages, and pages of frames that draw nothing until their cut is complete.
using ResidentPages = std::span<const Page* const>;

/// Groups of resident pages that must not be refined, because a part of their finer geometry depends on a damaged page.
using BlockedGroups = std::set<GroupRef>;

/// A page that a view uses or requests, and its priority. The priority is the error in pixels that disappears from the
/// image when the page is used. It is infinite for a page with a root group.
struct PageDemand {
    std::uint32_t page = kNone;
    double pixels = 0;
};

} // namespace gnomon::hierarchy
