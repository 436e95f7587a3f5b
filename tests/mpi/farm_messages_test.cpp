// What processes of a task farm say arrives as it was said, and what is cut short is noticed.
#include "hierarchy/bytes.h"
#include "mpi/farm_messages.h"

#include <gtest/gtest.h>

namespace gnomon::mpi {
namespace {

const TaskBytes kBytes{std::byte{1}, std::byte{0}, std::byte{255}};

TEST(FarmMessages, ComeBack) {
    FarmMember self;
    self.host = "node17";
    self.machine = "a processor";
    self.threads = 48;
    const Greeting greeting = decodedGreeting(encoded(Greeting{self, "model 5"}));
    EXPECT_EQ(greeting.self.host, "node17");
    EXPECT_EQ(greeting.self.machine, "a processor");
    EXPECT_EQ(greeting.self.threads, 48U);
    EXPECT_EQ(greeting.key, "model 5");
    for (const TaskBytes& bytes : {kBytes, TaskBytes()}) {
        const Assignment assignment = decodedAssignment(encoded(Assignment{std::uint64_t{1} << 40U, bytes}));
        EXPECT_EQ(assignment.task, std::uint64_t{1} << 40U);
        EXPECT_EQ(assignment.input, bytes);
        const Outcome outcome = decodedOutcome(encoded(Outcome{7, 0.25, 1U << 20U, 99, bytes}));
        EXPECT_EQ(outcome.task, 7U);
        EXPECT_EQ(outcome.seconds, 0.25);
        EXPECT_EQ(outcome.peakResidentBytes, 1U << 20U);
        EXPECT_EQ(outcome.bytesSent, 99U);
        EXPECT_EQ(outcome.result, bytes);
        for (const bool isTold : {false, true}) {
            const News news = decodedNews(encoded(News{300, isTold, bytes}));
            EXPECT_EQ(news.progress, 300U);
            EXPECT_EQ(news.isTold, isTold);
            EXPECT_EQ(news.told, bytes);
        }
    }
}

/// `bytes` cut anywhere within their first `fixed`, behind which stands what a task says.
template <class Take>
void expectRefused(const TaskBytes& bytes, std::size_t fixed, const Take& take) {
    for (std::size_t size = 0; size < fixed; ++size)
        EXPECT_THROW(take(std::span(bytes).first(size)), hierarchy::Damage) << size << " of " << bytes.size();
}

TEST(FarmMessages, AreRefusedWhereTheyEndTooEarly) {
    FarmMember self;
    self.host = "node17";
    const TaskBytes greeting = encoded(Greeting{self, "key"});
    expectRefused(greeting, greeting.size(), decodedGreeting);
    expectRefused(encoded(Assignment{1000, kBytes}), 2, decodedAssignment);
    expectRefused(encoded(Outcome{1, 2.5, 3, 4, kBytes}), 11, decodedOutcome);
    expectRefused(encoded(News{1, true, kBytes}), 2, decodedNews);
}

} // namespace
} // namespace gnomon::mpi
