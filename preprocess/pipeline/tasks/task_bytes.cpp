#include "preprocess/pipeline/tasks/task_bytes.h"

namespace gnomon::pipeline {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;

void putChunk(ByteWriter& out, const ChunkStreams& streams) {
    for (const Blocks& blocks : streams.bins)
        putBlocks(out, blocks);
    for (const Blocks& blocks : streams.borders)
        putBlocks(out, blocks);
}

template <class T>
T taken(ByteReader& in) {
    return static_cast<T>(in.takeVarint());
}

void putNumbers(ByteWriter& out, const std::vector<std::uint32_t>& numbers) {
    out.putVarint(numbers.size());
    for (const std::uint32_t number : numbers)
        out.putVarint(number);
}

std::vector<std::uint32_t> takeNumbers(ByteReader& in) {
    const std::uint64_t count = in.takeVarint();
    if (count > in.remaining()) throw hierarchy::Damage{"the bytes end too early"}; // each number has at least one byte
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t& number : numbers)
        number = taken<std::uint32_t>(in);
    return numbers;
}

} // namespace

ChunkStreams streamsOfChunk(
    const scratch::StreamStore& bins, const scratch::StreamStore* borders, std::uint32_t chunk) {
    ChunkStreams streams;
    for (std::uint32_t kind = 0; kind < streams.bins.size(); ++kind)
        streams.bins[kind] = bins.blocks(chunk::streamOf(static_cast<chunk::BinStream>(kind), chunk));
    for (std::uint32_t kind = 0; borders != nullptr && kind < streams.borders.size(); ++kind)
        streams.borders[kind] = borders->blocks(chunk::streamOf(static_cast<chunk::BorderStream>(kind), chunk));
    return streams;
}

std::vector<std::byte> encoded(const TaskFacts& facts) {
    ByteWriter out;
    for (int axis = 0; axis < 3; ++axis)
        out.put(facts.grid.origin[axis]);
    out.put(facts.grid.stepExponent);
    for (const bool has : {facts.format.isDouble, facts.format.hasNormals, facts.format.hasColors, facts.format.isWide})
        out.put(static_cast<std::uint8_t>(has ? 1 : 0));
    for (const auto bits : facts.format.fields.bits)
        out.putVarint(bits);
    return out.take();
}

TaskFacts decodedFacts(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    TaskFacts facts;
    for (int axis = 0; axis < 3; ++axis)
        facts.grid.origin[axis] = in.take<double>();
    facts.grid.stepExponent = in.take<decltype(facts.grid.stepExponent)>();
    for (bool* has : {&facts.format.isDouble, &facts.format.hasNormals, &facts.format.hasColors, &facts.format.isWide})
        *has = in.take<std::uint8_t>() != 0;
    for (auto& bits : facts.format.fields.bits)
        bits = static_cast<std::decay_t<decltype(bits)>>(in.takeVarint());
    in.expectEnd();
    return facts;
}

std::vector<std::byte> chunkInput(const ChunkStreams& streams) {
    ByteWriter out;
    putChunk(out, streams);
    return out.take();
}

ChunkStreams takeChunk(ByteReader& in) {
    ChunkStreams streams;
    for (Blocks& blocks : streams.bins)
        blocks = takeBlocks(in);
    for (Blocks& blocks : streams.borders)
        blocks = takeBlocks(in);
    return streams;
}

std::vector<std::byte> encoded(const NodeInput& input) {
    ByteWriter out;
    for (const std::uint32_t number : {input.round, input.node, input.firstLevel, input.isLast ? 1U : 0U})
        out.putVarint(number);
    putChunk(out, input.chunk);
    for (const std::uint64_t number : {input.sums.clusters, input.sums.triangles, input.sums.vertices})
        out.putVarint(number);
    putBlocks(out, input.records);
    putBlocks(out, input.locks);
    return out.take();
}

NodeInput takeNode(ByteReader& in) {
    NodeInput input;
    input.round = taken<std::uint32_t>(in);
    input.node = taken<std::uint32_t>(in);
    input.firstLevel = taken<std::uint32_t>(in);
    input.isLast = in.takeVarint() != 0;
    input.chunk = takeChunk(in);
    for (std::uint64_t* number : {&input.sums.clusters, &input.sums.triangles, &input.sums.vertices})
        *number = in.takeVarint();
    input.records = takeBlocks(in);
    input.locks = takeBlocks(in);
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const RouteInput& input) {
    ByteWriter out;
    putBlocks(out, input.left);
    out.putVarint(input.firstLevel);
    out.putVarint(input.borderStreams);
    putNumbers(out, input.firstPages);
    putNumbers(out, input.nodeOf);
    return out.take();
}

RouteInput takeRoute(ByteReader& in) {
    RouteInput input;
    input.left = takeBlocks(in);
    input.firstLevel = taken<std::uint32_t>(in);
    input.borderStreams = taken<std::uint32_t>(in);
    input.firstPages = takeNumbers(in);
    input.nodeOf = takeNumbers(in);
    in.expectEnd();
    return input;
}

std::vector<std::byte> encoded(const RoutedMail& mail) {
    ByteWriter out;
    for (const Mail* part : {&mail.records, &mail.locks, &mail.borders})
        putMail(out, *part);
    out.putVarint(mail.counts.locked);
    out.putVarint(mail.counts.lockedBefore);
    return out.take();
}

RoutedMail decodedRoutedMail(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    RoutedMail mail;
    for (Mail* part : {&mail.records, &mail.locks, &mail.borders})
        *part = takeMail(in);
    mail.counts.locked = in.takeVarint();
    mail.counts.lockedBefore = in.takeVarint();
    in.expectEnd();
    return mail;
}

std::vector<std::byte> encoded(const PageRange& input) {
    ByteWriter out;
    out.putText(input.path);
    out.putText(input.displayPath);
    out.putVarint(input.offset);
    putBlocks(out, input.pages);
    return out.take();
}

PageRange takePageRange(ByteReader& in) {
    PageRange input;
    input.path = in.takeText();
    input.displayPath = in.takeText();
    input.offset = in.takeVarint();
    input.pages = takeBlocks(in);
    in.expectEnd();
    return input;
}

std::vector<std::byte> locksInput(const Blocks& borders) {
    ByteWriter out;
    putBlocks(out, borders);
    return out.take();
}

} // namespace gnomon::pipeline
