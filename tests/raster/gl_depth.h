// The same clusters drawn by OpenGL into a depth texture, as reference for the rasteriser.
#pragma once

#include "gl/context.h"
#include "gl/objects.h"
#include "gl/program.h"
#include "raster/raster.h"

#include <vector>

namespace gnomon::raster {

/// Clusters in GL buffers and a square depth texture.
class GlDepth {
public:
    GlDepth(const gl::Context& context, std::span<const Cluster> clusters, int side);

    /// Draws all clusters into the whole texture and waits for the GPU. If `reversed`, depth goes from 1 at near to 0;
    /// otherwise depth is clamped.
    void draw(const View& view, bool reversed) const;

    std::vector<float> depths() const;

private:
    const gl::Context& context_;
    gl::Program program_;
    gl::Texture depth_;
    gl::Framebuffer target_;
    gl::Buffer buffer_;
    gl::VertexArray vertices_;
    std::vector<GLsizei> counts_;
    std::vector<const void*> offsets_;
    std::vector<GLint> bases_;
};

} // namespace gnomon::raster
