// Stores decoded pages of a model under a hard byte budget. The store first loads the pages that reduce the error most.
// For each page in memory, all coarser pages above it are also in memory, except after an open demand (Demand::isOpen).
#pragma once

#include "core/error.h"
#include "core/stopwatch.h"
#include "core/units.h"
#include "hierarchy/residency.h"
#include "lod/loaders.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::lod {

/// A page that could not be loaded, because it is damaged or unreadable, or because memory was not available. The
/// coarser pages above it are drawn instead.
struct DamagedPage {
    std::uint32_t page = 0;
    std::string reason;    // one line, with path and byte offset
    bool isUnread = false; // true: the page is not damaged, but could not be read, or memory was not available
    // True: the page store will try to read the page again. The page is the first failure since the last successful
    // read.
    bool isRetried = false;
};

struct PageStoreOptions {
    /// Limit for the memory of decoded pages including their auxiliary data (ray-tracing trees) and the pages that are
    /// being loaded.
    Bytes budget = gibibytes(1);
    unsigned loaderThreads = 4;
    /// Called once per page that could not be loaded, on the thread that calls `admitLoaded` or `load`.
    std::function<void(const DamagedPage&)> onDamaged;
    /// Called when the memory of a page is released, on the thread that owns the page store.
    std::function<void(std::uint32_t page)> onEvicted = {};
    /// If true, a page that cannot be read counts as damaged. If false, `admitLoaded` and `load` throw an error for
    /// such a page.
    bool drawsWithoutUnread = false;
    /// If set, a page that cannot be read counts as missing, not as damaged. The store requests the page again, but not
    /// before this pause has passed. `onDamaged` then reports only the first such page until another page has been
    /// read.
    std::optional<Milliseconds> unreadPause = std::nullopt;
};

/// The pages that a frame needs. The page store may evict all other pages.
struct Demand {
    std::span<const hierarchy::PageDemand> used;
    std::span<const hierarchy::PageDemand> wanted;
    /// The prefetch set: finer pages that the frame may want after the wanted pages are loaded. They are loaded by the
    /// same queue, but receive memory only after the wanted pages.
    std::span<const hierarchy::PageDemand> prefetchSet = {};
    std::span<const hierarchy::PageDemand> prefetch = {}; // least urgent pages, loaded only if the budget permits
    /// True for an open demand: the caller draws only after all used and wanted pages are in memory. The store then
    /// does not read their coarser ancestors, but still reserves memory for the ancestors. Only for `load`.
    bool isOpen = false;
};

/// The state of the page store after it processed a demand.
struct DemandOutcome {
    std::uint64_t pagesMissing = 0; // used or wanted pages that are neither in memory nor damaged
    std::uint64_t pagesBlocked = 0; // wanted pages that are damaged
    bool isBudgetBinding = false;   // true: the budget is smaller than the demand
    bool hasChanged = false;        // true: pages were loaded or evicted
};

struct StoreStatistics {
    std::uint64_t residentPages = 0;
    Bytes resident;  // memory of decoded pages
    Bytes committed; // memory of pages that are decoded or being loaded, including auxiliary data
    Bytes peak;      // max of `committed` so far
    Bytes read;      // stored bytes of all pages read so far
    std::uint64_t pagesRead = 0;
    std::uint64_t pagesEvicted = 0;
    std::uint64_t pagesDamaged = 0;
};

/// Returns the memory of the page `info` after decoding.
Bytes decodedBytes(const hierarchy::PageInfo& info);

/// Stores the decoded pages of a model under a byte budget. Only the thread that owns the store may call it. A frame
/// that does not wait for pages calls `admitLoaded`, selects clusters (a cut), calls `request` and draws. Only
/// `admitLoaded` adds pages, or evicts pages that the last demand used. The pages of a frame therefore stay in memory
/// until the frame is drawn. A frame that waits for pages alternates between selecting clusters and `load`.
class PageStore {
public:
    /// Starts the loader threads, and reads the pages with root groups and their ancestors, up to half the budget.
    /// These pages are never evicted. Throws Error if one of them is damaged, or if the page table is not sorted
    /// coarsest first. If a page cannot be read, this constructor, `admitLoaded` and `load` throw the exception of the
    /// page source.
    PageStore(const PageSource& source, PageStoreOptions options);
    ~PageStore();
    PageStore(const PageStore&) = delete;
    PageStore& operator=(const PageStore&) = delete;
    PageStore(PageStore&&) = delete;
    PageStore& operator=(PageStore&&) = delete;

    hierarchy::ResidentPages resident() const { return table_; }

    /// Returns the groups of clusters that must not be refined, because a page below them is damaged. The result
    /// changes only when `resident()` changes.
    const hierarchy::BlockedGroups& blocked() const { return blocked_; }

    /// Returns true if `page` could not be read.
    bool isDamaged(std::uint32_t page) const { return entries_[page].state == State::Damaged; }

    /// Makes loaded pages available for drawing. Evicts used pages if other pages of the last demand need their memory
    /// more. Never waits for the disk. Returns true if pages were added or evicted. Throws Error if a page with a root
    /// group is damaged.
    bool admitLoaded();

    /// Requests the most urgent pages of `demand` from the loader threads. Evicts pages to make memory available, but
    /// not pages that `demand` uses. Never waits. Throws Error if the demanded pages with root groups do not fit into
    /// the budget.
    DemandOutcome request(const Demand& demand);

    /// Requests the pages of `demand`, waits until all pages that fit into the budget are in memory, and evicts all
    /// others. The demanded pages in memory therefore do not depend on earlier demands. The caller alternates between
    /// selecting clusters and `load` until nothing changes.
    DemandOutcome load(const Demand& demand);

    /// Returns true if pages may be in memory without their coarser ancestors, because of a `load` with an open demand.
    /// A cut is then valid only if it wants no pages.
    bool isOpen() const { return isOpen_; }

    /// Hides pages that lack a coarser ancestor in memory, or are below a damaged page, until their ancestors are in
    /// memory. Returns true if such pages existed.
    bool close();

    /// Reserves `bytes` of the budget for other data than pages, and evicts pages that the last `load` does not need.
    /// The value replaces the previous reservation; 0 releases it. Throws Error if the reservation and the
    /// never-evicted pages do not fit together.
    void reserve(Bytes bytes);

    /// Returns the memory of the pages that are never evicted.
    Bytes pinned() const { return pinned_; }

    /// Reserves additional memory for each page in memory, for auxiliary data such as ray-tracing trees. `bytes`
    /// returns the size for a page; null means none. The sizes replace the previous sizes. The additional memory is
    /// released with the page. The store evicts pages that the last `load` does not need, and from then on counts the
    /// additional memory. Throws Error if the never-evicted pages do not fit.
    void reserveAuxiliary(const std::function<Bytes(const hierarchy::PageInfo&)>& bytes);

    const StoreStatistics& statistics() const { return statistics_; }

private:
    /// The loading state of a page.
    enum class State : std::uint8_t {
        Absent,
        Loading, // in the queue, being read, or decoded before one of its parents
        Resident,
        Damaged, // could not be read
    };

    /// The reason why a page must not be evicted, weakest first.
    enum class Retention : std::uint8_t {
        None,
        InUse,  // drawn until the next `admitLoaded`
        Kept,   // the budget has memory for it in the current demand
        Pinned, // never evicted
    };

    /// Whether the current demand needs a page, and for what.
    enum class Need : std::uint8_t { None, Prefetch, Certain /* used, wanted, or a parent of such a page */ };

    /// The run-time state of one page.
    struct Entry {
        std::unique_ptr<const hierarchy::Page> content;
        std::vector<std::uint32_t> parents;
        Bytes bytes;                    // memory of the page with its auxiliary bytes
        std::uint64_t lastUsed = 0;     // number of the last demand that requested the page
        double urgency = 0;             // urgency in the current demand; above 0 only if the page is in `requested_`
        std::uint32_t heldChildren = 0; // number of children that are resident or being loaded
        bool isRoot = false;            // true: the page contains a root group
        State state = State::Absent;
        std::optional<Stopwatch> unreadSince{}; // time of the last failed read
        Need need = Need::None;
        bool isRequested = false; // true: the current demand contains the page itself, not only a finer page below it
        Retention retention = Retention::None;

        bool isKept() const { return retention >= Retention::Kept; }
    };

    void link();
    void loadRoots();
    void rank(const Demand& demand);
    void raisePriority(std::uint32_t page, double urgency, Need need);
    void raiseParents();
    Error tooSmall(const std::string& what, Bytes required) const;
    void chooseKept(DemandOutcome& outcome);
    bool keep(Entry& entry, Bytes& total) const;
    void requestKept();
    bool evictFor(Bytes bytes);
    void withdrawQueued();
    bool takeFinished();
    bool admitWaiting();
    bool dropUnkept();
    void release(std::uint32_t page);
    void hold(std::uint32_t page);
    void evict(std::uint32_t page);
    bool isPausing(const Entry& entry) const;
    bool isUnrequested(std::uint32_t page) const;
    void blockGroups(std::uint32_t page);
    template <class Block>
    void blockBelow(std::uint32_t parent, std::uint32_t page, const Block& block) const;
    std::exception_ptr reject(const LoadedPage& loaded);
    void admit(LoadedPage loaded);
    void hide(std::uint32_t page);
    void countMissing(const Demand& demand, DemandOutcome& outcome) const;

    const PageSource* source_;
    PageStoreOptions options_;
    std::vector<Entry> entries_;
    std::vector<const hierarchy::Page*> table_;
    // pages of the current demand, most urgent first, coarser pages before finer pages
    std::vector<std::uint32_t> requested_;
    // pages in memory that the current demand may evict; the next page to evict is the last
    std::vector<std::uint32_t> victims_;
    bool areVictimsKnown_ = false;
    bool isOpen_ = false; // true: resident pages need not be ancestor-complete
    // true: onDamaged has reported an unreadable page, and no page could be read since
    bool isUnreadTold_ = false;
    std::vector<LoadedPage> waiting_; // pages that were decoded before one of their parents
    hierarchy::BlockedGroups blocked_;
    Bytes pinned_;
    Bytes reserved_;
    std::uint64_t clock_ = 0;
    StoreStatistics statistics_;
    Loaders loaders_; // last member, so that the threads stop before the other members are destroyed
};

} // namespace gnomon::lod
