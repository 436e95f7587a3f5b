#include "mpi/farm_messages.h"

#include "hierarchy/bytes.h"

namespace gnomon::mpi {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

/// What is left of a message.
TaskBytes takeRest(ByteReader& in) {
    const std::span<const std::byte> rest = in.take(in.remaining());
    return {rest.begin(), rest.end()};
}

} // namespace

TaskBytes encoded(const Greeting& greeting) {
    ByteWriter out;
    out.putText(greeting.self.host);
    out.putText(greeting.self.machine);
    out.putVarint(greeting.self.threads);
    out.putText(greeting.key);
    return out.take();
}

Greeting decodedGreeting(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Greeting greeting;
    greeting.self.host = in.takeText();
    greeting.self.machine = in.takeText();
    greeting.self.threads = static_cast<std::uint32_t>(in.takeVarint());
    greeting.key = in.takeText();
    in.expectEnd();
    return greeting;
}

TaskBytes encoded(const Assignment& assignment) {
    ByteWriter out;
    out.putVarint(assignment.task);
    out.put(std::span<const std::byte>(assignment.input));
    return out.take();
}

Assignment decodedAssignment(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Assignment assignment;
    assignment.task = in.takeVarint();
    assignment.input = takeRest(in);
    return assignment;
}

TaskBytes encoded(const Outcome& outcome) {
    ByteWriter out;
    out.putVarint(outcome.task);
    out.put(outcome.seconds);
    out.putVarint(outcome.peakResidentBytes);
    out.putVarint(outcome.bytesSent);
    out.put(std::span<const std::byte>(outcome.result));
    return out.take();
}

Outcome decodedOutcome(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Outcome outcome;
    outcome.task = in.takeVarint();
    outcome.seconds = in.take<double>();
    outcome.peakResidentBytes = in.takeVarint();
    outcome.bytesSent = in.takeVarint();
    outcome.result = takeRest(in);
    return outcome;
}

TaskBytes encoded(const News& news) {
    ByteWriter out;
    out.putVarint(news.progress);
    out.put(static_cast<std::uint8_t>(news.isTold));
    out.put(std::span<const std::byte>(news.told));
    return out.take();
}

News decodedNews(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    News news;
    news.progress = in.takeVarint();
    news.isTold = in.take<std::uint8_t>() != 0;
    news.told = takeRest(in);
    return news;
}

} // namespace gnomon::mpi
