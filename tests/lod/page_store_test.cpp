// The cache keeps its budget, stays closed upwards, survives damage and gives the same residency twice.
#include "cluster_chains.h"
#include "core/error.h"
#include "fake_source.h"
#include "hierarchy/residency.h"
#include "hierarchy/validation.h"
#include "lod/page_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <numeric>
#include <set>
#include <thread>

namespace gnomon::lod {
namespace {

using hierarchy::PageDemand;
using tests::FakeSource;
using tests::sharedModel;

Bytes wholeModel() {
    Bytes total;
    for (const hierarchy::PageInfo& info : sharedModel().table)
        total.count += decodedBytes(info).count;
    return total;
}

PageStoreOptions withBudget(Bytes budget, unsigned threads = 4) {
    PageStoreOptions options;
    options.budget = budget;
    options.loaderThreads = threads;
    return options;
}

void expectAncestorComplete(hierarchy::ResidentPages resident, const std::set<std::uint32_t>& damaged = {}) {
    const std::vector<hierarchy::PageInfo>& table = sharedModel().table;
    for (std::size_t page = 0; page < resident.size(); ++page)
        for (const std::uint32_t child : table[page].children)
            EXPECT_FALSE(
                resident[page] == nullptr && resident[child] != nullptr &&
                !damaged.contains(static_cast<std::uint32_t>(page)))
                << page << " lacks under " << child;
}

void expectWithinBudget(const PageStore& store, Bytes budget) {
    Bytes resident;
    for (std::size_t page = 0; page < store.resident().size(); ++page)
        if (store.resident()[page] != nullptr) resident.count += decodedBytes(sharedModel().table[page]).count;
    EXPECT_EQ(store.statistics().resident, resident);
    EXPECT_LE(store.statistics().resident, store.statistics().committed);
    EXPECT_LE(store.statistics().peak, budget);
}

std::set<std::uint32_t> residentSet(const PageStore& store) {
    std::set<std::uint32_t> result;
    for (std::uint32_t page = 0; page < store.resident().size(); ++page)
        if (store.resident()[page] != nullptr) result.insert(page);
    return result;
}

/// A view of the shared model that asks a store for its pages.
class Viewer {
public:
    explicit Viewer(Random& random)
        : view_(tests::randomView(random, sharedModel().bounds)),
          rule_(view_),
          errorPixels_(std::exp(random.uniform(-4, 3))) {
        volumes_.push_back(lod::viewPyramid(view_));
    }

    lod::Cut cut(const PageStore& store) const {
        return lod::cut({&sharedModel().trees, store.resident(), &rule_, errorPixels_, volumes_, &store.blocked()});
    }

    /// The same cut over all of space, so that nothing is culled away.
    lod::Cut cutEverywhere(const PageStore& store) const {
        const std::vector<ConvexVolume> everywhere(1);
        return lod::cut({&sharedModel().trees, store.resident(), &rule_, errorPixels_, everywhere, &store.blocked()});
    }

    DemandOutcome loadAll(PageStore& store) const {
        for (int round = 0; round < 100; ++round) {
            const lod::Cut now = cut(store);
            const DemandOutcome outcome = store.load({now.used, now.wanted});
            if (!outcome.hasChanged) return outcome;
        }
        ADD_FAILURE() << "loading does not come to an end";
        return {};
    }

private:
    lod::DetailView view_;
    lod::ErrorRule rule_;
    double errorPixels_;
    std::vector<ConvexVolume> volumes_;
};

TEST(PageStore, LoadsWhatAViewWants) {
    Random random(41);
    const FakeSource source(sharedModel());
    PageStore store(source, withBudget(wholeModel()));
    std::size_t max = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const Viewer viewer(random);
        const DemandOutcome outcome = viewer.loadAll(store);
        EXPECT_EQ(outcome.pagesMissing, 0U);
        EXPECT_FALSE(outcome.isBudgetBinding);
        EXPECT_TRUE(viewer.cut(store).wanted.empty());
        expectAncestorComplete(store.resident());
        expectWithinBudget(store, wholeModel());
        max = std::max(max, residentSet(store).size());
    }
    EXPECT_GT(max, 50U);
    EXPECT_EQ(store.statistics().pagesEvicted, 0U) << "all fits";
    EXPECT_EQ(source.reads, static_cast<int>(store.statistics().pagesRead)) << "nothing is read twice";
}

TEST(PageStore, KeepsATinyBudgetAndRepeatsItself) {
    Random random(42);
    const FakeSource source(sharedModel());
    const Bytes budget{wholeModel().count / 3};
    PageStore walked(source, withBudget(budget));
    int binding = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Viewer viewer(random);
        const DemandOutcome outcome = viewer.loadAll(walked);
        binding += outcome.isBudgetBinding ? 1 : 0;
        expectAncestorComplete(walked.resident());
        expectWithinBudget(walked, budget);
        // A store that has seen nothing else ends with the same cut.
        PageStore fresh(source, withBudget(budget));
        viewer.loadAll(fresh);
        EXPECT_EQ(viewer.cut(walked).lists.image.ranges, viewer.cut(fresh).lists.image.ranges) << trial;
        EXPECT_EQ(viewer.cut(walked).achievedErrorPixels, viewer.cut(fresh).achievedErrorPixels);
    }
    EXPECT_GT(binding, 5);
    EXPECT_GT(walked.statistics().pagesEvicted, 100U);
}

TEST(PageStore, AskNeverWaitsAndArrivesInTheEnd) {
    Random random(43);
    FakeSource source(sharedModel());
    const Bytes budget{wholeModel().count / 4};
    PageStore store(source, withBudget(budget));
    source.delay = std::chrono::microseconds(300);
    for (int trial = 0; trial < 10; ++trial) {
        const Viewer viewer(random);
        int frames = 0;
        while (true) {
            store.admitLoaded();
            const lod::Cut now = viewer.cut(store);
            const DemandOutcome outcome = store.request({now.used, now.wanted});
            for (const PageDemand& used : now.used)
                ASSERT_NE(store.resident()[used.page], nullptr) << "a page in use has left";
            expectAncestorComplete(store.resident());
            expectWithinBudget(store, budget);
            if (now.wanted.empty() && outcome.pagesMissing == 0) break;
            if (outcome.isBudgetBinding && frames > 200) break;
            ASSERT_LT(++frames, 5000) << "pages never arrive";
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
    }
}

TEST(PageStore, AViewThatChangesEveryFrameNeverBreaksTheRules) {
    Random random(44);
    FakeSource source(sharedModel());
    const Bytes budget{wholeModel().count / 8};
    PageStore store(source, withBudget(budget));
    source.delay = std::chrono::microseconds(50);
    const std::vector<PageDemand> none;
    for (int frame = 0; frame < 150; ++frame) {
        const Viewer viewer(random);
        const Viewer ahead(random);
        store.admitLoaded();
        const lod::Cut now = viewer.cut(store);
        const lod::Cut next = ahead.cut(store);
        if (random.below(10) == 0) {
            store.load({now.used, now.wanted});
        } else {
            const bool isCertain = random.below(2) == 0;
            store.request({now.used, now.wanted, isCertain ? next.wanted : none, isCertain ? none : next.wanted});
            for (const PageDemand& used : now.used)
                ASSERT_NE(store.resident()[used.page], nullptr) << "a page in use has left";
        }
        expectAncestorComplete(store.resident());
        expectWithinBudget(store, budget);
    }
    EXPECT_GT(store.statistics().pagesEvicted, 10U);
}

TEST(PageStore, PrefetchOnlyFillsWhatIsLeft) {
    Random random(45);
    const FakeSource source(sharedModel());
    const Bytes budget{wholeModel().count / 6};
    for (int trial = 0; trial < 20; ++trial) {
        PageStore store(source, withBudget(budget));
        const Viewer viewer(random);
        const Viewer ahead(random);
        viewer.loadAll(store);
        const std::set<std::uint32_t> before = residentSet(store);
        const lod::Cut now = viewer.cut(store);
        const std::vector<PageDemand> next = ahead.cut(store).wanted;
        std::vector<PageDemand> prefetchSet = next;
        for (PageDemand& page : prefetchSet)
            page.pixels = 1e-9;
        store.load({now.used, now.wanted, prefetchSet, next});
        const std::set<std::uint32_t> after = residentSet(store);
        for (const PageDemand& used : now.used)
            EXPECT_TRUE(after.contains(used.page)) << "prefetch took the place of a page in use";
    }
}

TEST(PageStore, ADamagedPageIsNamedOnceAndNeverWantedAgain) {
    Random random(46);
    FakeSource source(sharedModel());
    const std::vector<hierarchy::PageInfo>& table = sharedModel().table;
    for (std::uint32_t page = 0; page < table.size(); ++page)
        if (table[page].maxError < std::numeric_limits<double>::infinity() && random.below(4) == 0)
            source.damaged.insert(page);
    std::vector<std::uint32_t> named;
    PageStoreOptions options = withBudget(wholeModel());
    options.onDamaged = [&](const DamagedPage& damaged) {
        named.push_back(damaged.page);
        EXPECT_NE(damaged.reason.find("fake.gnm: byte"), std::string::npos);
    };
    PageStore store(source, options);
    for (int trial = 0; trial < 20; ++trial) {
        const Viewer viewer(random);
        const DemandOutcome outcome = viewer.loadAll(store);
        EXPECT_EQ(outcome.pagesMissing, 0U) << "all that can be loaded is loaded";
        EXPECT_FALSE(viewer.cut(store).used.empty());
        expectAncestorComplete(store.resident(), source.damaged);
    }
    EXPECT_GT(named.size(), 3U);
    EXPECT_EQ(named.size(), store.statistics().pagesDamaged);
    EXPECT_EQ(std::set<std::uint32_t>(named.begin(), named.end()).size(), named.size());
    for (const std::uint32_t page : named)
        EXPECT_TRUE(source.damaged.contains(page));
}

TEST(PageStore, BelowADamagedPageTheCutStaysWholeAndElsewhereItIsRight) {
    Random random(48);
    const tests::Chains chains(sharedModel());
    const std::vector<hierarchy::PageInfo>& table = sharedModel().table;
    double kept = 0;
    constexpr int kTrials = 20;
    for (int trial = 0; trial < kTrials; ++trial) {
        FakeSource source(sharedModel());
        for (int i = 0; i < 3; ++i) {
            const auto page = static_cast<std::uint32_t>(random.below(table.size()));
            if (table[page].maxError < std::numeric_limits<double>::infinity()) source.damaged.insert(page);
        }
        PageStore store(source, withBudget(wholeModel()));
        const Viewer viewer(random);
        viewer.loadAll(store);
        const std::set<tests::ClusterId> drawn = tests::clustersOf(viewer.cutEverywhere(store).lists.image);
        for (int i = 0; i < 500; ++i) {
            const std::vector<tests::ClusterId> chain = chains.randomChain(random);
            const auto count = std::count_if(
                chain.begin(), chain.end(), [&](const tests::ClusterId& id) { return drawn.contains(id); });
            EXPECT_EQ(count, 1) << "trial " << trial;
        }
        FakeSource soundSource(sharedModel());
        PageStore sound(soundSource, withBudget(wholeModel()));
        viewer.loadAll(sound);
        const std::set<tests::ClusterId> right = tests::clustersOf(viewer.cutEverywhere(sound).lists.image);
        const auto same =
            std::count_if(right.begin(), right.end(), [&](const tests::ClusterId& id) { return drawn.contains(id); });
        kept += static_cast<double>(same) / static_cast<double>(right.size()) / kTrials;
    }
    EXPECT_GT(kept, 0.7) << "three damaged pages of a thousand may not spoil the rest";
}

TEST(PageStore, APageThatCannotBeReadIsAnErrorAndNoDamage) {
    Random random(49);
    FakeSource source(sharedModel());
    PageStore store(source, withBudget(wholeModel()));
    const std::vector<hierarchy::PageInfo>& table = sharedModel().table;
    for (std::uint32_t page = 0; page < table.size(); ++page)
        if (table[page].maxError < std::numeric_limits<double>::infinity()) source.unread.insert(page);
    const Viewer viewer(random);
    EXPECT_THROW(viewer.loadAll(store), Error);
    EXPECT_EQ(store.statistics().pagesDamaged, 0U);
    source.unread.clear();
    source.hasNoMemory = true;
    EXPECT_THROW(viewer.loadAll(store), std::bad_alloc);
    source.hasNoMemory = false;
    EXPECT_EQ(viewer.loadAll(store).pagesMissing, 0U) << "what failed before is read when it can be";
    EXPECT_EQ(store.statistics().pagesDamaged, 0U);
    expectWithinBudget(store, wholeModel());
}

TEST(PageStore, AWindowDrawsOnWithoutAPageThatCannotBeRead) {
    Random random(50);
    FakeSource source(sharedModel());
    const auto last = static_cast<std::uint32_t>(sharedModel().table.size() - 1);
    source.unread.insert(last);
    std::vector<DamagedPage> named;
    PageStoreOptions options = withBudget(wholeModel());
    options.drawsWithoutUnread = true;
    options.onDamaged = [&](const DamagedPage& page) { named.push_back(page); };
    PageStore store(source, options);
    const std::vector<PageDemand> wanted{{last, 1}};
    store.load({{}, wanted});
    ASSERT_EQ(named.size(), 1U);
    EXPECT_EQ(named[0].page, last);
    EXPECT_TRUE(named[0].isUnread);
    EXPECT_NE(named[0].reason.find("cannot read"), std::string::npos);
}

/// A server's page that did not come, what hangs from it, and the pause before it is asked for again.
TEST(PageStore, APageThatDoesNotComeIsMissingAndAskedForAgain) {
    FakeSource source(sharedModel());
    const auto& table = sharedModel().table;
    const auto last = static_cast<std::uint32_t>(table.size() - 1);
    std::vector<DamagedPage> named;
    PageStoreOptions options = withBudget(wholeModel());
    options.drawsWithoutUnread = true;
    options.unreadPause = Milliseconds{0};
    options.onDamaged = [&](const DamagedPage& page) { named.push_back(page); };
    PageStore store(source, options);
    const std::set<std::uint32_t> roots = residentSet(store);
    for (std::uint32_t page = 0; page < table.size(); ++page)
        if (!roots.contains(page)) source.unread.insert(page);
    const std::vector<PageDemand> wanted{{last, 1}};
    for (int again = 0; again < 3; ++again) {
        const int reads = source.reads;
        EXPECT_EQ(store.load({{}, wanted}).pagesMissing, 1U);
        EXPECT_GT(source.reads, reads);
        EXPECT_EQ(residentSet(store), roots);
        expectWithinBudget(store, wholeModel());
    }
    ASSERT_EQ(named.size(), 1U) << "of a server that is away it is told once";
    EXPECT_TRUE(named[0].isRetried && named[0].isUnread);
    // A parent that fails while its children come keeps neither them nor their room.
    source.unread.erase(last);
    EXPECT_EQ(store.load({{}, wanted}).pagesMissing, 1U);
    EXPECT_EQ(residentSet(store), roots);
    EXPECT_EQ(store.statistics().committed, store.statistics().resident);
    source.unread.clear();
    EXPECT_EQ(store.load({{}, wanted}).pagesMissing, 0U);
    EXPECT_EQ(store.statistics().pagesDamaged, 0U);
    expectAncestorComplete(store.resident());

    options.unreadPause = Milliseconds{1e9};
    PageStore patient(source, options);
    source.unread.insert(last);
    patient.load({{}, wanted});
    const int reads = source.reads;
    patient.load({{}, wanted});
    EXPECT_EQ(source.reads, reads);
}

TEST(PageStore, ADamagedRootIsAnError) {
    FakeSource source(sharedModel());
    source.damaged.insert(0);
    EXPECT_THROW(PageStore(source, withBudget(wholeModel())), Error);
}

TEST(PageStore, ABudgetBelowTheCoarsestLevelIsAnError) {
    Random random(47);
    const FakeSource source(sharedModel());
    PageStore store(source, withBudget({100}));
    EXPECT_EQ(store.statistics().committed.count, 0U);
    const std::vector<PageDemand> root{{0, std::numeric_limits<double>::infinity()}};
    EXPECT_THROW(store.load({{}, root}), Error);
}

TEST(PageStore, EndsCleanlyWithWorkInTheQueue) {
    FakeSource source(sharedModel());
    for (int trial = 0; trial < 20; ++trial) {
        PageStore store(source, withBudget(wholeModel(), 4));
        source.isHeld = true;
        std::vector<PageDemand> everything;
        for (std::uint32_t page = 0; page < sharedModel().table.size(); ++page)
            everything.push_back({page, 1});
        const int before = source.reads;
        store.request({{}, everything});
        store.request({}); // withdraws what no loader has begun
        EXPECT_LE(source.reads - before, 4);
        source.isHeld = false;
        source.isHeld.notify_all();
    }
}

} // namespace
} // namespace gnomon::lod
