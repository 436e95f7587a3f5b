#include "gl/context.h"

#include "core/heap.h"
#include "core/units.h"

#include <array>
#include <cstdio>

namespace gnomon::gl {

Api loadApi(FunctionSource source) {
    Api api;
#define GNOMON_GL_LOAD(type, member, name)                                                                             \
    api.member = reinterpret_cast<type>(source(name));                                                                 \
    if (api.member == nullptr) throw Error("OpenGL", "a function is missing", "OpenGL 4.5", "no " name);
    GNOMON_GL_FUNCTIONS(GNOMON_GL_LOAD)
#undef GNOMON_GL_LOAD
    return api;
}

void requireAddressSpace(const char* platform) {
    constexpr Bytes kNeeded = mebibytes(512);
    if (!isAddressSpaceLeft(kNeeded))
        throw Error(platform, "too little address space (ulimit -v)", readableBytes(kNeeded) + " more", "less");
}

Context::Context(Platform platform, const std::function<void(const std::string&)>& warn)
    : Context(platform == Platform::Osmesa ? makeOsmesaContext() : makeEglContext(warn)) {}

Context::Context(std::unique_ptr<NativeContext> native)
    : native_(std::move(native)),
      api_(std::make_unique<Api>(loadApi(native_->functionSource()))),
      renderer_(reinterpret_cast<const char*>(api_->getString(GL_RENDERER))) {
    api_->getIntegerv(GL_MAX_TEXTURE_SIZE, &maxTextureSize_);
    api_->clipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api_->pixelStorei(GL_PACK_ALIGNMENT, 1);
    api_->pixelStorei(GL_UNPACK_ALIGNMENT, 1);
    check("context");
}

CurrentAtDestruction::~CurrentAtDestruction() {
    try {
        context_->makeCurrent();
    } catch (const Error&) {
        // If the driver failed, there is no OpenGL object to delete.
    }
}

bool Context::isHardware() const {
    return renderer_.find("llvmpipe") == std::string::npos && renderer_.find("softpipe") == std::string::npos &&
           renderer_.find("swrast") == std::string::npos;
}

void Context::check(const char* where) const {
    const GLenum code = api_->getError();
    if (code == GL_NO_ERROR) return;
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%04X", code);
    throw Error(
        std::string("OpenGL, ") + where,
        code == GL_OUT_OF_MEMORY ? "out of memory" : "an error was recorded",
        "none",
        text.data());
}

} // namespace gnomon::gl
