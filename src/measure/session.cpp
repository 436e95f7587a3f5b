#include "measure/session.h"

#include "core/check.h"
#include "executor/gl/gl_executor.h"
#include "executor/software_executor.h"
#include "gl/context.h"

namespace gnomon::measure {

std::unique_ptr<executor::Executor> makeExecutor(const settings::Settings& settings) {
    using settings::Backend;
    const gl::ShaderLibrary shaders(
        settings.shaderFolder.empty() ? std::nullopt : std::optional<std::string>(settings.shaderFolder));
    Backend backend = settings.backend;
    GNOMON_CHECK(backend != Backend::Window);
    if (backend == Backend::Auto) backend = decidesExactly(settings) ? Backend::Software : Backend::Egl;
    if (backend == Backend::Software) return executor::makeSoftwareExecutor();
    const gl::Platform platform = backend == Backend::Egl ? gl::Platform::Egl : gl::Platform::Osmesa;
    return executor::makeGlExecutor(platform, shaders, settings.gpuMemory);
}

bool decidesExactly(const settings::Settings& settings) {
    using settings::Backend;
    const bool wantsSoftware = settings.quality.shadows == plan::ShadowMode::Exact ||
                               shadow::rowsOf(settings.quality.warp.rule) == shadow::RowSpacing::Logarithmic ||
                               settings.quality.cullCasters == plan::CasterCulling::Receivers ||
                               settings.quality.occlusion == plan::Choice::On || settings.quality.look.ground ||
                               !settings.sections.empty();
    return settings.backend == Backend::Software ||
           (settings.backend == Backend::Auto && (wantsSoftware || !gl::hasGpu()));
}

Session::Session(
    const std::string& modelPath,
    const settings::Settings& settings,
    const std::function<void(const std::string&)>& warn)
    : model_(modelPath, settings.memory),
      executor_(makeExecutor(settings)),
      renderer_(
          model_, *executor_, {.memory = settings.memory, .onDamaged = [warn](const streaming::DamagedPage& page) {
                                   warn("a page is damaged, its parents are drawn: " + page.reason);
                               }}) {}

} // namespace gnomon::measure
