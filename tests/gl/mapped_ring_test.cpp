// A ring gives every reader what was put in for it, however often it went round, and counts GPU time on the way.
#include "gl/context.h"
#include "gl/gpu_timer.h"
#include "gl/mapped_ring.h"
#include "tests/support/counted_calls.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::gl {
namespace {

TEST(MappedRing, GivesEveryCopyItsOwnBytesOverManyRounds) {
    const Context context(std::make_unique<CountedContext>());
    MappedRing ring(context.api(), 1000); // rounded up to 1024
    EXPECT_EQ(ring.segmentBytes(), 1024U);
    constexpr std::size_t kPieces = 64;
    constexpr std::size_t kBytes = 300;
    const Buffer out(context.api(), kPieces * kBytes);
    for (std::size_t i = 0; i < kPieces; ++i) {
        const RingPiece piece = ring.take(kBytes);
        EXPECT_EQ(piece.offset % 256, 0U);
        EXPECT_EQ(piece.offset / 1024, (piece.offset + kBytes - 1) / 1024) << "within one segment";
        std::fill(piece.bytes.begin(), piece.bytes.end(), static_cast<std::byte>(i + 1));
        out.copy(i * kBytes, ring.id(), piece.offset, kBytes);
    }
    // Two pieces a segment: 31 times one was left, and from the second time on its reuse was waited for.
    EXPECT_EQ(calls(counted::Name::fenceSync), 31U);
    EXPECT_EQ(calls(counted::Name::clientWaitSync), 30U);
    EXPECT_EQ(calls(counted::Name::finish), 0U);
    const Buffer read(context.api(), kPieces * kBytes);
    MappedRing check(context.api(), kPieces * kBytes);
    const RingPiece all = check.take(kPieces * kBytes);
    context.api().copyNamedBufferSubData(
        out.id(), check.id(), 0, static_cast<GLintptr>(all.offset), static_cast<GLsizeiptr>(all.bytes.size()));
    context.api().finish();
    for (std::size_t i = 0; i < all.bytes.size(); ++i)
        ASSERT_EQ(all.bytes[i], static_cast<std::byte>(i / kBytes + 1)) << i;
    context.check("ring");
}

TEST(MappedRing, PiecesThatMayStillBeReadAreApart) {
    const Context context(testedPlatform());
    MappedRing ring(context.api(), 1024);
    std::set<std::size_t> offsets;
    for (int i = 0; i < 12; ++i) // three segments of four
        EXPECT_TRUE(offsets.insert(ring.take(256).offset).second);
    EXPECT_EQ(ring.take(256).offset, 0U) << "and round again";
}

TEST(MappedRingDeathTest, HasNoPieceLargerThanASegment) {
    const Context context(testedPlatform());
    MappedRing ring(context.api(), 1024);
    EXPECT_DEATH(ring.take(1025), "1025");
}

TEST(GpuTimer, KnowsTheLastPassThatIsDone) {
    const Context context(testedPlatform());
    GpuTimer timer(context.api());
    EXPECT_EQ(timer.latest().count, 0);
    for (int pass = 0; pass < 9; ++pass) { // more than it keeps
        timer.begin();
        timer.end();
        EXPECT_GE(timer.finished().count, 0);
        EXPECT_EQ(timer.latest(), timer.finished());
    }
    context.check("timer");
}

} // namespace
} // namespace gnomon::gl
