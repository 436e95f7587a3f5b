#include "preprocess/verify/loaded_model.h"

#include "core/error.h"

#include <tbb/parallel_for.h>

namespace gnomon::verify {

LoadedModel loadModel(const hierarchy::ModelFile& file, Progress& progress) {
    LoadedModel model;
    model.summary = file.summary();
    model.pages.resize(file.pages().size());
    std::vector<std::string> damage(file.pages().size());
    progress.stage("read pages", "pages", model.pages.size());
    tbb::parallel_for(std::size_t{0}, model.pages.size(), [&](std::size_t page) {
        try {
            model.pages[page] = file.readPage(static_cast<std::uint32_t>(page));
        } catch (const Error& error) {
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
