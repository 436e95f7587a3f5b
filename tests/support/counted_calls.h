// A context that counts the calls of each OpenGL function.
#pragma once

#include "gl/native_context.h"
#include "tests/support/tested_platform.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::gl {

namespace counted {

enum class Name : std::size_t {
#define GNOMON_GL_NAME(type, member, name) member,
    GNOMON_GL_FUNCTIONS(GNOMON_GL_NAME)
#undef GNOMON_GL_NAME
        Count
};

// Globals, because OpenGL functions have no argument for user data.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
inline std::array<std::uint64_t, static_cast<std::size_t>(Name::Count)> calls{};
inline FunctionSource source = nullptr;

/// A wrapper that counts a call under `kName` and then calls the real function.
template <Name kName, class Function>
struct Layer;

template <Name kName, class Result, class... Arguments>
struct Layer<kName, Result(APIENTRYP)(Arguments...)> {
    static inline Result(APIENTRYP real)(Arguments...) = nullptr;

    static Result APIENTRY call(Arguments... arguments) {
        ++calls[static_cast<std::size_t>(kName)];
        return real(arguments...);
    }
};

// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

inline FunctionPointer function(const char* wanted) {
#define GNOMON_GL_LAYER(type, member, name)                                                                            \
    if (std::string_view(wanted) == (name)) {                                                                          \
        using Of = Layer<Name::member, type>;                                                                          \
        Of::real = reinterpret_cast<type>(source(wanted));                                                             \
        return reinterpret_cast<FunctionPointer>(&Of::call);                                                           \
    }
    GNOMON_GL_FUNCTIONS(GNOMON_GL_LAYER)
#undef GNOMON_GL_LAYER
    return nullptr;
}

} // namespace counted

class CountedContext final : public NativeContext {
public:
    CountedContext()
        : real_(testedPlatform() == Platform::Egl ? makeEglContext([](const std::string&) {}) : makeOsmesaContext()) {
        counted::source = real_->functionSource();
    }

    FunctionSource functionSource() const override { return &counted::function; }

private:
    std::unique_ptr<NativeContext> real_;
};

/// Resets all counts.
inline void forgetCalls() {
    counted::calls = {};
}

inline std::uint64_t calls(counted::Name name) {
    return counted::calls[static_cast<std::size_t>(name)];
}

inline std::uint64_t allCalls() {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counted::calls)
        sum += count;
    return sum;
}

} // namespace gnomon::gl
