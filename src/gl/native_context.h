// The interface to a platform: a context that is current, and its OpenGL functions. Each platform has one
// implementation.
#pragma once

#include "core/error.h"
#include "gl/api.h"

#include <cstring>
#include <functional>
#include <memory>
#include <string>

#include <dlfcn.h>

namespace gnomon::gl {

/// A context of a platform, current on the thread that made it.
class NativeContext {
public:
    NativeContext() = default;
    virtual ~NativeContext() = default;
    NativeContext(const NativeContext&) = delete;
    NativeContext& operator=(const NativeContext&) = delete;
    NativeContext(NativeContext&&) = delete;
    NativeContext& operator=(NativeContext&&) = delete;

    virtual FunctionSource functionSource() const = 0;

    /// Makes the context current on this thread again, if another context of this process replaced it.
    virtual void makeCurrent() {}
};

/// Throws Error if the address space is too small for the compiler and the threads of a software driver. Such a driver
/// would crash.
void requireAddressSpace(const char* platform);

/// Makes a core 4.5 context of OSMesa. Throws Error if that is impossible.
std::unique_ptr<NativeContext> makeOsmesaContext();

/// Makes a core 4.5 context of EGL without a surface, on the first usable GPU. If EGL has no GPU, uses its surfaceless
/// platform. Calls `warn`, if given, with the reason for each unusable GPU. Throws Error if no context can be made.
std::unique_ptr<NativeContext> makeEglContext(const std::function<void(const std::string&)>& warn);

/// A shared library that is opened on demand. Linking it would load LLVM into each `gnomon build`. The library stays
/// open, because drivers crash when they are unloaded.
class Library {
public:
    explicit Library(const char* name) : name_(name), handle_(::dlopen(name, RTLD_NOW | RTLD_LOCAL)) {
        if (handle_ == nullptr) reason_ = ::dlerror(); // NOLINT(concurrency-mt-unsafe): it is of this thread
    }

    bool isOpen() const { return handle_ != nullptr; }

    /// Returns the function `symbol`. Throws Error if the library or the function is missing.
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
