// The textures that OpenGL draws a frame into: made as a frame needs them, and read back as pictures.
#pragma once

#include "core/units.h"
#include "executor/executor.h"
#include "executor/view/lens.h"
#include "gl/context.h"
#include "gl/objects.h"

#include <algorithm>
#include <optional>

namespace gnomon::executor {

/// Turns `raster` upside down: the rows of OpenGL begin at the bottom.
template <class Pixel>
void flipRows(Raster<Pixel>& raster) {
    const auto width = static_cast<std::ptrdiff_t>(raster.width);
    for (int top = 0, bottom = raster.height - 1; top < bottom; ++top, --bottom) {
        const auto a = raster.pixels.begin() + top * width;
        std::swap_ranges(a, a + width, raster.pixels.begin() + bottom * width);
    }
}

/// Everything but `bytes` and `prepare` needs a frame that was prepared. The texture of the maps may be larger than a
/// plan's: it is kept while plans change their shape, and maps lie in its first columns and rows.
class GlTargets {
public:
    /// What the textures that `frame` is drawn into take: those that `prepare` makes or keeps.
    Bytes bytes(const FrameDrawing& frame) const;

    /// Makes what `frame` needs and the last frame did not leave. Throws Error if that is larger than a texture can be.
    void prepare(const gl::Context& context, const FrameDrawing& frame);

    /// The colours of the image.
    const gl::Texture& color() const { return image_->color; }

    /// Of colours, depth (reversed) and, when wanted, normals and positions.
    GLuint imageFramebuffer() const { return image_->framebuffer.id(); }

    bool hasShadowMaps() const { return shadow_.has_value(); }

    /// The depths of all shadow maps.
    const gl::Texture& shadowMaps() const { return shadow_->depth; }

    GLuint shadowFramebuffer() const { return shadow_->framebuffer.id(); }

    Picture picture() const;

    /// Of a frame that wants it.
    LightPicture light() const;

    /// Depths along the view, of an image whose depths have this `meaning`; infinite where nothing was drawn.
    FloatPicture viewDepth(const ImageDepth& meaning) const;

    /// As drawn, the lowest row first; empty without shadow maps.
    FloatPicture shadowDepth() const;

    Raster<SurfaceSample> surfaces() const;

private:
    struct Image {
        gl::Texture color;
        gl::Texture normals; // these two are empty unless surfaces are wanted
        gl::Texture positions;
        gl::Texture light; // empty unless that is
        gl::Texture depth;
        gl::Framebuffer framebuffer;
    };

    struct Shadow {
        gl::Texture depth;
        gl::Framebuffer framebuffer;
        int width = 0; // of the plan's
        int height = 0;
    };

    void prepareImage(const gl::Api& api, const FrameDrawing& frame);
    void prepareShadow(const gl::Api& api, const plan::FramePlan& plan);
    glm::ivec2 shadowSize(const plan::FramePlan& plan) const;

    std::optional<Image> image_;
    std::optional<Shadow> shadow_;
};

} // namespace gnomon::executor
