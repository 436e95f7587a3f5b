// An open model with an executor, as the view options ask for them.
#pragma once

#include "frame/renderer.h"
#include "hierarchy/model_file.h"
#include "settings/view_options.h"

#include <memory>

namespace gnomon::measure {

/// The executor that `options` name: `auto` is a GPU if there is one, else `software`. Throws UsageError for the
/// window.
std::unique_ptr<executor::Executor> makeExecutor(const settings::ViewOptions& options);

/// A model, who draws it, and what renders its frames; warns of each damaged page once, on stderr.
class Session {
public:
    Session(const std::string& modelPath, const settings::ViewOptions& options);

    const hierarchy::ModelFile& model() const { return model_; }

    executor::Executor& executor() { return *executor_; }

    frame::Renderer& renderer() { return renderer_; }

private:
    hierarchy::ModelFile model_;
    std::unique_ptr<executor::Executor> executor_;
    frame::Renderer renderer_;
};

} // namespace gnomon::measure
