#include "tests/raster/gl_depth.h"

#include <glm/gtc/type_ptr.hpp>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace gnomon::raster {
namespace {

/// A folder with the two shaders, beside other temporary files.
std::string shaderFolder() {
    std::string folder =
        (std::filesystem::temp_directory_path() / ("gnomon_raster_shaders_" + std::to_string(::getpid()))).string();
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/depth.vert") << "layout(location = 0) in uvec3 position;\n"
                                             "uniform mat4 clipFromCell;\n"
                                             "uniform vec4 eyeCell;\n"
                                             "void main() {\n"
                                             "    ivec3 cell = ivec3(position - uvec3(floatBitsToUint(eyeCell.xyz)));\n"
                                             "    gl_Position = clipFromCell * vec4(vec3(cell), 1.0);\n"
                                             "}\n";
    std::ofstream(folder + "/depth.frag") << "void main() {}\n";
    return folder;
}

constexpr std::size_t kVertexBytes = 12;

} // namespace

GlDepth::GlDepth(const gl::Context& context, std::span<const Cluster> clusters, int side)
    : context_(context),
      program_(context.api(), gl::ShaderLibrary(shaderFolder()), "depth.vert", "depth.frag"),
      depth_(context.api(), GL_DEPTH_COMPONENT32F, side, side),
      target_(context.api(), {}, depth_) {
    std::vector<std::uint32_t> words;
    std::vector<std::uint8_t> indices;
    std::size_t vertexWords = 0;
    for (const Cluster& cluster : clusters)
        vertexWords += std::size_t{3} * cluster.vertexCount;
    for (const Cluster& cluster : clusters) {
        bases_.push_back(static_cast<GLint>(words.size() / 3));
        words.insert(words.end(), cluster.positions, cluster.positions + std::size_t{3} * cluster.vertexCount);
        counts_.push_back(static_cast<GLsizei>(3 * cluster.triangles.size()));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): GL takes offsets as pointers
        offsets_.push_back(reinterpret_cast<const void*>(vertexWords * sizeof(std::uint32_t) + indices.size()));
        for (const Triangle& triangle : cluster.triangles)
            indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    const std::size_t vertexBytes = vertexWords * sizeof(std::uint32_t);
    buffer_ = gl::Buffer(context.api(), vertexBytes + indices.size());
    buffer_.write(0, std::as_bytes(std::span(words)));
    buffer_.write(vertexBytes, std::as_bytes(std::span(indices)));
    const std::array<gl::Attribute, 1> attributes = {gl::Attribute{0, 3, GL_UNSIGNED_INT, true, 0}};
    const std::array<gl::VertexStream, 1> streams = {gl::VertexStream{0, kVertexBytes}};
    vertices_ = gl::VertexArray(context.api(), buffer_, streams, attributes);
}

void GlDepth::draw(const View& view, bool reversed) const {
    const gl::Api& api = context_.api();
    api.bindFramebuffer(GL_FRAMEBUFFER, target_.id());
    api.viewport(view.viewport.x0, view.viewport.y0, view.viewport.width(), view.viewport.height());
    const float clear = reversed ? 0 : 1;
    api.clearNamedFramebufferfv(target_.id(), GL_DEPTH, 0, &clear);
    api.enable(GL_DEPTH_TEST);
    api.depthFunc(reversed ? GL_GREATER : GL_LESS);
    reversed ? api.disable(GL_DEPTH_CLAMP) : api.enable(GL_DEPTH_CLAMP);
    api.useProgram(program_.id());
    const GLint matrix = api.getUniformLocation(program_.id(), "clipFromCell");
    api.programUniformMatrix4fv(program_.id(), matrix, 1, GL_FALSE, glm::value_ptr(view.clipFromCell));
    const auto bits = [&](int axis) { return std::bit_cast<float>(view.eyeCell[axis]); };
    const GLint eye = api.getUniformLocation(program_.id(), "eyeCell");
    api.programUniform4f(program_.id(), eye, bits(0), bits(1), bits(2), 0);
    api.bindVertexArray(vertices_.id());
    api.multiDrawElementsBaseVertex(
        GL_TRIANGLES,
        counts_.data(),
        GL_UNSIGNED_BYTE,
        offsets_.data(),
        static_cast<GLsizei>(counts_.size()),
        bases_.data());
    api.finish();
    context_.check("GlDepth::draw");
}

std::vector<float> GlDepth::depths() const {
    std::vector<float> depths(static_cast<std::size_t>(depth_.width()) * static_cast<std::size_t>(depth_.height()));
    depth_.read(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_writable_bytes(std::span(depths)));
    return depths;
}

} // namespace gnomon::raster
