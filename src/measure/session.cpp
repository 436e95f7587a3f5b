#include "measure/session.h"

#include "core/check.h"
#include "core/error.h"
#include "executor/gl/gl_executor.h"
#include "executor/software_executor.h"
#include "gl/context.h"
#include "settings/backend_needs.h"
#include "settings/table.h"

namespace gnomon::measure {

std::unique_ptr<executor::Executor> makeExecutor(
    const settings::Settings& settings, const std::function<void(const std::string&)>& warn) {
    using settings::Backend;
    const gl::ShaderLibrary shaders(
        settings.shaderFolder.empty() ? std::nullopt : std::optional<std::string>(settings.shaderFolder));
    GNOMON_CHECK(settings.backend != Backend::Window);
    if (decidesExactly(settings)) return executor::makeSoftwareExecutor();
    const gl::Platform platform = settings.backend == Backend::Osmesa ? gl::Platform::Osmesa : gl::Platform::Egl;
    try {
        return executor::makeGlExecutor(platform, shaders, settings.gpuMemory, warn);
    } catch (const Error& error) {
        if (settings.backend != Backend::Auto) throw;
        warn(std::string("the GPU cannot be used, the software backend draws: ") + error.what());
        return executor::makeSoftwareExecutor();
    }
}

bool decidesExactly(const settings::Settings& settings) {
    using settings::Backend;
    return settings.backend == Backend::Software ||
           (settings.backend == Backend::Auto && (settings::needsSoftware(settings) || !gl::hasGpu()));
}

Session::Session(
    const std::string& modelPath,
    const settings::Settings& settings,
    const std::function<void(const std::string&)>& warn)
    : warn_(warn),
      model_(modelPath, settings.memory),
      executor_(makeExecutor(settings, warn)),
      renderer_(
          model_,
          *executor_,
          {.memory = settings.memory,
           .onDamaged =
               [warn](const streaming::DamagedPage& page) {
                   warn("a page is damaged, its parents are drawn: " + page.reason);
               },
           .holdsPictures = executor_->capabilities().bands}) {}

std::string shortfallLine(const telemetry::Shortfall& shortfall) {
    const std::string text = shortfall.text();
    const std::string options = settings::optionsOf(text);
    return options.empty() ? text : text + " (" + options + ")";
}

void Session::tellShortfall() {
    if (const std::string line = shortfallLine(renderer_.takeShortfall()); !line.empty()) warn_(line);
}

} // namespace gnomon::measure
