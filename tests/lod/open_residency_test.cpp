// What is read for a cut that is drawn only once it is complete: the same cut, of fewer pages; and how residency is
// closed upwards again.
#include "cluster_chains.h"
#include "core/error.h"
#include "fake_source.h"
#include "lod/page_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace gnomon::lod {
namespace {

using lod::Cut;
using lod::CutQuery;
using tests::FakeSource;
using tests::sharedModel;

constexpr double kOfRoots = std::numeric_limits<double>::infinity();

PageStoreOptions partOfAll(std::uint64_t part = 1) {
    PageStoreOptions options;
    options.budget = {0};
    for (const hierarchy::PageInfo& info : sharedModel().table)
        options.budget.count += decodedBytes(info).count;
    options.budget.count /= part;
    return options;
}

bool holdsRoots(std::uint32_t page) {
    return sharedModel().table[page].maxError == kOfRoots;
}

/// A view of the shared model, with casters or without.
class WaitingView {
public:
    explicit WaitingView(Random& random)
        : view_(tests::randomView(random, sharedModel().bounds)),
          casters_(random.below(3) == 0 ? tests::randomCasters(random, view_) : std::vector<lod::CasterDetail>{}),
          rule_(view_, casters_),
          errorPixels_(std::exp(random.uniform(-4, 3))) {
        volumes_.push_back(lod::viewPyramid(view_));
        for (const lod::CasterDetail& caster : casters_)
            volumes_.push_back(caster.casters);
        volumes_.emplace_back(); // all of space
    }

    CutQuery query(hierarchy::ResidentPages resident, bool isOpen) const {
        CutQuery query{&sharedModel().trees, resident, &rule_, errorPixels_, volumes_};
        if (isOpen) query.passable = sharedModel().table;
        return query;
    }

    /// Cuts and loads in turns, as a frame that waits; answers the cut that is drawn.
    Cut loadAll(PageStore& store, bool isOpen) const {
        for (int round = 0; round < 100; ++round) {
            CutQuery query = this->query(store.resident(), isOpen);
            query.blocked = &store.blocked();
            Cut now = lod::cut(query);
            const DemandOutcome outcome = store.load({.used = now.used, .wanted = now.wanted, .isOpen = isOpen});
            const bool hasClosed = isOpen && !store.isOpen();
            isOpen = isOpen && !hasClosed;
            if (!outcome.hasChanged && !hasClosed) return now;
        }
        ADD_FAILURE() << "loading does not come to an end";
        return {};
    }

    /// The cut with every page there.
    Cut whole() const { return lod::cut(query(sharedModel().all, false)); }

    const lod::ErrorRule& rule() const { return rule_; }

    double errorPixels() const { return errorPixels_; }

private:
    lod::DetailView view_;
    std::vector<lod::CasterDetail> casters_;
    lod::ErrorRule rule_;
    double errorPixels_;
    std::vector<ConvexVolume> volumes_;
};

void expectSameLists(const Cut& cut, const Cut& other, int trial) {
    const auto lists = cut.lists.all();
    const auto otherLists = other.lists.all();
    ASSERT_EQ(lists.size(), otherLists.size());
    for (std::size_t v = 0; v < lists.size(); ++v)
        EXPECT_EQ(tests::clustersOf(*lists[v]), tests::clustersOf(*otherLists[v])) << trial << ", volume " << v;
    EXPECT_EQ(cut.achievedErrorPixels, other.achievedErrorPixels) << trial;
}

void expectClosed(const PageStore& store) {
    for (std::uint32_t page = 0; page < store.resident().size(); ++page)
        for (const std::uint32_t child : sharedModel().table[page].children)
            EXPECT_FALSE(store.resident()[page] == nullptr && store.resident()[child] != nullptr) << page;
}

/// Whether `drawn` holds of every chain one cluster, by many of them.
void expectOneOfEachChain(const std::set<tests::ClusterId>& drawn, Random& random) {
    static const tests::Chains chains(sharedModel());
    for (int i = 0; i < 200; ++i) {
        const std::vector<tests::ClusterId> chain = chains.randomChain(random);
        const auto isDrawn = [&](const tests::ClusterId& id) { return drawn.contains(id); };
        EXPECT_EQ(std::count_if(chain.begin(), chain.end(), isDrawn), 1);
    }
}

/// The pages that hold a group which the rule refines, by looking at each.
std::set<std::uint32_t> refinedPages(const WaitingView& viewer) {
    std::set<std::uint32_t> result;
    for (std::uint32_t page = 0; page < sharedModel().all.size(); ++page)
        for (const hierarchy::Group& group : sharedModel().all[page]->groups)
            if (viewer.rule().pixels(group.bounds, tests::largerError(group)) > viewer.errorPixels())
                result.insert(page);
    return result;
}

TEST(OpenResidency, DrawsTheSameAndReadsOnlyWhatIsRefined) {
    Random random(71);
    std::uint64_t open = 0;
    std::uint64_t closed = 0;
    std::size_t passed = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const WaitingView viewer(random);
        const FakeSource source(sharedModel());
        PageStore store(source, partOfAll());
        PageStore whole(source, partOfAll());
        std::set<std::uint32_t> atFirst; // the roots and what they hang from
        for (std::uint32_t page = 0; page < store.resident().size(); ++page)
            if (store.resident()[page] != nullptr) atFirst.insert(page);
        const Cut cut = viewer.loadAll(store, true);
        expectSameLists(cut, viewer.whole(), trial);
        expectSameLists(viewer.loadAll(whole, false), viewer.whole(), trial);
        EXPECT_TRUE(cut.wanted.empty());
        const std::set<std::uint32_t> refined = refinedPages(viewer);
        std::set<std::uint32_t> known(cut.passed.begin(), cut.passed.end());
        for (const hierarchy::PageDemand& used : cut.used)
            known.insert(used.page);
        EXPECT_EQ(known, refined) << trial;
        for (std::uint32_t page = 0; page < store.resident().size(); ++page)
            EXPECT_TRUE(store.resident()[page] == nullptr || atFirst.contains(page) || refined.contains(page)) << page;
        for (const std::uint32_t page : cut.passed)
            EXPECT_TRUE(store.resident()[page] == nullptr && !holdsRoots(page)) << page;
        passed += cut.passed.size();
        open += store.statistics().pagesRead;
        closed += whole.statistics().pagesRead;
    }
    EXPECT_GT(passed, 50U);
    EXPECT_LT(open, closed);
}

TEST(OpenResidency, WhatIsPassedThroughHasNoDrawnCluster) {
    Random random(72);
    std::size_t passed = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const WaitingView viewer(random);
        const CutQuery query = viewer.query(sharedModel().all, true);
        for (std::uint32_t page = 0; page < sharedModel().all.size(); ++page) {
            if (!lod::isSkippable(query, page)) continue;
            ++passed;
            for (const hierarchy::Refinement& finer : sharedModel().all[page]->refinements)
                EXPECT_GT(viewer.rule().pixels(finer.bounds, tests::largerError(finer)), viewer.errorPixels()) << page;
        }
    }
    EXPECT_GT(passed, 200U);
}

TEST(OpenResidency, IsClosedForFramesThatDoNotWait) {
    Random random(74);
    FakeSource source(sharedModel());
    PageStore store(source, partOfAll(2));
    int opened = 0;
    for (int trial = 0; trial < 120; ++trial) {
        const WaitingView viewer(random);
        const bool isOpen = random.below(2) == 0;
        if (isOpen) {
            const Cut cut = viewer.loadAll(store, true);
            opened += store.isOpen() ? 1 : 0;
            if (store.isOpen()) expectSameLists(cut, viewer.whole(), trial);
            if (store.isOpen()) continue;
        } else {
            store.admitLoaded();
            const Cut now = lod::cut(viewer.query(store.resident(), false));
            store.request({.used = now.used, .wanted = now.wanted});
            for (const hierarchy::PageDemand& used : now.used)
                ASSERT_NE(store.resident()[used.page], nullptr) << "a page in use has left";
        }
        expectClosed(store);
        EXPECT_LE(store.statistics().peak, partOfAll(2).budget);
        const std::set<tests::ClusterId> drawn =
            tests::clustersOf(*lod::cut(viewer.query(store.resident(), false)).lists.all().back());
        expectOneOfEachChain(drawn, random);
    }
    EXPECT_GT(opened, 20);
}

TEST(OpenResidency, EndsAsAClosedOneWhereTheBudgetBinds) {
    Random random(75);
    const FakeSource source(sharedModel());
    PageStore walked(source, partOfAll(3));
    int binding = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const WaitingView viewer(random);
        const Cut cut = viewer.loadAll(walked, true);
        PageStore fresh(source, partOfAll(3));
        expectSameLists(cut, viewer.loadAll(fresh, false), trial);
        EXPECT_LE(walked.statistics().peak, partOfAll(3).budget);
        if (walked.isOpen()) continue;
        ++binding;
        expectClosed(walked);
    }
    EXPECT_GT(binding, 5);
    EXPECT_LT(binding, 55);
}

TEST(OpenResidency, BelowADamagedPageTheCutStaysWhole) {
    Random random(76);
    int damaged = 0;
    for (int trial = 0; trial < 30; ++trial) {
        FakeSource source(sharedModel());
        for (int i = 0; i < 3; ++i) {
            const auto page = static_cast<std::uint32_t>(random.below(sharedModel().table.size()));
            if (!holdsRoots(page)) source.damaged.insert(page);
        }
        PageStore store(source, partOfAll());
        for (int view = 0; view < 3; ++view) {
            const WaitingView viewer(random);
            const Cut cut = viewer.loadAll(store, true);
            damaged += store.statistics().pagesDamaged > 0 ? 1 : 0;
            const std::set<tests::ClusterId> drawn = tests::clustersOf(*cut.lists.all().back());
            expectOneOfEachChain(drawn, random);
        }
    }
    EXPECT_GT(damaged, 20);
}

TEST(OpenResidency, DrawsWhatStandsAboveAPageThatDoesNotCome) {
    Random random(77);
    for (int trial = 0; trial < 10; ++trial) {
        FakeSource source(sharedModel());
        PageStoreOptions options = partOfAll();
        options.drawsWithoutUnread = true;
        options.unreadPause = Milliseconds{1e9};
        PageStore store(source, options);
        for (std::uint32_t page = 0; page < sharedModel().table.size(); ++page)
            if (!holdsRoots(page) && random.below(20) == 0) source.unread.insert(page);
        const WaitingView viewer(random);
        const std::set<tests::ClusterId> drawn = tests::clustersOf(*viewer.loadAll(store, true).lists.all().back());
        expectOneOfEachChain(drawn, random);
    }
}

} // namespace
} // namespace gnomon::lod
