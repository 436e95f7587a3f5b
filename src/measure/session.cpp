#include "measure/session.h"

#include "core/printable.h"
#include "executor/gl_executor.h"
#include "executor/software_executor.h"
#include "gl/context.h"
#include "settings/option_text.h"

#include <cstdio>

namespace gnomon::measure {

std::unique_ptr<executor::Executor> makeExecutor(const settings::ViewOptions& options) {
    const gl::ShaderLibrary shaders(
        options.shaders.empty() ? std::nullopt : std::optional<std::string>(options.shaders));
    const Bytes memory = settings::parseMemory("--gpu-memory", options.gpuMemory);
    std::string backend = options.backend;
    if (backend == "window") throw settings::UsageError{"--backend window is for gnomon view"};
    if (backend == "auto") backend = gl::hasGpu() ? "egl" : "software";
    if (backend == "software") return executor::makeSoftwareExecutor();
    return executor::makeGlExecutor(backend == "egl" ? gl::Platform::Egl : gl::Platform::Osmesa, shaders, memory);
}

Session::Session(const std::string& modelPath, const settings::ViewOptions& options)
    : model_(modelPath, settings::parseMemory("--memory", options.memory)),
      executor_(makeExecutor(options)),
      renderer_(
          model_,
          *executor_,
          {.memory = settings::parseMemory("--memory", options.memory),
           .onDamaged = [](const streaming::DamagedPage& page) {
               std::fprintf(
                   stderr,
                   "gnomon: warning: a page is damaged, its parents are drawn: %s\n",
                   printable(page.reason).c_str());
           }}) {}

} // namespace gnomon::measure
