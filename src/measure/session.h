// An open model with an executor, as the settings ask for them.
#pragma once

#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "settings/backend_choice.h"
#include "settings/settings.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::measure {

/// Returns the backend for `command`, which draws `pictures` pictures. Looks for a GPU only if `auto` can use one.
settings::BackendChoice backendFor(
    const settings::Settings& settings, settings::DrawingCommand command, int pictures = 1);

/// The sentence of `shortfall`, with the options concerned; empty if nothing is missed.
std::string shortfallLine(const telemetry::Shortfall& shortfall);

/// A model, its executor and its renderer.
class Session {
public:
    /// Opens the model and makes the backend for `command`. If `auto` chose a GPU that cannot be used, the software
    /// backend draws. Tells `warn` in a line of each damaged page and of each GPU that cannot be used. The backend is
    /// not the window.
    Session(
        const std::string& modelPath,
        const settings::Settings& settings,
        const std::function<void(const std::string&)>& warn,
        settings::DrawingCommand command = settings::DrawingCommand::Render,
        int pictures = 1);

    /// What is being read of a server is given up.
    ~Session() { model_.source().stop(); }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    Session(Session&&) = delete;
    Session& operator=(Session&&) = delete;

    const hierarchy::ModelFile& model() const { return model_; }

    executor::Executor& executor() { return *executor_; }

    frame::Renderer& renderer() { return renderer_; }

    /// Tells `warn` in a line if pictures since the last call miss their error or lack pages.
    void tellShortfall();

private:
    std::function<void(const std::string&)> warn_;
    hierarchy::ModelFile model_;
    std::unique_ptr<executor::Executor> executor_;
    frame::Renderer renderer_;
};

} // namespace gnomon::measure
