// What a platform gives: a current context and its functions. One implementation per platform.
#pragma once

#include "core/error.h"
#include "gl/api.h"

#include <cstring>
#include <functional>
#include <memory>
#include <string>

#include <dlfcn.h>

namespace gnomon::gl {

/// A platform's context, current on the thread that made it.
class NativeContext {
public:
    NativeContext() = default;
    virtual ~NativeContext() = default;
    NativeContext(const NativeContext&) = delete;
    NativeContext& operator=(const NativeContext&) = delete;
    NativeContext(NativeContext&&) = delete;
    NativeContext& operator=(NativeContext&&) = delete;

    virtual FunctionSource functionSource() const = 0;

    /// Makes it current on this thread again, where another one of this process may have taken its place.
    virtual void makeCurrent() {}
};

/// Throws Error where a driver in software would not find the address space for its compiler and threads: it crashes
/// then.
void requireAddressSpace(const char* platform);

/// A core 4.5 context of OSMesa. Throws Error if there is none.
std::unique_ptr<NativeContext> makeOsmesaContext();

/// A core 4.5 context of EGL without a surface, on the first GPU that can be used; on EGL's surfaceless platform if EGL
/// knows no GPU. Tells `warn`, if given, why a GPU cannot be used. Throws Error if there is none.
std::unique_ptr<NativeContext> makeEglContext(const std::function<void(const std::string&)>& warn);

/// A shared library opened when it is needed: linking it would load LLVM into every `gnomon build`. It stays open,
/// since drivers do not survive being unloaded.
class Library {
public:
    explicit Library(const char* name) : name_(name), handle_(::dlopen(name, RTLD_NOW | RTLD_LOCAL)) {}

    bool isOpen() const { return handle_ != nullptr; }

    /// Throws Error if the library or the function is missing.
    template <class Function>
    Function function(const char* symbol) const {
        if (handle_ == nullptr) throw Error(name_, "this library cannot be opened");
        void* const address = ::dlsym(handle_, symbol);
        if (address == nullptr) throw Error(name_, std::string("this library has no function ") + symbol);
        Function result = nullptr;
        static_assert(sizeof result == sizeof address);
        std::memcpy(&result, &address, sizeof result);
        return result;
    }

private:
    const char* name_;
    void* handle_;
};

} // namespace gnomon::gl
