// The page cache: decoded pages under a hard budget, loaded by the error that they remove, closed upwards at any time.
#pragma once

#include "core/error.h"
#include "core/stopwatch.h"
#include "core/units.h"
#include "hierarchy/residency.h"
#include "streaming/loaders.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::streaming {

/// A page in whose place its parents are drawn.
struct DamagedPage {
    std::uint32_t page = 0;
    std::string reason;     // one line, with path and byte offset
    bool isUnread = false;  // no damage: it could not be read, or there was no memory for it
    bool isRetried = false; // it is not given up, and it is the first of those since a page was read
};

struct PageStoreOptions {
    Bytes budget = gibibytes(1); // of decoded pages and what is kept beside them, those that are being loaded included
    unsigned loaderThreads = 4;
    std::function<void(const DamagedPage&)> onDamaged;      // once for each, on the thread of `admitLoaded` and `load`
    std::function<void(std::uint32_t page)> onEvicted = {}; // as its memory is given back, on the store's thread
    /// Whether a page that cannot be read counts as damaged; else that is an error: `admitLoaded` and `load` throw it.
    bool drawsWithoutUnread = false;
    /// If given: such a page is none, but missing, and requested again no earlier than so long after. `onDamaged` then
    /// hears of the first only until another one has been read.
    std::optional<Milliseconds> unreadPause = std::nullopt;
};

/// What a cut requests of the store. Pages that are not in it may be evicted.
struct Demand {
    std::span<const hierarchy::PageDemand> used;
    std::span<const hierarchy::PageDemand> wanted;
    /// What may turn out to be wanted once the wanted pages are there: loaded in turn with those, but given room only
    /// after them.
    std::span<const hierarchy::PageDemand> foreseen = {};
    std::span<const hierarchy::PageDemand> prefetch = {}; // after all others, if there is room
    /// Whether all that is used and wanted is drawn only once it is there: then what stands above a page is not read
    /// for being above it. It has its room all the same. For `load` alone.
    bool isOpen = false;
};

/// How far the last demand was served.
struct DemandOutcome {
    std::uint64_t pagesMissing = 0; // used or wanted, not resident and not damaged
    std::uint64_t pagesBlocked = 0; // wanted, but damaged
    bool isBudgetBinding = false;   // the budget holds less than all that was requested
    bool hasChanged = false;        // pages came or went
};

struct StoreStatistics {
    std::uint64_t residentPages = 0;
    Bytes resident;  // decoded
    Bytes committed; // resident or being loaded, with what is kept beside
    Bytes peak;      // the most that was ever committed
    Bytes read;      // stored bytes of all pages read so far
    std::uint64_t pagesRead = 0;
    std::uint64_t pagesEvicted = 0;
    std::uint64_t pagesDamaged = 0;
};

/// The bytes that a page takes when decoded.
Bytes decodedBytes(const hierarchy::PageInfo& info);

/// The cache. One thread owns it; only that thread calls it. A frame that never waits calls `admitLoaded`, cuts,
/// calls `request` and draws: pages come in `admitLoaded` alone, and those that the last demand used leave nowhere
/// else, so what a frame draws stays where it is until the frame is over. A frame that waits cuts and calls `load` in
/// turns.
class PageStore {
public:
    /// Starts the loaders and reads the pages that hold root groups, with what they hang from, as long as they fit into
    /// half the budget; these stay. Throws Error if one of them is damaged or the page table is not coarsest first.
    /// Here as in `admitLoaded` and `load`, a page that cannot be read throws what its source threw.
    PageStore(const PageSource& source, PageStoreOptions options);
    ~PageStore();
    PageStore(const PageStore&) = delete;
    PageStore& operator=(const PageStore&) = delete;
    PageStore(PageStore&&) = delete;
    PageStore& operator=(PageStore&&) = delete;

    hierarchy::ResidentPages resident() const { return table_; }

    /// Groups of resident pages below a damaged one that a cut must leave unrefined; changes when `resident()` does.
    const hierarchy::BlockedGroups& blocked() const { return blocked_; }

    /// Whether reading `page` has failed.
    bool isDamaged(std::uint32_t page) const { return entries_[page].state == State::Damaged; }

    /// Makes what the loaders finished resident, and evicts pages in use whose room the last demand needs more; never
    /// waits for the disk. True if pages came or went. Throws Error if a page with a root group is damaged.
    bool admitLoaded();

    /// Requests what is most urgent of the loaders and makes room for it, but not of what `demand` uses; never waits.
    /// Throws Error if all pages in demand that hold root groups do not fit the budget.
    DemandOutcome request(const Demand& demand);

    /// Both at once, waiting for all that fits and evicting what the budget has no room for, so that the residency
    /// of what is in demand does not depend on the past. Cut and load in turns until nothing changes.
    DemandOutcome load(const Demand& demand);

    /// Whether pages may be resident without those above them, as a `load` of an open demand leaves them: then a cut is
    /// right only once it wants nothing.
    bool isOpen() const { return isOpen_; }

    /// Takes pages that are resident without one above them, or below a damaged one, from view until those above are
    /// there, so that residency is closed upwards. True if there were any.
    bool close();

    /// Takes `bytes` of the budget for something else than pages, in place of what was taken before, and evicts what
    /// the last `load` does not need; 0 gives all back. Throws Error if that does not fit beside the pages that always
    /// stay.
    void reserve(Bytes bytes);

    /// The bytes of the pages that always stay.
    Bytes pinned() const { return pinned_; }

    /// Makes room beside each resident page for what its owner makes of it, `bytes` of the page (null: nothing), in
    /// place of what there was; it is to go with the page. Evicts what the last `load` does not need; the next takes no
    /// more pages than fit so. Throws Error if the pages that always stay do not.
    void keepBeside(const std::function<Bytes(const hierarchy::PageInfo&)>& bytes);

    const StoreStatistics& statistics() const { return statistics_; }

private:
    /// Where a page is.
    enum class State : std::uint8_t {
        Absent,
        Loading, // queued, being read, or decoded before one of its parents
        Resident,
        Damaged, // could not be read
    };

    /// What keeps a page from being evicted; each is stronger than those before it.
    enum class Retention : std::uint8_t {
        None,
        InUse,  // by what is drawn until `admitLoaded`
        Kept,   // the current demand has room for it
        Pinned, // for good
    };

    /// How sure the current demand is of a page.
    enum class Need : std::uint8_t { None, Foreseen, Certain /* used or wanted, or a parent of such */ };

    /// Everything the store knows of one page besides the table row.
    struct Entry {
        std::unique_ptr<const hierarchy::Page> content;
        std::vector<std::uint32_t> parents;
        Bytes bytes;                    // of the page and what is kept beside it
        std::uint64_t lastUsed = 0;     // the demand that last requested it
        double urgency = 0;             // in the current demand; above 0 only if it is in `requested_`
        std::uint32_t heldChildren = 0; // resident or loading
        bool isRoot = false;            // holds a root group
        State state = State::Absent;
        std::optional<Stopwatch> unreadSince{}; // could not be read then
        Need need = Need::None;
        bool isAsked = false; // by the current demand itself, not as a parent of what it asks for
        Retention retention = Retention::None;

        bool isKept() const { return retention >= Retention::Kept; }
    };

    void link();
    void loadRoots();
    void rank(const Demand& demand);
    void raisePriority(std::uint32_t page, double urgency, Need need);
    void raiseParents();
    Error tooSmall(const std::string& what, Bytes least) const;
    void chooseKept(DemandOutcome& outcome);
    bool keep(Entry& entry, Bytes& total) const;
    void requestKept();
    bool makeRoom(Bytes bytes);
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
    std::exception_ptr leaveOut(const LoadedPage& loaded);
    void admit(LoadedPage loaded);
    void hide(std::uint32_t page);
    void countMissing(const Demand& demand, DemandOutcome& outcome) const;

    const PageSource* source_;
    PageStoreOptions options_;
    std::vector<Entry> entries_;
    std::vector<const hierarchy::Page*> table_;
    std::vector<std::uint32_t> requested_; // by urgency, coarser first; the current demand
    std::vector<std::uint32_t> victims_;   // resident pages that may go, the next one last; the current demand
    bool areVictimsKnown_ = false;
    bool isOpen_ = false;             // residency need not be closed upwards
    bool isUnreadTold_ = false;       // and no page was read since
    std::vector<LoadedPage> waiting_; // decoded before one of their parents
    hierarchy::BlockedGroups blocked_;
    Bytes pinned_;
    Bytes reserved_;
    std::uint64_t clock_ = 0;
    StoreStatistics statistics_;
    Loaders loaders_; // last, so that it stops first
};

} // namespace gnomon::streaming
