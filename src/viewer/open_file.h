// The file that the window shows: a model, or a mesh whose model is being built. The model's file is watched for
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

/// Opens files in the window. Errors are shown as messages, and the previous file stays open. All arguments of the
/// constructor must outlive the object.
class OpenFile {
public:
    /// Creates the object without an open file. It calls `onOpen` before a new model replaces the previous one. If
    /// `onOpen` throws, the previous model stays open.
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

    /// Opens a model file, or the cached model of a mesh. Starts a build if the cached model is outdated.
    void open(const std::string& file);

    /// Opens the model as soon as its build is finished. Must be called in each frame.
    void watchBuild();

    /// Checks once per second whether the file of the open model has changed or vanished, and shows a message. Must be
    /// called in each frame. Returns true if another frame is needed because a server may still send data.
    bool watchFile();

    /// Returns the scene of the open model, or null if no model is open.
    Scene* scene() const { return scene_.get(); }

    /// Returns the running build, or null if there is none.
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
