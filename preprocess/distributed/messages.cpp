#include "preprocess/distributed/messages.h"

namespace gnomon::distributed {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

void putBytes(ByteWriter& out, const std::vector<std::byte>& bytes) {
    out.putVarint(bytes.size());
    out.put(std::span<const std::byte>(bytes));
}

std::vector<std::byte> takeBytes(ByteReader& in) {
    const auto bytes = in.take(in.takeVarint());
    return {bytes.begin(), bytes.end()};
}

} // namespace

std::vector<std::byte> encoded(const Hello& hello) {
    ByteWriter out;
    out.putText(hello.host);
    out.putVarint(hello.threads);
    out.putText(hello.key);
    return out.take();
}

Hello decodedHello(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Hello hello;
    hello.host = in.takeText();
    hello.threads = static_cast<std::uint32_t>(in.takeVarint());
    hello.key = in.takeText();
    in.expectEnd();
    return hello;
}

std::vector<std::byte> encoded(const Beginning& beginning) {
    ByteWriter out;
    out.putText(beginning.place.stem);
    out.putVarint(beginning.place.firstPart);
    return out.take();
}

Beginning decodedBeginning(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Beginning beginning;
    beginning.place.stem = in.takeText();
    beginning.place.firstPart = static_cast<std::uint32_t>(in.takeVarint());
    in.expectEnd();
    return beginning;
}

std::vector<std::byte> encoded(const Assignment& assignment) {
    ByteWriter out;
    out.put(static_cast<std::uint8_t>(assignment.kind));
    out.putVarint(assignment.task);
    putBytes(out, assignment.input);
    return out.take();
}

Assignment decodedAssignment(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Assignment assignment;
    assignment.kind = static_cast<pipeline::TaskKind>(in.take<std::uint8_t>());
    assignment.task = static_cast<std::uint32_t>(in.takeVarint());
    assignment.input = takeBytes(in);
    in.expectEnd();
    return assignment;
}

std::vector<std::byte> encoded(const Outcome& outcome) {
    ByteWriter out;
    out.putVarint(outcome.task);
    out.put(outcome.seconds);
    for (const std::uint64_t number : {outcome.progress, outcome.bytesRead, outcome.bytesWritten})
        out.putVarint(number);
    putBytes(out, outcome.result);
    return out.take();
}

Outcome decodedOutcome(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Outcome outcome;
    outcome.task = static_cast<std::uint32_t>(in.takeVarint());
    outcome.seconds = in.take<double>();
    for (std::uint64_t* number : {&outcome.progress, &outcome.bytesRead, &outcome.bytesWritten})
        *number = in.takeVarint();
    outcome.result = takeBytes(in);
    in.expectEnd();
    return outcome;
}

std::vector<std::byte> encoded(const Farewell& farewell) {
    ByteWriter out;
    out.putVarint(farewell.peakResidentBytes);
    out.putVarint(farewell.tableBytes);
    out.putVarint(farewell.bytesSent);
    return out.take();
}

Farewell decodedFarewell(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    Farewell farewell;
    farewell.peakResidentBytes = in.takeVarint();
    farewell.tableBytes = in.takeVarint();
    farewell.bytesSent = in.takeVarint();
    in.expectEnd();
    return farewell;
}

std::vector<std::byte> encoded(const std::string& text) {
    ByteWriter out;
    out.putText(text);
    return out.take();
}

std::string decodedText(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    std::string text = in.takeText();
    in.expectEnd();
    return text;
}

} // namespace gnomon::distributed
