// Hides pages whose coarser ancestors are not in memory, after an open demand (Demand::isOpen) has loaded pages without
// ancestors.
#include "lod/page_store.h"

#include <algorithm>

namespace gnomon::lod {

bool PageStore::close() {
    if (!isOpen_) return false;
    isOpen_ = false;
    bool hasHidden = false;
    // coarser pages (parents) have lower ids, so they come first
    for (std::uint32_t page = 0; page < entries_.size(); ++page) {
        const Entry& entry = entries_[page];
        const auto isThere = [this](std::uint32_t parent) { return entries_[parent].state == State::Resident; };
        if (entry.state != State::Resident || std::all_of(entry.parents.begin(), entry.parents.end(), isThere))
            continue;
        hide(page);
        hasHidden = true;
    }
    return hasHidden;
}

/// Makes `page` unavailable for drawing but preserves its content, as if the page had been decoded before one of its
/// parents.
void PageStore::hide(std::uint32_t page) {
    Entry& entry = entries_[page];
    entry.state = State::Loading;
    table_[page] = nullptr;
    blocked_.erase(blocked_.lower_bound({page, 0}), blocked_.lower_bound({page + 1, 0}));
    --statistics_.residentPages;
    statistics_.resident.count -= decodedBytes(source_->pages()[page]).count;
    LoadedPage& hidden = waiting_.emplace_back();
    hidden.page = page;
    hidden.content = std::move(entry.content);
    if (options_.onEvicted) options_.onEvicted(page);
}

} // namespace gnomon::lod
