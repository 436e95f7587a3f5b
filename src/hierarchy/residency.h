// What streaming and selection tell each other about pages: which are in memory, which are used and which are wanted.
#pragma once

#include "hierarchy/page.h"

#include <set>
#include <span>

namespace gnomon::hierarchy {

/// The decoded pages by page id; null where a page is not resident. Residency is closed upwards: where a page is
/// resident, so is every page with a refinement into it, but for damaged ones, and but for pages of frames that draw
/// nothing until their cut is complete.
using ResidentPages = std::span<const Page* const>;

/// Groups of resident pages that may not be refined because some of what they replace lies below a damaged page.
using BlockedGroups = std::set<GroupRef>;

/// A page that a view uses or wants, and why: the pixels of error that it removes from the screen. Infinite for a page
/// that holds a root group.
struct PageDemand {
    std::uint32_t page = kNone;
    double pixels = 0;
};

} // namespace gnomon::hierarchy
