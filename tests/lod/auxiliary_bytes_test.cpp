// What is kept beside pages has its room in the budget, and goes when they go.
#include "cluster_chains.h"
#include "core/error.h"
#include "lod/page_store.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <set>

namespace gnomon::lod {
namespace {

using hierarchy::PageDemand;
using tests::sharedModel;

class SharedSource final : public PageSource {
public:
    std::string name() const override { return "shared.gnm"; }

    std::span<const hierarchy::PageInfo> pages() const override { return sharedModel().table; }

    hierarchy::Page readPage(std::uint32_t page) const override { return *sharedModel().all[page]; }
};

constexpr std::uint64_t kTimes = 3; // as much beside a page as the page takes itself

Bytes beside(const hierarchy::PageInfo& page) {
    return {kTimes * decodedBytes(page).count};
}

/// A store that is asked for all there is.
struct FullDemand {
    explicit FullDemand(Bytes budget)
        : store(source, {.budget = budget, .onDamaged = {}, .onEvicted = [this](std::uint32_t page) {
                             EXPECT_TRUE(evicted.insert(page).second);
                         }}) {
        for (std::uint32_t page = 0; page < sharedModel().table.size(); ++page) {
            const double error = sharedModel().table[page].maxError;
            all.push_back({page, error});
        }
    }

    void load() {
        while (store.load({{}, all}).hasChanged) {
        }
    }

    std::uint64_t residentBytes() const {
        std::uint64_t bytes = 0;
        for (std::size_t page = 0; page < all.size(); ++page)
            if (store.resident()[page] != nullptr) bytes += decodedBytes(sharedModel().table[page]).count;
        return bytes;
    }

    SharedSource source;
    std::set<std::uint32_t> evicted;
    PageStore store;
    std::vector<PageDemand> all;
};

std::uint64_t decodedModelBytes() {
    const auto& table = sharedModel().table;
    return std::accumulate(table.begin(), table.end(), std::uint64_t{0}, [](std::uint64_t sum, const auto& page) {
        return sum + decodedBytes(page).count;
    });
}

TEST(AuxiliaryBytes, TakesRoomFromPagesAndGivesItBack) {
    FullDemand demand({decodedModelBytes()});
    demand.load();
    EXPECT_EQ(demand.residentBytes(), decodedModelBytes());
    EXPECT_TRUE(demand.evicted.empty());
    demand.store.reserveAuxiliary(beside);
    demand.load();
    const std::uint64_t kept = demand.residentBytes();
    EXPECT_LE((1 + kTimes) * kept, decodedModelBytes());
    EXPECT_GT((1 + kTimes) * kept, decodedModelBytes() / 2);
    EXPECT_EQ(demand.store.statistics().resident.count, kept);
    EXPECT_EQ(demand.store.statistics().committed.count, (1 + kTimes) * kept);
    for (std::uint32_t page = 0; page < demand.all.size(); ++page)
        EXPECT_EQ(demand.evicted.contains(page), demand.store.resident()[page] == nullptr) << page;
    demand.evicted.clear();
    demand.store.reserveAuxiliary({});
    demand.load();
    EXPECT_EQ(demand.residentBytes(), decodedModelBytes());
    EXPECT_EQ(demand.store.statistics().committed.count, decodedModelBytes());
    EXPECT_TRUE(demand.evicted.empty());
}

// The residency of a demand depends on the demand and on what is kept, not on what was there before.
TEST(AuxiliaryBytes, LeavesTheSamePagesWhateverCameBefore) {
    FullDemand late({decodedModelBytes()});
    late.load();
    late.store.reserveAuxiliary(beside);
    late.load();
    FullDemand early({decodedModelBytes()});
    early.store.reserveAuxiliary(beside);
    early.load();
    for (std::uint32_t page = 0; page < late.all.size(); ++page)
        EXPECT_EQ(late.store.resident()[page] == nullptr, early.store.resident()[page] == nullptr) << page;
}

// Frames that never wait: what the last one drew goes no sooner than the next begins.
TEST(AuxiliaryBytes, EvictsWhenTheNextFrameBegins) {
    FullDemand demand({decodedModelBytes()});
    demand.load();
    std::vector<PageDemand> used = demand.all;
    demand.store.request({used, {}});
    demand.store.reserveAuxiliary(beside);
    EXPECT_EQ(demand.residentBytes(), decodedModelBytes());
    demand.store.admitLoaded();
    for (int frame = 0; frame < 3; ++frame) {
        std::erase_if(used, [&](const PageDemand& page) { return demand.store.resident()[page.page] == nullptr; });
        demand.store.request({used, {}});
        demand.store.admitLoaded();
    }
    EXPECT_LE(demand.store.statistics().committed.count, decodedModelBytes());
    EXPECT_GT(demand.residentBytes(), 0U);
}

TEST(AuxiliaryBytes, MustFitBesideWhatAlwaysStays) {
    FullDemand demand({decodedModelBytes()});
    const auto whole = [](const hierarchy::PageInfo&) { return Bytes{decodedModelBytes()}; };
    EXPECT_THROW(demand.store.reserveAuxiliary(whole), Error);
}

} // namespace
} // namespace gnomon::lod
