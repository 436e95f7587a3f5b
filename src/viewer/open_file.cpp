#include "viewer/open_file.h"

#include <utility>

namespace gnomon::viewer {

namespace {

constexpr double kWatchSeconds = 1; // interval between checks of the model's file

} // namespace

void OpenFile::open(const std::string& file) {
    messages_->attempt([&] {
        if (isModelPath(file)) return openModel(file);
        const CacheOptions cache{options_->buildMemory, options_->threads, options_->sourceRoot};
        if (isCacheFresh(file, cache)) return openModel(cachePath(file));
        build_.reset();
        build_ = std::make_unique<CacheBuild>(file, cache);
    });
}

void OpenFile::openModel(const std::string& path) {
    auto scene = std::make_unique<Scene>(
        path, options_->settings, options_->colors, *context_, [messages = messages_](const std::string& reason) {
            messages->fail(reason);
        });
    onOpen_(*scene);
    scene_ = std::move(scene);
    fate_ = hierarchy::Fate::Same;
}

void OpenFile::watchBuild() {
    if (!build_ || !build_->isDone()) return;
    const std::string model = cachePath(build_->meshPath());
    const std::optional<std::string> failure = build_->failure();
    build_.reset();
    if (failure)
        messages_->fail(*failure);
    else if (messages_->attempt([&] { openModel(model); }))
        messages_->note("built " + model);
}

bool OpenFile::watchFile() {
    using hierarchy::Fate;
    if (!scene_ || now_() - lastWatch_ < kWatchSeconds) return false;
    lastWatch_ = now_();
    const Fate fate = scene_->fate();
    if (fate != std::exchange(fate_, fate)) {
        const std::string& path = scene_->model().path();
        if (fate == Fate::Gone)
            messages_->fail(path + ": the model file has vanished; the window keeps the open model");
        if (fate == Fate::Changed) messages_->fail(path + ": the model has changed; F9 opens it again");
        if (fate == Fate::Same) messages_->note(path + ": the model is back");
    }
    return scene_->isAwaiting();
}

} // namespace gnomon::viewer
