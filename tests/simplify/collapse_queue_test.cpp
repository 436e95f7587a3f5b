// The queue of collapses against an ordered set.
#include "core/random.h"
#include "preprocess/simplify/collapse_queue.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

namespace gnomon::simplify {
namespace {

/// A queue and its twin, put through the same changes.
class BothQueues {
public:
    explicit BothQueues(std::uint32_t vertices) : vertices_(vertices), queue_(vertices) {}

    /// Costs are few, so that many are equal.
    void change(Random& random) {
        const auto vertex = static_cast<std::uint32_t>(random.below(vertices_));
        const auto cost = static_cast<double>(random.below(8));
        switch (random.below(4)) {
        case 0:
            take();
            break;
        case 1:
            queue_.remove(vertex);
            forget(vertex);
            break;
        default:
            queue_.put(vertex, cost);
            forget(vertex);
            order_.emplace(cost, vertex);
            costs_[vertex] = cost;
        }
    }

    /// Every other vertex at once, in place of all that there was.
    void putAll(Random& random) {
        std::vector<double> costs(vertices_, std::numeric_limits<double>::infinity());
        order_.clear();
        costs_.clear();
        for (std::uint32_t vertex = 0; vertex < vertices_; ++vertex) {
            if (random.below(2) == 0) continue;
            costs[vertex] = costs_[vertex] = static_cast<double>(random.below(8));
            order_.emplace(costs[vertex], vertex);
        }
        queue_.putAll(costs);
    }

    void expectSame() const {
        ASSERT_EQ(queue_.isEmpty(), order_.empty());
        if (!order_.empty()) {
            EXPECT_EQ(queue_.minCost(), order_.begin()->first);
        }
        for (std::uint32_t vertex = 0; vertex < vertices_; ++vertex) {
            const auto found = costs_.find(vertex);
            ASSERT_EQ(queue_.contains(vertex), found != costs_.end());
            if (found != costs_.end()) {
                EXPECT_EQ(queue_.costOf(vertex), found->second);
            }
        }
    }

    void empty() {
        while (!order_.empty())
            take();
        EXPECT_TRUE(queue_.isEmpty());
    }

private:
    void take() {
        if (order_.empty()) return;
        const std::uint32_t first = order_.begin()->second;
        EXPECT_EQ(queue_.pop(), first);
        forget(first);
    }

    void forget(std::uint32_t vertex) {
        const auto found = costs_.find(vertex);
        if (found == costs_.end()) return;
        order_.erase({found->second, vertex});
        costs_.erase(found);
    }

    std::uint32_t vertices_;
    CollapseQueue queue_;
    std::set<std::pair<double, std::uint32_t>> order_;
    std::map<std::uint32_t, double> costs_;
};

TEST(CollapseQueue, GivesTheCheapestAndOfEqualOnesTheFirstWhateverChanges) {
    for (const std::uint32_t vertices : {1U, 2U, 3U, 8U, 9U, 100U}) {
        Random random(vertices);
        BothQueues both(vertices);
        for (int step = 0; step < 1000; ++step) {
            if (step % 100 == 50) both.putAll(random);
            both.change(random);
            both.expectSame();
        }
        both.empty();
    }
}

} // namespace
} // namespace gnomon::simplify
