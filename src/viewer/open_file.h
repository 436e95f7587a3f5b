// The open file of the window: a model, or a mesh whose model is being built. Also watches the model's file for
// changes.
#pragma once

#include "viewer/messages.h"
#include "viewer/model_cache.h"
#include "viewer/scene.h"
#include "viewer/viewer_options.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::viewer {

/// Opens files. Errors are shown as messages, and the previous file stays open. All arguments must outlive the object.
class OpenFile {
public:
    /// Creates the object. It calls `onOpen` before a new model replaces the previous one. If `onOpen` throws, the
    /// previous model stays.
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

    /// Opens a model, or the cache of a mesh. Starts a build if the cache is outdated.
    void open(const std::string& file);

    /// Opens the model when its build is finished. Call this in each frame.
    void watchBuild();

    /// Checks once per second whether the model's file has changed or vanished, and shows a message. Call this in each
    /// frame. Returns true if another frame is needed because a server may still send data.
    bool watchFile();

    /// Returns the scene of the open model, or null.
    Scene* scene() const { return scene_.get(); }

    /// Returns the current build, or null.
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
    hierarchy::Fate fate_ = hierarchy::Fate::Same;
    double lastWatch_ = 0;
};

} // namespace gnomon::viewer
