#include "measure/session.h"

#include "core/check.h"
#include "core/printable.h"
#include "executor/gl_executor.h"
#include "executor/software_executor.h"
#include "gl/context.h"

#include <cstdio>

namespace gnomon::measure {

std::unique_ptr<executor::Executor> makeExecutor(const settings::Settings& settings) {
    using settings::Backend;
    const gl::ShaderLibrary shaders(
        settings.shaderFolder.empty() ? std::nullopt : std::optional<std::string>(settings.shaderFolder));
    Backend backend = settings.backend;
    GNOMON_CHECK(backend != Backend::Window);
    if (backend == Backend::Auto) backend = gl::hasGpu() ? Backend::Egl : Backend::Software;
    if (backend == Backend::Software) return executor::makeSoftwareExecutor();
    const gl::Platform platform = backend == Backend::Egl ? gl::Platform::Egl : gl::Platform::Osmesa;
    return executor::makeGlExecutor(platform, shaders, settings.gpuMemory);
}

Session::Session(const std::string& modelPath, const settings::Settings& settings)
    : model_(modelPath, settings.memory),
      executor_(makeExecutor(settings)),
      renderer_(model_, *executor_, {.memory = settings.memory, .onDamaged = [](const streaming::DamagedPage& page) {
                                         std::fprintf(
                                             stderr,
                                             "gnomon: warning: a page is damaged, its parents are drawn: %s\n",
                                             printable(page.reason).c_str());
                                     }}) {}

} // namespace gnomon::measure
