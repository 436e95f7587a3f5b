// The interface to a platform (OSMesa, EGL or GLFW) that creates an OpenGL context and loads its functions. Each
// platform has one implementation.
#pragma once

#include "core/error.h"
#include "gl/api.h"

#include <cstring>
#include <functional>
#include <memory>
#include <string>

#include <dlfcn.h>

namespace gnomon::gl {

/// An OpenGL context of a platform. It is current on the thread that created it.
class NativeContext {
public:
    NativeContext() = default;
    virtual ~NativeContext() = default;
    NativeContext(const NativeContext&) = delete;
    NativeContext& operator=(const NativeContext&) = delete;
    NativeContext(NativeContext&&) = delete;
    NativeContext& operator=(NativeContext&&) = delete;

    virtual FunctionSource functionSource() const = 0;

    /// Makes the OpenGL context current on this thread again, if another context of this process replaced it.
    virtual void makeCurrent() {}
};

/// Throws Error if the address space of the process is too small for a software driver, with its compiler and threads.
/// Such a driver would crash instead of reporting the error.
void requireAddressSpace(const char* platform);

/// Creates an OpenGL 4.5 core context of OSMesa. Throws Error if that is impossible.
std::unique_ptr<NativeContext> makeOsmesaContext();

/// Creates an OpenGL 4.5 core context of EGL without a surface, on the first usable GPU. If EGL has no GPU, uses its
/// surfaceless platform. Calls `warn`, if given, with the reason for each unusable GPU. Throws Error if no context can
/// be created.
std::unique_ptr<NativeContext> makeEglContext(const std::function<void(const std::string&)>& warn);

/// A shared library that is opened on demand. A linked library would load LLVM into each `gnomon build`. The library
/// stays open, because drivers crash when they are unloaded.
class Library {
public:
    explicit Library(const char* name) : name_(name), handle_(::dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
        if (handle_ == nullptr) reason_ = ::dlerror(); // NOLINT(concurrency-mt-unsafe): it is of this thread
    }

    bool isOpen() const { return handle_ != nullptr; }

    /// Returns the function `symbol` of the library. Throws Error if the library or the function is missing.
    template <class Function>
    Function function(const char* symbol) const {
        if (handle_ == nullptr) throw Error(name_, "cannot load this library: " + reason_);
        void* const address = ::dlsym(handle_, symbol);
        if (address == nullptr) throw Error(name_, std::string("the library has no function ") + symbol);
        Function result = nullptr;
        static_assert(sizeof result == sizeof address);
        std::memcpy(&result, &address, sizeof result);
        return result;
    }

private:
    const char* name_;
    void* handle_;
    std::string reason_; // why the library is not open
};

} // namespace gnomon::gl
