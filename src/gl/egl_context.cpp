#include "core/formatted.h"
#include "gl/context.h"
#include "gl/native_context.h"

#include <array>
#include <string_view>
#include <vector>

#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace gnomon::gl {

namespace {

bool hasWord(const char* list, std::string_view word) {
    return list != nullptr && std::string_view(list).find(word) != std::string_view::npos;
}

class Egl {
public:
    bool isOpen() const { return library_.isOpen(); }

    template <class Function>
    Function function(const char* name) const {
        return library_.function<Function>(name);
    }

    /// Returns the function of an EGL extension, or null if the extension is missing.
    template <class Function>
    Function extension(const char* name) const {
        return reinterpret_cast<Function>(function<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress")(name));
    }

    /// Returns all EGL devices except Mesa's software device, in the order of EGL.
    std::vector<EGLDeviceEXT> gpus() const {
        const auto queryDevices = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
        const auto queryString = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
        if (queryDevices == nullptr || queryString == nullptr) return {};
        EGLint count = 0;
        if (queryDevices(0, nullptr, &count) == EGL_FALSE || count == 0) return {};
        std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
        if (queryDevices(count, devices.data(), &count) == EGL_FALSE) return {};
        devices.resize(static_cast<std::size_t>(count));
        std::erase_if(devices, [&](EGLDeviceEXT device) {
            return hasWord(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
        });
        return devices;
    }

private:
    Library library_{"libEGL.so.1"};
};

constexpr std::array<EGLint, 7> kContextAttributes = {
    EGL_CONTEXT_MAJOR_VERSION,
    4,
    EGL_CONTEXT_MINOR_VERSION,
    5,
    EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
    EGL_NONE};

class EglContext final : public NativeContext {
public:
    explicit EglContext(const std::function<void(const std::string&)>& warn) {
        requireAddressSpace("EGL");
        const std::vector<EGLDeviceEXT> gpus = egl_.gpus();
        const auto platformDisplay = egl_.function<PFNEGLGETPLATFORMDISPLAYPROC>("eglGetPlatformDisplay");
        if (gpus.empty()) open(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
        for (std::size_t i = 0; i < gpus.size() && context_ == EGL_NO_CONTEXT; ++i) {
            try {
                open(platformDisplay(EGL_PLATFORM_DEVICE_EXT, gpus[i], nullptr));
            } catch (const Error& error) {
                const std::string failure = formatted("GPU %zu of %zu: ", i + 1, gpus.size()) + error.what();
                if (i + 1 == gpus.size()) throw Error("EGL", "no GPU can be used; the last failed: " + failure);
                if (warn) warn(failure + "; the next GPU is tried");
            }
        }
    }

    ~EglContext() override {
        if (isCurrent()) makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        egl_.function<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")(display_, context_);
        // The EGL display is not terminated, because another context of this process may use it.
    }

    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    EglContext(EglContext&&) = delete;
    EglContext& operator=(EglContext&&) = delete;

    void makeCurrent() override {
        if (isCurrent()) return;
        if (makeCurrent_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            throw Error("EGL", "the context cannot be made current without a surface");
    }

    FunctionSource functionSource() const override { return egl_.function<FunctionSource>("eglGetProcAddress"); }

private:
    bool isCurrent() const { return current_() == context_; }

    void open(EGLDisplay display) {
        display_ = display;
        if (display_ == EGL_NO_DISPLAY ||
            egl_.function<PFNEGLINITIALIZEPROC>("eglInitialize")(display_, nullptr, nullptr) == EGL_FALSE)
            throw Error("EGL", "no display without a window system");
        makeContext();
    }

    void makeContext() {
        if (egl_.function<PFNEGLBINDAPIPROC>("eglBindAPI")(EGL_OPENGL_API) == EGL_FALSE)
            throw Error("EGL", "the display does not support desktop OpenGL");
        // Each device has a config for OpenGL. EGL_KHR_no_config_context would make a config unnecessary, but it is an
        // extension.
        const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        egl_.function<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig")(display_, wanted.data(), &config, 1, &count);
        context_ = egl_.function<PFNEGLCREATECONTEXTPROC>("eglCreateContext")(
            display_, count > 0 ? config : nullptr, EGL_NO_CONTEXT, kContextAttributes.data());
        if (context_ == EGL_NO_CONTEXT) throw Error("EGL", "cannot create a context", "OpenGL 4.5 core", "none");
        makeCurrent();
    }

    Egl egl_;
    PFNEGLMAKECURRENTPROC makeCurrent_ = egl_.function<PFNEGLMAKECURRENTPROC>("eglMakeCurrent");
    PFNEGLGETCURRENTCONTEXTPROC current_ = egl_.function<PFNEGLGETCURRENTCONTEXTPROC>("eglGetCurrentContext");
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

} // namespace

std::unique_ptr<NativeContext> makeEglContext(const std::function<void(const std::string&)>& warn) {
    return std::make_unique<EglContext>(warn);
}

bool hasGpu() {
    const Egl egl;
    return egl.isOpen() && !egl.gpus().empty();
}

} // namespace gnomon::gl
