#include "app/session.h"

#include "app/option_text.h"
#include "executor/gl_executor.h"
#include "executor/software_executor.h"
#include "gl/context.h"

#include <cstdio>

namespace gnomon::app {

std::unique_ptr<executor::Executor> makeExecutor(const ViewOptions& options) {
    const gl::ShaderLibrary shaders(
        options.shaders.empty() ? std::nullopt : std::optional<std::string>(options.shaders));
    const Bytes memory = parseMemory("--gpu-memory", options.gpuMemory);
    std::string backend = options.backend;
    if (backend == "window") throw UsageError{"--backend window is for gnomon view"};
    if (backend == "auto") backend = gl::hasGpu() ? "egl" : "software";
    if (backend == "software") return executor::makeSoftwareExecutor();
    return executor::makeGlExecutor(backend == "egl" ? gl::Platform::Egl : gl::Platform::Osmesa, shaders, memory);
}

Session::Session(const std::string& modelPath, const ViewOptions& options)
    : model_(modelPath),
      executor_(makeExecutor(options)),
      renderer_(
          model_,
          *executor_,
          {.memory = parseMemory("--memory", options.memory), .onDamaged = [](const streaming::DamagedPage& page) {
               std::fprintf(
                   stderr, "gnomon: warning: a page is damaged, its parents are drawn: %s\n", page.reason.c_str());
           }}) {}

} // namespace gnomon::app
