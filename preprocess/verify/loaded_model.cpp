#include "preprocess/verify/loaded_model.h"

#include "core/error.h"

#include <tbb/parallel_for.h>

#include <numeric>

namespace gnomon::verify {

/// This test prevents that a small malicious file allocates all memory. For comparison: the most repetitive valid model
/// is a flat sheet, whose pages decode to 255 times their stored bytes.
void requireBelievable(const hierarchy::ModelFile& file) {
    constexpr std::uint64_t kMaxExpansion = 1024;
    const Bytes maxBytes{mebibytes(64).count + kMaxExpansion * file.fileBytes()};
    Bytes decoded;
    for (const hierarchy::PageInfo& page : file.pages())
        decoded.count += hierarchy::decodedPageBytes(page);
    if (decoded > maxBytes)
        throw Error(
            file.path(),
            "the decoded pages are too large for a file of this size",
            "at most " + readableBytes(maxBytes),
            readableBytes(decoded));
}

LoadedModel loadPages(const hierarchy::ModelFile& file, std::span<const std::uint32_t> pages, Progress& progress) {
    LoadedModel model;
    model.summary = file.summary();
    model.pages.resize(file.pages().size());
    model.firstGroup.push_back(0);
    model.firstCluster.push_back(0);
    for (const hierarchy::PageInfo& info : file.pages()) {
        model.firstGroup.push_back(model.firstGroup.back() + info.groupCount);
        model.firstCluster.push_back(model.firstCluster.back() + info.clusterCount);
        model.levels.push_back(info.level);
    }
    tbb::parallel_for(std::size_t{0}, pages.size(), [&](std::size_t i) {
        model.pages[pages[i]] = file.readPage(pages[i]);
        progress.advance(1);
    });
    return model;
}

LoadedModel loadModel(const hierarchy::ModelFile& file, Progress& progress) {
    requireBelievable(file);
    std::vector<std::uint32_t> all(file.pages().size());
    std::iota(all.begin(), all.end(), 0U);
    progress.stage("read pages", "pages", all.size());
    return loadPages(file, all, progress);
}

} // namespace gnomon::verify
