#include "lod/page_store.h"

#include "core/check.h"
#include "core/error.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace gnomon::lod {
namespace {

/// Factor for the urgency of prefetched pages. It is so small that all used and wanted pages are more urgent.
constexpr double kPrefetchScale = 1e-30;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

} // namespace

Bytes decodedBytes(const hierarchy::PageInfo& info) {
    return {hierarchy::decodedPageBytes(info)};
}

PageStore::PageStore(const PageSource& source, PageStoreOptions options)
    : source_(&source),
      options_(std::move(options)),
      entries_(source.pages().size()),
      table_(source.pages().size(), nullptr),
      loaders_(source, options_.loaderThreads) {
    link();
    loadRoots();
}

PageStore::~PageStore() = default;

void PageStore::link() {
    const std::span<const hierarchy::PageInfo> pages = source_->pages();
    for (std::uint32_t page = 0; page < pages.size(); ++page) {
        entries_[page].bytes = decodedBytes(pages[page]);
        entries_[page].isRoot = pages[page].maxError == kInfinite;
        for (const std::uint32_t child : pages[page].children) {
            if (child <= page || child >= pages.size())
                throw Error(
                    source_->name(),
                    "page table: page " + std::to_string(page) + " is refined by a page out of order",
                    "one after it",
                    std::to_string(child));
            entries_[child].parents.push_back(page);
        }
    }
}

void PageStore::loadRoots() {
    std::vector<hierarchy::PageDemand> roots;
    for (std::uint32_t page = 0; page < entries_.size(); ++page)
        if (entries_[page].isRoot) roots.push_back({page, kInfinite});
    rank({{}, roots});
    Bytes total;
    for (const std::uint32_t page : requested_)
        total.count += entries_[page].bytes.count;
    if (total.count > options_.budget.count / 2) return;
    const std::vector<std::uint32_t> needed = requested_;
    while (load({{}, roots}).hasChanged) {
    }
    for (const std::uint32_t page : needed) {
        Entry& entry = entries_[page];
        if (!entry.content) continue;
        entry.retention = Retention::Pinned;
        pinned_.count += entry.bytes.count;
    }
}

bool PageStore::admitLoaded() {
    const std::uint64_t evictedBefore = statistics_.pagesEvicted;
    const bool hasClosed = close();
    const bool hasCome = takeFinished() || hasClosed;
    for (const std::uint32_t page : requested_)
        if (entries_[page].retention == Retention::InUse) entries_[page].retention = Retention::None;
    areVictimsKnown_ = false;
    evictFor({0});
    requestKept();
    return hasCome || statistics_.pagesEvicted != evictedBefore;
}

DemandOutcome PageStore::request(const Demand& demand) {
    DemandOutcome outcome;
    rank(demand);
    for (const hierarchy::PageDemand& used : demand.used)
        entries_[used.page].retention = std::max(entries_[used.page].retention, Retention::InUse);
    withdrawQueued();
    chooseKept(outcome);
    requestKept();
    countMissing(demand, outcome);
    return outcome;
}

DemandOutcome PageStore::load(const Demand& demand) {
    DemandOutcome outcome;
    rank(demand);
    withdrawQueued();
    loaders_.wait();
    outcome.hasChanged = takeFinished();
    chooseKept(outcome);
    const bool isOpen = demand.isOpen && !outcome.isBudgetBinding && statistics_.pagesDamaged == 0;
    if (!isOpen && close()) outcome.hasChanged = true;
    isOpen_ = isOpen;
    requestKept();
    loaders_.wait();
    outcome.hasChanged = takeFinished() || outcome.hasChanged;
    if (outcome.isBudgetBinding) outcome.hasChanged = dropUnkept() || outcome.hasChanged;
    // evicts pages that are not demanded, because the auxiliary data of other pages may need their memory
    evictFor({0});
    countMissing(demand, outcome);
    const bool isIncomplete = statistics_.pagesDamaged > 0 || outcome.pagesMissing > 0;
    if (isIncomplete && close()) outcome.hasChanged = true; // a cut must be able to draw the coarser ancestors
    return outcome;
}

void PageStore::rank(const Demand& demand) {
    ++clock_;
    for (const std::uint32_t page : requested_) {
        Entry& entry = entries_[page];
        entry.urgency = 0;
        entry.need = Need::None;
        entry.isRequested = false;
        if (entry.retention != Retention::Pinned) entry.retention = Retention::None;
    }
    requested_.clear();
    areVictimsKnown_ = false;
    for (const hierarchy::PageDemand& used : demand.used)
        raisePriority(used.page, used.pixels, Need::Certain);
    for (const hierarchy::PageDemand& wanted : demand.wanted)
        raisePriority(wanted.page, wanted.pixels, Need::Certain);
    for (const hierarchy::PageDemand& soon : demand.prefetchSet)
        raisePriority(soon.page, soon.pixels, Need::Prefetch);
    for (const hierarchy::PageDemand& ahead : demand.prefetch)
        raisePriority(ahead.page, std::min(ahead.pixels, 1e20) * kPrefetchScale, Need::Prefetch);
    for (const std::uint32_t page : requested_)
        entries_[page].isRequested = true;
    raiseParents();
    std::sort(requested_.begin(), requested_.end(), [this](std::uint32_t a, std::uint32_t b) {
        const double urgencyA = entries_[a].urgency;
        const double urgencyB = entries_[b].urgency;
        return urgencyA != urgencyB ? urgencyA > urgencyB : a < b;
    });
    for (const std::uint32_t page : requested_)
        entries_[page].lastUsed = clock_;
}

void PageStore::raisePriority(std::uint32_t page, double urgency, Need need) {
    if (!(urgency > 0)) return;
    Entry& entry = entries_[page];
    if (entry.urgency == 0) requested_.push_back(page);
    entry.urgency = std::max(entry.urgency, urgency);
    entry.need = std::max(entry.need, need);
}

void PageStore::raiseParents() {
    // Pages are processed by descending id, because parents have lower ids than their children.
    std::priority_queue<std::uint32_t> finestFirst(requested_.begin(), requested_.end());
    while (!finestFirst.empty()) {
        const std::uint32_t page = finestFirst.top();
        finestFirst.pop();
        for (const std::uint32_t parent : entries_[page].parents) {
            if (entries_[parent].urgency == 0) finestFirst.push(parent);
            raisePriority(parent, entries_[page].urgency, entries_[page].need);
        }
    }
}

/// Returns the error for a memory budget that is smaller than the memory `required` for `what`.
Error PageStore::tooSmall(const std::string& what, Bytes required) const {
    const std::string found = readableBytes(options_.budget);
    return {source_->name(), "the page cache is too small for " + what, "at least " + readableBytes(required), found};
}

/// Selects the requested pages for which the memory budget suffices, the most urgent first. All used and wanted pages
/// and their ancestors come before prefetched pages. Parents come before children.
void PageStore::chooseKept(DemandOutcome& outcome) {
    Bytes total{pinned_.count + reserved_.count};
    for (const std::uint32_t page : requested_) {
        Entry& entry = entries_[page];
        if (entry.need != Need::Certain || keep(entry, total)) continue;
        if (entry.urgency == kInfinite) throw tooSmall("the coarsest level", {total.count + entry.bytes.count});
        outcome.isBudgetBinding = true;
        return;
    }
    for (const std::uint32_t page : requested_)
        if (!keep(entries_[page], total)) return;
}

/// Marks a page as kept in the budget, and adds its bytes to `total`. Returns false if the budget would be exceeded.
bool PageStore::keep(Entry& entry, Bytes& total) const {
    if (entry.isKept() || entry.state == State::Damaged) return true;
    if (total.count + entry.bytes.count > options_.budget.count) return false;
    total.count += entry.bytes.count;
    entry.retention = Retention::Kept;
    return true;
}

void PageStore::requestKept() {
    std::vector<std::uint32_t> requests;
    for (const std::uint32_t page : requested_) {
        Entry& entry = entries_[page];
        if (!entry.isKept() || entry.state != State::Absent || isPausing(entry)) continue;
        // parents are more urgent and were processed before
        if (isOpen_ ? !entry.isRequested : isUnrequested(page)) continue;
        if (!evictFor(entry.bytes)) break;
        hold(page);
        requests.push_back(page);
    }
    loaders_.request(requests);
}

void PageStore::reserve(Bytes bytes) {
    const Bytes required{pinned_.count + bytes.count};
    if (required > options_.budget) throw tooSmall("the coarsest level and what is held beside pages", required);
    reserved_ = bytes;
    evictFor({0});
}

void PageStore::reserveAuxiliary(const std::function<Bytes(const hierarchy::PageInfo&)>& bytes) {
    for (std::uint32_t page = 0; page < entries_.size(); ++page) {
        Entry& entry = entries_[page];
        const hierarchy::PageInfo& info = source_->pages()[page];
        const std::uint64_t grown = decodedBytes(info).count + (bytes ? bytes(info).count : 0) - entry.bytes.count;
        entry.bytes.count += grown;
        if (entry.state == State::Loading || entry.state == State::Resident) statistics_.committed.count += grown;
        if (entry.retention == Retention::Pinned) pinned_.count += grown;
    }
    if (pinned_ > options_.budget) throw tooSmall("the coarsest level and what is made of it", pinned_);
    statistics_.peak = std::max(statistics_.peak, statistics_.committed);
    evictFor({0});
}

bool PageStore::evictFor(Bytes bytes) {
    const auto fits = [&] {
        return statistics_.committed.count + reserved_.count + bytes.count <= options_.budget.count;
    };
    if (fits()) return true;
    if (!areVictimsKnown_) {
        areVictimsKnown_ = true;
        victims_.clear();
        for (std::uint32_t page = 0; page < table_.size(); ++page)
            if (entries_[page].state == State::Resident && entries_[page].retention == Retention::None)
                victims_.push_back(page);
        // After this sort, the next page to evict is the last: the page that was not used for the longest time. A child
        // page was used no later than its parents, so it is evicted before them.
        std::sort(victims_.begin(), victims_.end(), [this](std::uint32_t a, std::uint32_t b) {
            const std::uint64_t usedA = entries_[a].lastUsed;
            const std::uint64_t usedB = entries_[b].lastUsed;
            if (usedA != usedB) return usedA > usedB;
            return entries_[a].urgency != entries_[b].urgency ? entries_[a].urgency > entries_[b].urgency : a < b;
        });
    }
    while (!fits() && !victims_.empty()) {
        const std::uint32_t page = victims_.back();
        victims_.pop_back();
        if (entries_[page].heldChildren == 0) evict(page);
    }
    return fits();
}

void PageStore::withdrawQueued() {
    for (const std::uint32_t page : loaders_.withdraw())
        release(page);
}

bool PageStore::takeFinished() {
    const std::uint64_t before = statistics_.pagesRead;
    std::exception_ptr failure;
    for (LoadedPage& loaded : loaders_.finished()) {
        ++statistics_.pagesRead;
        if (!loaded.failure) statistics_.read.count += source_->pages()[loaded.page].storedBytes;
        if (loaded.content) {
            isUnreadTold_ = false;
            waiting_.push_back(std::move(loaded));
        } else if (const std::exception_ptr thrown = reject(loaded); !failure) {
            failure = thrown;
        }
    }
    while (admitWaiting()) {
    }
    if (failure) std::rethrow_exception(failure);
    return statistics_.pagesRead != before;
}

/// Makes decoded pages available for drawing that waited for their parents, if all parents are now available. The
/// function makes one pass over the pages. Returns true if there was such a page.
bool PageStore::admitWaiting() {
    bool hasMoved = false;
    std::vector<LoadedPage> still;
    for (LoadedPage& loaded : waiting_) {
        const Entry& entry = entries_[loaded.page];
        const auto isDecided = [this](std::uint32_t parent) {
            return entries_[parent].state == State::Resident || entries_[parent].state == State::Damaged;
        };
        if (isOpen_ || std::all_of(entry.parents.begin(), entry.parents.end(), isDecided)) {
            admit(std::move(loaded));
            hasMoved = true;
        } else if (isUnrequested(loaded.page)) {
            release(loaded.page);
            hasMoved = true;
        } else {
            still.push_back(std::move(loaded));
        }
    }
    waiting_ = std::move(still);
    return hasMoved;
}

/// Handles a page that could not be loaded. If no other page can be drawn in its place, returns the exception to throw.
std::exception_ptr PageStore::reject(const LoadedPage& loaded) {
    release(loaded.page);
    const bool isUnread = loaded.failure != nullptr;
    if (isUnread && !options_.drawsWithoutUnread) return loaded.failure;
    if (entries_[loaded.page].isRoot) return std::make_exception_ptr(Error(loaded.fault));
    if (isUnread && options_.unreadPause) {
        entries_[loaded.page].unreadSince = Stopwatch();
        if (options_.onDamaged && !isUnreadTold_) options_.onDamaged({loaded.page, loaded.fault, isUnread, true});
        isUnreadTold_ = true;
        return nullptr;
    }
    ++statistics_.pagesDamaged;
    entries_[loaded.page].state = State::Damaged;
    if (options_.onDamaged) options_.onDamaged({loaded.page, loaded.fault, isUnread});
    return nullptr;
}

bool PageStore::isPausing(const Entry& entry) const {
    return entry.unreadSince && entry.unreadSince->elapsed() < *options_.unreadPause;
}

/// Returns true if `page` waits for a parent that could not be read and that is not being loaded again.
bool PageStore::isUnrequested(std::uint32_t page) const {
    const std::vector<std::uint32_t>& parents = entries_[page].parents;
    return std::any_of(parents.begin(), parents.end(), [this](std::uint32_t parent) {
        return entries_[parent].state == State::Absent;
    });
}

void PageStore::admit(LoadedPage loaded) {
    Entry& entry = entries_[loaded.page];
    entry.state = State::Resident;
    entry.content = std::move(loaded.content);
    table_[loaded.page] = entry.content.get();
    ++statistics_.residentPages;
    statistics_.resident.count += decodedBytes(source_->pages()[loaded.page]).count;
    if (statistics_.pagesDamaged > 0 && !isOpen_) blockGroups(loaded.page);
}

/// Evicts the requested pages for which the memory budget does not suffice. Returns true if a page was evicted.
bool PageStore::dropUnkept() {
    bool hasDropped = false;
    // The least urgent pages come first, so that children are evicted before their parents.
    for (std::size_t i = requested_.size(); i-- > 0;) {
        const Entry& entry = entries_[requested_[i]];
        if (entry.isKept() || entry.state != State::Resident || entry.heldChildren != 0) continue;
        evict(requested_[i]);
        hasDropped = true;
    }
    return hasDropped;
}

void PageStore::hold(std::uint32_t page) {
    Entry& entry = entries_[page];
    entry.state = State::Loading;
    for (const std::uint32_t parent : entry.parents)
        ++entries_[parent].heldChildren;
    statistics_.committed.count += entry.bytes.count;
    statistics_.peak = std::max(statistics_.peak, statistics_.committed);
}

void PageStore::release(std::uint32_t page) {
    Entry& entry = entries_[page];
    entry.state = State::Absent;
    for (const std::uint32_t parent : entry.parents)
        --entries_[parent].heldChildren;
    statistics_.committed.count -= entry.bytes.count;
}

void PageStore::evict(std::uint32_t page) {
    Entry& entry = entries_[page];
    GNOMON_CHECK_OP(entry.heldChildren, ==, 0U);
    entry.content.reset();
    table_[page] = nullptr;
    blocked_.erase(blocked_.lower_bound({page, 0}), blocked_.lower_bound({page + 1, 0}));
    --statistics_.residentPages;
    ++statistics_.pagesEvicted;
    statistics_.resident.count -= decodedBytes(source_->pages()[page]).count;
    release(page);
    if (options_.onEvicted) options_.onEvicted(page);
}

void PageStore::countMissing(const Demand& demand, DemandOutcome& outcome) const {
    for (const std::span<const hierarchy::PageDemand> demands : {demand.used, demand.wanted}) {
        for (const hierarchy::PageDemand& requested : demands) {
            if (entries_[requested.page].state == State::Resident) continue;
            ++(entries_[requested.page].state == State::Damaged ? outcome.pagesBlocked : outcome.pagesMissing);
        }
    }
}

} // namespace gnomon::lod
