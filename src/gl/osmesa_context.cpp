#include "gl/native_context.h"

#include <array>

namespace gnomon::gl {

namespace {

// Constants of libOSMesa, copied from its manual. Its own header would include the system's gl.h of OpenGL 1.x.
constexpr std::array<int, 13> kAttributes = {
    0x22,   // OSMESA_FORMAT
    0x1908, // OSMESA_RGBA
    0x30,   // OSMESA_DEPTH_BITS: 0, because all drawing goes into framebuffer objects
    0,
    0x33, // OSMESA_PROFILE
    0x34, // OSMESA_CORE_PROFILE
    0x36, // OSMESA_CONTEXT_MAJOR_VERSION
    4,
    0x37, // OSMESA_CONTEXT_MINOR_VERSION
    5,
    0,
    0,
    0};

using CreateContext = void* (*)(const int*, void*);
using MakeCurrent = GLboolean (*)(void*, void*, GLenum, GLsizei, GLsizei);
using DestroyContext = void (*)(void*);
using CurrentContext = void* (*)();

class OsmesaContext final : public NativeContext {
public:
    OsmesaContext() {
        requireAddressSpace("OSMesa");
        context_ = library_.function<CreateContext>("OSMesaCreateContextAttribs")(kAttributes.data(), nullptr);
        if (context_ == nullptr) throw Error("OSMesa", "cannot create a context", "OpenGL 4.5 core", "none");
        if (makeCurrent_(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
            destroy_(context_);
            throw Error("OSMesa", "the context cannot be made current");
        }
    }

    ~OsmesaContext() override { destroy_(context_); }

    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;
    OsmesaContext(OsmesaContext&&) = delete;
    OsmesaContext& operator=(OsmesaContext&&) = delete;

    void makeCurrent() override {
        if (current_() == context_) return;
        if (makeCurrent_(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE)
            throw Error("OSMesa", "the context cannot be made current");
    }

    FunctionSource functionSource() const override { return library_.function<FunctionSource>("OSMesaGetProcAddress"); }

private:
    Library library_{"libOSMesa.so.8"};
    MakeCurrent makeCurrent_ = library_.function<MakeCurrent>("OSMesaMakeCurrent");
    CurrentContext current_ = library_.function<CurrentContext>("OSMesaGetCurrentContext");
    DestroyContext destroy_ = library_.function<DestroyContext>("OSMesaDestroyContext");
    void* context_ = nullptr;
    std::array<GLubyte, 4> pixel_{}; // the default framebuffer, which OSMesa requires
};

} // namespace

std::unique_ptr<NativeContext> makeOsmesaContext() {
    return std::make_unique<OsmesaContext>();
}

} // namespace gnomon::gl
