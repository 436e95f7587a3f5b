// Takes the place of libEGL: knows $EGL_GPUS devices that look like GPUs, of which the first $EGL_DEAD cannot be
// opened, as outside a job's cgroup. The others are Mesa's surfaceless platform.
#include <array>
#include <cstdlib>
#include <cstring>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

namespace {

constexpr int kMaxDevices = 4;
// Their addresses name them. NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::array<char, kMaxDevices> devices{};

int numberOf(const char* variable) {
    const char* text = std::getenv(variable);
    return text == nullptr ? 0 : std::atoi(text);
}

template <class Function>
Function real(const char* name) {
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): dlopen returns no pointer to const
    static void* const library = dlopen("/usr/lib/x86_64-linux-gnu/libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    return reinterpret_cast<Function>(dlsym(library, name));
}

bool isDead(const void* device) {
    for (int i = 0; i < numberOf("EGL_DEAD"); ++i)
        if (device == &devices.at(static_cast<std::size_t>(i))) return true;
    return false;
}

EGLBoolean queryDevices(EGLint max, EGLDeviceEXT* list, EGLint* count) {
    *count = numberOf("EGL_GPUS");
    for (EGLint i = 0; list != nullptr && i < max && i < *count; ++i)
        list[i] = &devices.at(static_cast<std::size_t>(i));
    return EGL_TRUE;
}

const char* queryDeviceString(EGLDeviceEXT /*device*/, EGLint /*name*/) {
    return "EGL_EXT_device_drm";
}

} // namespace

// NOLINTBEGIN(readability-identifier-naming, readability-inconsistent-declaration-parameter-name): the names are EGL's
extern "C" {

EGLDisplay eglGetPlatformDisplay(EGLenum /*platform*/, void* device, const EGLAttrib* attributes) {
    if (isDead(device)) return device;
    return real<PFNEGLGETPLATFORMDISPLAYPROC>("eglGetPlatformDisplay")(
        EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, attributes);
}

EGLBoolean eglInitialize(EGLDisplay display, EGLint* major, EGLint* minor) {
    return isDead(display) ? EGL_FALSE : real<PFNEGLINITIALIZEPROC>("eglInitialize")(display, major, minor);
}

__eglMustCastToProperFunctionPointerType eglGetProcAddress(const char* name) {
    using Pointer = __eglMustCastToProperFunctionPointerType;
    if (std::strcmp(name, "eglQueryDevicesEXT") == 0) return reinterpret_cast<Pointer>(&queryDevices);
    if (std::strcmp(name, "eglQueryDeviceStringEXT") == 0) return reinterpret_cast<Pointer>(&queryDeviceString);
    return real<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress")(name);
}

EGLBoolean eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read, EGLContext context) {
    return real<PFNEGLMAKECURRENTPROC>("eglMakeCurrent")(display, draw, read, context);
}

EGLBoolean eglDestroyContext(EGLDisplay display, EGLContext context) {
    return real<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")(display, context);
}

EGLBoolean eglBindAPI(EGLenum api) {
    return real<PFNEGLBINDAPIPROC>("eglBindAPI")(api);
}

EGLBoolean eglChooseConfig(EGLDisplay display, const EGLint* wanted, EGLConfig* configs, EGLint size, EGLint* count) {
    return real<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig")(display, wanted, configs, size, count);
}

EGLContext eglCreateContext(EGLDisplay display, EGLConfig config, EGLContext shared, const EGLint* attributes) {
    return real<PFNEGLCREATECONTEXTPROC>("eglCreateContext")(display, config, shared, attributes);
}

EGLContext eglGetCurrentContext() {
    return real<PFNEGLGETCURRENTCONTEXTPROC>("eglGetCurrentContext")();
}
}
// NOLINTEND(readability-identifier-naming, readability-inconsistent-declaration-parameter-name)
