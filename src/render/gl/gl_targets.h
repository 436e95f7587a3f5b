// The textures that OpenGL draws into. They are created on demand, and can be read back as pictures.
#pragma once

#include "core/units.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "render/backend.h"
#include "render/view/image_projection.h"

#include <algorithm>
#include <optional>

namespace gnomon::render {

/// Flips `raster` vertically, because the first row of OpenGL is the bottom row.
template <class Pixel>
void flipRows(Raster<Pixel>& raster) {
    const auto width = static_cast<std::ptrdiff_t>(raster.width);
    for (int top = 0, bottom = raster.height - 1; top < bottom; ++top, --bottom) {
        const auto a = raster.pixels.begin() + top * width;
        std::swap_ranges(a, a + width, raster.pixels.begin() + bottom * width);
    }
}

/// The render targets of a frame. All functions except `bytes` and `prepare` require a frame for which `prepare` was
/// called. The texture of the maps can be larger than the plan requires, so that it need not be created again when
/// plans change. The maps are in its first columns and rows.
class GlTargets {
public:
    /// Returns the memory of the textures that exist after `prepare` for `frame`.
    Bytes bytes(const DrawInputs& frame) const;

    /// Creates the missing textures for `frame`. Throws Error if a texture exceeds the max size of OpenGL.
    void prepare(const gl::Context& context, const DrawInputs& frame);

    /// Returns the colour texture of the image.
    const gl::Texture& color() const { return image_->color; }

    /// Returns the framebuffer with colour and reversed depth, and with normals and positions if surfaces are
    /// requested.
    GLuint imageFramebuffer() const { return image_->framebuffer.id(); }

    bool hasShadowMaps() const { return shadow_.has_value(); }

    /// Returns the depth texture of all shadow maps.
    const gl::Texture& shadowMaps() const { return shadow_->depth; }

    GLuint shadowFramebuffer() const { return shadow_->framebuffer.id(); }

    Picture picture() const;

    /// Returns the light of the image, of a frame with `wantsLight`.
    LightPicture light() const;

    /// Returns the view depths of the image. `meaning` converts its stored depths. Pixels where nothing was drawn have
    /// infinite depth.
    FloatPicture viewDepth(const ImageDepth& meaning) const;

    /// Returns the depths of the shadow maps, lowest row first. The result is empty without shadow maps.
    FloatPicture shadowDepth() const;

    Raster<SurfaceSample> surfaces() const;

private:
    struct Image {
        gl::Texture color;
        gl::Texture normals; // empty, like `positions`, unless surfaces are requested
        gl::Texture positions;
        gl::Texture light; // empty unless light is requested
        gl::Texture depth;
        gl::Framebuffer framebuffer;
    };

    struct Shadow {
        gl::Texture depth;
        gl::Framebuffer framebuffer;
        int width = 0; // size that the plan requires, in texels
        int height = 0;
    };

    void prepareImage(const gl::Api& api, const DrawInputs& frame);
    void prepareShadow(const gl::Api& api, const plan::FramePlan& plan);
    glm::ivec2 shadowSize(const plan::FramePlan& plan) const;

    std::optional<Image> image_;
    std::optional<Shadow> shadow_;
};

} // namespace gnomon::render
