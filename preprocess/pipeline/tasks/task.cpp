#include "preprocess/pipeline/tasks/task.h"

#include "preprocess/chunk/in_order.h"

namespace gnomon::pipeline {

namespace {

using hierarchy::ByteReader;
using hierarchy::ByteWriter;
using scratch::Block;
using scratch::putBlock;
using scratch::takeBlock;

} // namespace

void LocalTasks::run(const TaskPhase& phase, const Perform& perform) {
    chunk::makeInOrder(
        0,
        phase.tasks.size(),
        phase.atOnce,
        [&](std::size_t i) { return perform(phase.kind, phase.input(phase.tasks[i])); },
        [&](std::size_t i, const std::vector<std::byte>& result) { phase.take(phase.tasks[i], result); });
}

std::size_t takeCount(ByteReader& in) {
    const std::uint64_t count = in.takeVarint();
    if (count > in.remaining()) throw hierarchy::Damage{"the bytes end too early"};
    return count;
}

void putBlocks(ByteWriter& out, const Blocks& blocks) {
    out.putVarint(blocks.size());
    for (const Block& block : blocks)
        putBlock(out, block);
}

Blocks takeBlocks(ByteReader& in) {
    Blocks blocks(takeCount(in));
    for (Block& block : blocks)
        block = takeBlock(in);
    return blocks;
}

void putMail(ByteWriter& out, const Mail& mail) {
    out.putVarint(mail.size());
    for (const auto& [stream, block] : mail) {
        out.putVarint(stream);
        putBlock(out, block);
    }
}

Mail takeMail(ByteReader& in) {
    Mail mail(takeCount(in));
    for (auto& [stream, block] : mail) {
        stream = static_cast<std::uint32_t>(in.takeVarint());
        block = takeBlock(in);
    }
    return mail;
}

} // namespace gnomon::pipeline
