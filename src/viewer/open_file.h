// What is open in the window: a model, or a mesh whose model is being built; and what becomes of the model's file.
#pragma once

#include "viewer/messages.h"
#include "viewer/model_cache.h"
#include "viewer/scene.h"
#include "viewer/viewer_options.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::viewer {

/// What goes wrong is told in the messages, and what was open stays open. All that it is given must outlive it.
class OpenFile {
public:
    /// `onOpen` prepares the rest of the window for another model, just before that takes the place of the last one;
    /// if it throws, the last one stays.
    OpenFile(
        const ViewerOptions& options,
        const gl::Context& context,
        Messages& messages,
        Clock now,
        std::function<void(const Scene&)> onOpen)
        : options_(&options),
          context_(&context),
          messages_(&messages),
          now_(std::move(now)),
          onOpen_(std::move(onOpen)) {}

    /// Opens a model, or the cache of a mesh; begins a build where that is not fresh.
    void open(const std::string& file);

    /// Opens the model of a build that has ended; to be called each frame.
    void watchBuild();

    /// Looks once a second whether the model's file has changed or vanished, and tells it; to be called each frame.
    /// True if a frame should be drawn to see what a server has sent.
    bool watchFile();

    /// The model; null before the first one.
    Scene* scene() const { return scene_.get(); }

    /// The build that is under way; null if none is.
    const CacheBuild* build() const { return build_.get(); }

private:
    void openModel(const std::string& path);

    const ViewerOptions* options_;
    const gl::Context* context_;
    Messages* messages_;
    Clock now_;
    std::function<void(const Scene&)> onOpen_;
    std::unique_ptr<Scene> scene_;
    std::unique_ptr<CacheBuild> build_;
    storage::Fate fate_ = storage::Fate::Same;
    double lastWatch_ = 0;
};

} // namespace gnomon::viewer
