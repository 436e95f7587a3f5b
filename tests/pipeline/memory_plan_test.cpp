#include "core/random.h"
#include "preprocess/pipeline/memory_plan.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

TEST(MemoryPlan, BordersAreSharedInAnyRoomThatHoldsAChunk) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) {
        const Bytes chunk = MemoryNeeds::borders({random.below(2'000'000), 1 + random.below(3'000'000)});
        const Bytes room = {chunk.count + (random.below(4) == 0 ? 0 : random.below(3 * chunk.count))};
        const std::size_t threads = 1 + random.below(16);
        const BorderShare share = borderShare(room, chunk, threads);
        ASSERT_GE(share.chunksAtOnce, 1U);
        ASSERT_LE(share.chunksAtOnce, threads + 1);
        ASSERT_LE(share.blocks.count + share.chunksAtOnce * chunk.count, room.count);
    }
}

} // namespace
} // namespace gnomon::pipeline
