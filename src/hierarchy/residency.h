// The data that streaming and selection exchange about pages: resident pages, used pages and requested pages.
#pragma once

#include "hierarchy/page.h"

#include <set>
#include <span>

namespace gnomon::hierarchy {

/// The decoded pages by page id, or null if a page is not resident. Residency is ancestor-complete: if a page is
/// resident, each page with a refinement into it is resident too. Exceptions are damaged pages, and pages of frames
/// that draw nothing until their cut is complete.
using ResidentPages = std::span<const Page* const>;

/// Groups of resident pages that must not be refined, because a part of their finer geometry is below a damaged page.
using BlockedGroups = std::set<GroupRef>;

/// A page that a view uses or requests, with its priority: the error in pixels that this page removes from the screen.
/// The priority is infinite for a page with a root group.
struct PageDemand {
    std::uint32_t page = kNone;
    double pixels = 0;
};

} // namespace gnomon::hierarchy
