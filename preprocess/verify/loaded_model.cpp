#include "preprocess/verify/loaded_model.h"

#include "core/error.h"

#include <tbb/parallel_for.h>

namespace gnomon::verify {

namespace {

/// So that a few bytes that say the same again and again cannot ask for all memory. The pages of a flat sheet, which
/// repeats itself as nothing else does, decode to 255 times their stored bytes.
void requireBelievable(const hierarchy::ModelFile& file) {
    constexpr std::uint64_t kMostTimes = 1024;
    const Bytes most{mebibytes(64).count + kMostTimes * file.fileBytes()};
    Bytes decoded;
    for (const hierarchy::PageInfo& page : file.pages())
        decoded.count += hierarchy::decodedPageBytes(page);
    if (decoded > most)
        throw Error(
            file.path(),
            "its pages take more memory once decoded than so small a file may ask for",
            "at most " + readableBytes(most),
            readableBytes(decoded));
}

} // namespace

LoadedModel loadModel(const hierarchy::ModelFile& file, Progress& progress) {
    requireBelievable(file);
    LoadedModel model;
    model.summary = file.summary();
    model.pages.resize(file.pages().size());
    std::vector<std::string> damage(file.pages().size());
    progress.stage("read pages", "pages", model.pages.size());
    tbb::parallel_for(std::size_t{0}, model.pages.size(), [&](std::size_t page) {
        try {
            model.pages[page] = file.readPage(static_cast<std::uint32_t>(page));
        } catch (const hierarchy::PageDamage& error) {
            damage[page] = error.what();
        }
        progress.advance(1);
    });
    model.firstGroup.push_back(0);
    model.firstCluster.push_back(0);
    for (std::size_t page = 0; page < model.pages.size(); ++page) {
        if (!damage[page].empty()) model.damage.push_back(damage[page]);
        const auto groups = static_cast<std::uint32_t>(model.pages[page].groups.size());
        const auto clusters = static_cast<std::uint32_t>(model.pages[page].clusters.size());
        model.firstGroup.push_back(model.firstGroup.back() + groups);
        model.firstCluster.push_back(model.firstCluster.back() + clusters);
    }
    return model;
}

} // namespace gnomon::verify
