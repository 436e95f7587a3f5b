#include "task/session.h"

#include "core/error.h"
#include "gl/context.h"
#include "render/gl/gl_backend.h"
#include "render/software_backend.h"
#include "settings/table.h"

#include <array>

namespace gnomon::task {

namespace {

std::unique_ptr<render::Backend> makeBackend(
    const settings::Settings& settings,
    settings::Backend backend,
    const std::function<void(const std::string&)>& warn) {
    using settings::Backend;
    if (backend == Backend::Software) return render::makeSoftwareBackend();
    const gl::ShaderLibrary shaders(
        settings.shaderFolder.empty() ? std::nullopt : std::optional<std::string>(settings.shaderFolder));
    const gl::Platform platform = backend == Backend::Osmesa ? gl::Platform::Osmesa : gl::Platform::Egl;
    try {
        return render::makeGlBackend(platform, shaders, settings.gpuMemory, warn);
    } catch (const Error& error) {
        if (settings.backend != Backend::Auto) throw;
        warn(std::string("the GPU cannot be used, the software backend draws: ") + error.what());
        return render::makeSoftwareBackend();
    }
}

} // namespace

settings::BackendChoice backendFor(const settings::Settings& settings, settings::DrawingCommand command, int pictures) {
    settings::BackendRequest request{settings.backend, command, pictures, true, settings::softwareNeed(settings)};
    const bool canUseGpu = settings::chooseBackend(request).backend != settings::Backend::Software;
    if (settings.backend == settings::Backend::Auto && canUseGpu) request.hasGpu = gl::hasGpu();
    return settings::chooseBackend(request);
}

Session::Session(
    const std::string& modelPath,
    const settings::Settings& settings,
    const std::function<void(const std::string&)>& warn,
    settings::Backend backend)
    : warn_(warn),
      model_(modelPath, settings.memory),
      backend_(makeBackend(settings, backend, warn)),
      renderer_(
          model_,
          *backend_,
          {.memory = settings.memory,
           .onDamaged =
               [warn](const lod::DamagedPage& page) {
                   warn("a page is damaged, coarser pages are drawn instead: " + page.reason);
               },
           .holdsPictures = backend_->capabilities().bands}) {}

std::string shortfallLine(const telemetry::Shortfall& shortfall) {
    std::string text = shortfall.text();
    if (!shortfall.lacksMemory()) return text;
    return text + " (" + settings::optionsOf(std::array{Limit::PageMemory}) + ")";
}

void Session::tellShortfall() {
    if (const std::string line = shortfallLine(renderer_.takeShortfall()); !line.empty()) warn_(line);
}

} // namespace gnomon::task
