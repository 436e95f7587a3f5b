// A linked GLSL program.
#pragma once

#include "gl/api.h"
#include "gl/shader_library.h"

namespace gnomon::gl {

/// A linked OpenGL program of a vertex and a fragment shader, which can be moved but not copied.
class Program {
public:
    Program() = default;
    /// Compiles the shaders `vertexPath` and `fragmentPath` of `library` and links them. `defines` ("#define A 1\n...")
    /// come before the text of both. Throws Error with the driver's log.
    Program(
        const Api& api,
        const ShaderLibrary& library,
        std::string_view vertexPath,
        std::string_view fragmentPath,
        std::string_view defines = {});
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&& other) noexcept;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    GLuint id() const { return id_; }

private:
    const Api* api_ = nullptr;
    GLuint id_ = 0;
};

} // namespace gnomon::gl
