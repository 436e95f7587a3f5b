// An open model with an executor, as the settings ask for them.
#pragma once

#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "settings/settings.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::measure {

/// Makes the executor that `settings` name, which is not the window: `auto` is a GPU if there is one and it can carry
/// out what they ask for, else `software`. Tells `warn` in a line why a GPU is not used.
std::unique_ptr<executor::Executor> makeExecutor(
    const settings::Settings& settings, const std::function<void(const std::string&)>& warn);

/// Whether the executor that `settings` name can decide shadows exactly. Makes none.
bool decidesExactly(const settings::Settings& settings);

/// The sentence of `shortfall`, with the options concerned; empty if nothing is missed.
std::string shortfallLine(const telemetry::Shortfall& shortfall);

/// A model, its executor and its renderer.
class Session {
public:
    /// `warn` is told in a line of each page that is damaged, and of each GPU that cannot be used.
    Session(
        const std::string& modelPath,
        const settings::Settings& settings,
        const std::function<void(const std::string&)>& warn);

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
