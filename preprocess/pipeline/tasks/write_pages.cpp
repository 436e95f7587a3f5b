#include "preprocess/pipeline/tasks/write_pages.h"

#include "preprocess/pipeline/assemble.h"
#include "preprocess/pipeline/tasks/task_bytes.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace gnomon::pipeline {

namespace {

using hierarchy::EncodedPage;
using hierarchy::PageInfo;

std::uint64_t pageCount(const CheckpointLog& log) {
    return std::accumulate(log.pageCounts().begin(), log.pageCounts().end(), std::uint64_t{0});
}

EncodedPage readPage(const PagesToWrite& pages, const PageInfo& info, std::uint64_t place) {
    EncodedPage page{info, std::vector<std::byte>(info.storedBytes)};
    pages.scratch.read({place, info.storedBytes, info.checksum}, page.bytes);
    return page;
}

/// Returns the number of bytes of the model file that one task writes. Each process runs several tasks, so that all
/// processes end at about the same time. A task writes so much that the cost of its sync is small.
std::uint64_t bytesOfRange(const CheckpointLog& log, std::uint32_t processes) {
    constexpr std::uint64_t kMinRangeBytes = std::uint64_t{64} << 10U;
    constexpr std::uint64_t kMaxRangeBytes = std::uint64_t{16} << 20U;
    std::uint64_t bytes = 0;
    forEachPage(log, [&](const PageInfo& info, std::uint64_t) { bytes += info.storedBytes; });
    return std::clamp(bytes / (std::uint64_t{4} * processes), kMinRangeBytes, kMaxRangeBytes);
}

} // namespace

void appendPages(const PagesToWrite& pages) {
    pages.progress.stage("write", "pages", pageCount(pages.log));
    forEachPage(pages.log, [&](const PageInfo& info, std::uint64_t place) {
        const EncodedPage page = readPage(pages, info, place);
        pages.writer.append(page);
        if (pages.isSeen(info)) pages.see(page);
        pages.progress.advance(1);
    });
}

void writePagesInTasks(
    const PagesToWrite& pages,
    const std::string& displayPath,
    std::uint32_t processes,
    TaskRunner& runner,
    const Perform& perform) {
    pages.progress.stage("write", "pages", pageCount(pages.log));
    const std::uint64_t maxBytes = bytesOfRange(pages.log, processes);
    const std::string path = std::filesystem::absolute(pages.writer.unfinishedPath().value()).string();
    std::vector<PageRange> ranges;
    std::uint64_t end = 0;
    forEachPage(pages.log, [&](const PageInfo& info, std::uint64_t place) {
        const std::uint64_t offset = pages.writer.reserve(info);
        if (ranges.empty() || offset + info.storedBytes - ranges.back().offset > maxBytes)
            ranges.push_back({path, displayPath, offset, {}});
        ranges.back().pages.push_back({place, info.storedBytes, info.checksum});
        end = offset + info.storedBytes;
        if (pages.isSeen(info)) pages.see(readPage(pages, info, place));
    });
    TaskPhase phase;
    phase.kind = TaskKind::WritePages;
    phase.tasks.resize(ranges.size());
    std::iota(phase.tasks.begin(), phase.tasks.end(), 0U);
    phase.atOnce = ranges.size(); // no memory limit, because a task has only one page in memory
    phase.weight = [&](std::uint32_t range) {
        return (range + 1 < ranges.size() ? ranges[range + 1].offset : end) - ranges[range].offset;
    };
    phase.input = [&](std::uint32_t range) { return encoded(ranges[range]); };
    phase.take = [](std::uint32_t, std::span<const std::byte>) {};
    runner.run(phase, perform);
}

} // namespace gnomon::pipeline
