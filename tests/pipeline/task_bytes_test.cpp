// What travels between the processes of a build arrives as it was, and nothing else is taken for it.
#include "core/random.h"
#include "preprocess/pipeline/tasks/task.h"
#include "preprocess/pipeline/tasks/task_bytes.h"

#include <gtest/gtest.h>

#include <mutex>
#include <set>

namespace gnomon::pipeline {
namespace {

Blocks someBlocks(Random& random) {
    Blocks blocks(random.below(4));
    for (scratch::Block& block : blocks)
        block = {random.bits(), random.below(1'000'000), random.bits()};
    return blocks;
}

Mail someMail(Random& random) {
    Mail mail;
    for (const scratch::Block& block : someBlocks(random))
        mail.emplace_back(static_cast<std::uint32_t>(random.below(1'000'000)), block);
    return mail;
}

ChunkStreams someChunk(Random& random) {
    ChunkStreams streams;
    for (Blocks& blocks : streams.bins)
        blocks = someBlocks(random);
    for (Blocks& blocks : streams.borders)
        blocks = someBlocks(random);
    return streams;
}

bool same(const Blocks& a, const Blocks& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
        return one.offset == other.offset && one.bytes == other.bytes && one.checksum == other.checksum;
    });
}

/// That bytes end early or go on is noticed.
template <class Take>
void expectExact(const std::vector<std::byte>& bytes, const Take& take) {
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(take(std::span(bytes).first(size)), hierarchy::Damage) << size << " of " << bytes.size();
    std::vector<std::byte> longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_THROW(take(longer), hierarchy::Damage);
}

TEST(TaskBytes, RangesOfPagesComeBack) {
    Random random(3);
    const PageRange range{"/a/m.gnm.17.partial", "m.gnm", 0x1234567890, someBlocks(random)};
    const std::vector<std::byte> bytes = encoded(range);
    const auto take = [](std::span<const std::byte> from) {
        hierarchy::ByteReader in(from);
        return takePageRange(in);
    };
    const PageRange back = take(bytes);
    EXPECT_EQ(back.path, range.path);
    EXPECT_EQ(back.displayPath, range.displayPath);
    EXPECT_EQ(back.offset, range.offset);
    EXPECT_TRUE(same(back.pages, range.pages));
    expectExact(bytes, take);
}

TEST(TaskBytes, FactsComeBack) {
    TaskFacts facts{{{1.5, -2e9, 1e-7}, -33}, {}};
    facts.format.isDouble = true;
    facts.format.hasColors = true;
    facts.format.fields = hierarchy::FieldLayout::of(3);
    const std::vector<std::byte> bytes = encoded(facts);
    const TaskFacts back = decodedFacts(bytes);
    EXPECT_EQ(back.grid.origin, facts.grid.origin);
    EXPECT_EQ(back.grid.stepExponent, -33);
    EXPECT_TRUE(back.format.isDouble && back.format.hasColors);
    EXPECT_FALSE(back.format.hasNormals);
    EXPECT_EQ(back.format.fields.bits, facts.format.fields.bits);
    expectExact(bytes, [](std::span<const std::byte> some) { return decodedFacts(some); });
}

TEST(TaskBytes, InputsComeBack) {
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        NodeInput node;
        node.round = static_cast<std::uint32_t>(random.below(9));
        node.node = static_cast<std::uint32_t>(random.bits());
        node.firstLevel = static_cast<std::uint32_t>(random.below(40));
        node.isLast = random.below(2) == 0;
        node.chunk = someChunk(random);
        node.sums = {random.bits(), random.bits(), random.bits()};
        node.records = someBlocks(random);
        node.locks = someBlocks(random);
        const auto take = [](std::span<const std::byte> bytes) {
            hierarchy::ByteReader in(bytes);
            return takeNode(in);
        };
        const std::vector<std::byte> bytes = encoded(node);
        const NodeInput back = take(bytes);
        EXPECT_EQ(encoded(back), bytes);
        EXPECT_EQ(back.node, node.node);
        EXPECT_EQ(back.isLast, node.isLast);
        EXPECT_EQ(back.sums.vertices, node.sums.vertices);
        EXPECT_TRUE(same(back.chunk.bins[1], node.chunk.bins[1]));
        EXPECT_TRUE(same(back.chunk.borders[1], node.chunk.borders[1]));
        EXPECT_TRUE(same(back.records, node.records) && same(back.locks, node.locks));
        expectExact(bytes, take);
    }
}

TEST(TaskBytes, RoutesAndMailComeBack) {
    Random random(2);
    const RouteInput route{{{random.bits(), 77, random.bits()}}, 5, 6, {1, 0xFFFFFFFF}, {0, 3, 200}};
    const auto take = [](std::span<const std::byte> bytes) {
        hierarchy::ByteReader in(bytes);
        return takeRoute(in);
    };
    const RouteInput back = take(encoded(route));
    EXPECT_TRUE(same(back.left, route.left));
    EXPECT_EQ(back.firstLevel, 5U);
    EXPECT_EQ(back.borderStreams, 6U);
    EXPECT_EQ(back.firstPages, route.firstPages);
    EXPECT_EQ(back.nodeOf, route.nodeOf);
    expectExact(encoded(route), take);
    const RoutedMail mail{someMail(random), someMail(random), someMail(random), {8, 9}};
    const RoutedMail mailBack = decodedRoutedMail(encoded(mail));
    EXPECT_EQ(encoded(mailBack), encoded(mail));
    EXPECT_EQ(mailBack.counts.lockedBefore, 9U);
    expectExact(encoded(mail), decodedRoutedMail);
}

TaskPhase someTasks() {
    TaskPhase phase;
    for (std::uint32_t task = 3; task < 200; task += 2)
        phase.tasks.push_back(task);
    phase.atOnce = 3;
    phase.input = [](std::uint32_t task) { return std::vector<std::byte>(task); };
    return phase;
}

TEST(LocalTasks, RunsEachTaskOnceAndTakesOneAtATime) {
    TaskPhase phase = someTasks();
    std::set<std::uint32_t> taken;
    std::mutex one;
    phase.take = [&](std::uint32_t task, std::span<const std::byte> result) {
        EXPECT_TRUE(one.try_lock());
        EXPECT_EQ(result.size(), 2 * task);
        EXPECT_TRUE(taken.insert(task).second);
        one.unlock();
    };
    LocalTasks().run(
        phase, [](TaskKind, std::span<const std::byte> input) { return std::vector<std::byte>(2 * input.size()); });
    EXPECT_EQ(taken.size(), phase.tasks.size());
}

TEST(LocalTasks, ThrowsWhatATaskThrows) {
    TaskPhase phase = someTasks();
    phase.take = [](std::uint32_t, std::span<const std::byte>) {};
    const Perform fails = [](TaskKind, std::span<const std::byte>) -> std::vector<std::byte> {
        throw hierarchy::Damage{"of a task"};
    };
    EXPECT_THROW(LocalTasks().run(phase, fails), hierarchy::Damage);
}

} // namespace
} // namespace gnomon::pipeline
