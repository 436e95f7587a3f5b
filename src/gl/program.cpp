#include "gl/program.h"

#include "core/error.h"

#include <array>
#include <sstream>
#include <utility>

namespace gnomon::gl {

namespace {

constexpr GLsizei kLogBytes = 2048;

/// Joins the lines of the driver's log for an error message of one line.
std::string oneLine(const char* log) {
    std::string line;
    std::istringstream lines{std::string(log)};
    for (std::string next; std::getline(lines, next);)
        if (!next.empty()) line += (line.empty() ? "" : "; ") + next;
    return line;
}

/// A compiled shader. Its destructor deletes it, because the linked program has its own copy.
class Shader {
public:
    Shader(const Api& api, GLenum stage, const std::string& path, const std::string& source)
        : api_(api), id_(api.createShader(stage)) {
        const char* const text = source.c_str();
        api.shaderSource(id_, 1, &text, nullptr);
        api.compileShader(id_);
        GLint compiled = 0;
        api.getShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled != 0) return;
        std::array<char, kLogBytes> log{};
        api.getShaderInfoLog(id_, kLogBytes, nullptr, log.data());
        api.deleteShader(id_);
        throw Error(path, "this shader does not compile: " + oneLine(log.data()));
    }

    ~Shader() { api_.deleteShader(id_); }

    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    Shader(Shader&&) = delete;
    Shader& operator=(Shader&&) = delete;

    GLuint id() const { return id_; }

private:
    const Api& api_;
    GLuint id_;
};

} // namespace

Program::Program(
    const Api& api,
    const ShaderLibrary& library,
    std::string_view vertexPath,
    std::string_view fragmentPath,
    std::string_view defines)
    : api_(&api) {
    const Shader vertex(api, GL_VERTEX_SHADER, std::string(vertexPath), library.source(vertexPath, defines));
    const Shader fragment(api, GL_FRAGMENT_SHADER, std::string(fragmentPath), library.source(fragmentPath, defines));
    id_ = api.createProgram();
    api.attachShader(id_, vertex.id());
    api.attachShader(id_, fragment.id());
    api.linkProgram(id_);
    GLint linked = 0;
    api.getProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked != 0) return;
    std::array<char, kLogBytes> log{};
    api.getProgramInfoLog(id_, kLogBytes, nullptr, log.data());
    api.deleteProgram(std::exchange(id_, 0));
    throw Error(std::string(fragmentPath), "this program does not link: " + oneLine(log.data()));
}

Program::~Program() {
    if (id_ != 0) api_->deleteProgram(id_);
}

Program::Program(Program&& other) noexcept : api_(other.api_), id_(std::exchange(other.id_, 0)) {}

Program& Program::operator=(Program&& other) noexcept {
    std::swap(api_, other.api_);
    std::swap(id_, other.id_);
    return *this;
}

} // namespace gnomon::gl
