// An open model, with the backend and the renderer that the options of a command request.
#pragma once

#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "settings/backend_choice.h"
#include "settings/settings.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::task {

/// Returns the backend for `command`, which draws `pictures` pictures. Searches for a GPU only if the user requests
/// `auto` and a GPU could be chosen.
settings::BackendChoice backendFor(
    const settings::Settings& settings, settings::DrawingCommand command, int pictures = 1);

/// Returns a warning that frames exceed their requested error or lack pages. The warning names the options that change
/// this. Returns an empty text if `shortfall` is empty.
std::string shortfallLine(const telemetry::Shortfall& shortfall);

/// An open model, with the backend and the renderer that draw it.
class Session {
public:
    /// Opens the model and creates `backend`, which must not be Window. If the backend was chosen automatically and its
    /// GPU cannot be used, the software backend draws. Calls `warn` with one line for each damaged page and for each
    /// GPU that cannot be used.
    Session(
        const std::string& modelPath,
        const settings::Settings& settings,
        const std::function<void(const std::string&)>& warn,
        settings::Backend backend);

    /// Opens the model and chooses the backend for drawing one picture.
    Session(
        const std::string& modelPath,
        const settings::Settings& settings,
        const std::function<void(const std::string&)>& warn)
        : Session(modelPath, settings, warn, backendFor(settings, settings::DrawingCommand::Render).backend) {}

    /// Cancels all reads from a server.
    ~Session() { model_.source().stop(); }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;

    const hierarchy::ModelFile& model() const { return model_; }

    render::Backend& backend() { return *backend_; }

    frame::Renderer& renderer() { return renderer_; }

    /// Calls `warn` with one line if frames since the last call exceeded their requested error or lacked pages.
    void tellShortfall();

private:
    std::function<void(const std::string&)> warn_;
    hierarchy::ModelFile model_;
    std::unique_ptr<render::Backend> backend_;
    frame::Renderer renderer_;
};

} // namespace gnomon::task
