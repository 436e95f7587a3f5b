// Letters between processes arrive as they were written, and damaged ones are noticed.
#include "preprocess/distributed/messages.h"

#include <gtest/gtest.h>

namespace gnomon::distributed {
namespace {

template <class Take>
void expectExact(const std::vector<std::byte>& bytes, const Take& take) {
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(take(std::span(bytes).first(size)), hierarchy::Damage) << size << " of " << bytes.size();
    std::vector<std::byte> longer = bytes;
    longer.push_back(std::byte{0});
    EXPECT_THROW(take(longer), hierarchy::Damage);
}

TEST(Messages, ComeBack) {
    const Hello hello = decodedHello(encoded(Hello{"node17", 48, "format 3, input 1 bytes 5"}));
    EXPECT_EQ(hello.host, "node17");
    EXPECT_EQ(hello.threads, 48U);
    EXPECT_EQ(hello.key, "format 3, input 1 bytes 5");
    const Farewell farewell = decodedFarewell(encoded(Farewell{std::uint64_t{1} << 40U, 99, 7}));
    EXPECT_EQ(farewell.peakResidentBytes, std::uint64_t{1} << 40U);
    EXPECT_EQ(farewell.tableBytes, 99U);
    EXPECT_EQ(farewell.bytesSent, 7U);
    EXPECT_EQ(decodedText(encoded(std::string("the disk is full"))), "the disk is full");
    const Assignment assignment =
        decodedAssignment(encoded(Assignment{pipeline::TaskKind::ShareLocks, 0xFFFFFFFF, {std::byte{4}}}));
    EXPECT_EQ(assignment.kind, pipeline::TaskKind::ShareLocks);
    EXPECT_EQ(assignment.task, 0xFFFFFFFFU);
    EXPECT_EQ(assignment.input, std::vector<std::byte>{std::byte{4}});
}

TEST(Messages, OutcomesAndBeginningsComeBackOrAreRefused) {
    Outcome outcome{12, 0.25, 300, 1ULL << 33U, 1ULL << 34U, {std::byte{1}, std::byte{2}}};
    const Outcome back = decodedOutcome(encoded(outcome));
    EXPECT_EQ(back.task, 12U);
    EXPECT_EQ(back.seconds, 0.25);
    EXPECT_EQ(back.progress, 300U);
    EXPECT_EQ(back.bytesRead, 1ULL << 33U);
    EXPECT_EQ(back.bytesWritten, 1ULL << 34U);
    EXPECT_EQ(back.result, outcome.result);
    expectExact(encoded(outcome), decodedOutcome);
    Beginning beginning;
    beginning.place = {"folder/scratch.", 33};
    const Beginning begun = decodedBeginning(encoded(beginning));
    EXPECT_EQ(begun.place.stem, "folder/scratch.");
    EXPECT_EQ(begun.place.firstPart, 33U);
    expectExact(encoded(beginning), decodedBeginning);
}

} // namespace
} // namespace gnomon::distributed
