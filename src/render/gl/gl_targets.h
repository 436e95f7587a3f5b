// The textures that OpenGL draws into: made on demand, and read back as pictures.
#pragma once

#include "core/units.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "render/backend.h"
#include "render/view/image_projection.h"

#include <algorithm>
#include <optional>

namespace gnomon::render {

/// Flips `raster` vertically, because OpenGL's first row is at the bottom.
template <class Pixel>
void flipRows(Raster<Pixel>& raster) {
    const auto width = static_cast<std::ptrdiff_t>(raster.width);
    for (int top = 0, bottom = raster.height - 1; top < bottom; ++top, --bottom) {
        const auto a = raster.pixels.begin() + top * width;
        std::swap_ranges(a, a + width, raster.pixels.begin() + bottom * width);
    }
}

/// The render targets of a frame. All functions except `bytes` and `prepare` require a prepared frame. The texture of
/// the maps can be larger than the plan requires, so that it can stay when plans change. The maps are in its first
/// columns and rows.
class GlTargets {
public:
    /// Returns the size of the textures that `prepare` would make or keep for `frame`.
    Bytes bytes(const DrawInputs& frame) const;

    /// Makes the missing textures for `frame`. Throws Error if a texture exceeds the max size of OpenGL.
    void prepare(const gl::Context& context, const DrawInputs& frame);

    /// Returns the colour texture of the image.
    const gl::Texture& color() const { return image_->color; }

    /// Returns the framebuffer of colour and reversed depth. If requested, it also has normals and positions.
    GLuint imageFramebuffer() const { return image_->framebuffer.id(); }

    bool hasShadowMaps() const { return shadow_.has_value(); }

    /// Returns the depth texture of all shadow maps.
    const gl::Texture& shadowMaps() const { return shadow_->depth; }

    GLuint shadowFramebuffer() const { return shadow_->framebuffer.id(); }

    Picture picture() const;

    /// Returns the light of a frame with `wantsLight`.
    LightPicture light() const;

    /// Returns depths along the view for an image with the given `meaning` of depth. The depth is infinite if nothing
    /// was drawn.
    FloatPicture viewDepth(const ImageDepth& meaning) const;

    /// Returns the depths of the maps, lowest row first. The result is empty without shadow maps.
    FloatPicture shadowDepth() const;

    Raster<SurfaceSample> surfaces() const;

private:
    struct Image {
        gl::Texture color;
        gl::Texture normals; // this and the next are empty unless surfaces are requested
        gl::Texture positions;
        gl::Texture light; // empty unless light is requested
        gl::Texture depth;
        gl::Framebuffer framebuffer;
    };

    struct Shadow {
        gl::Texture depth;
        gl::Framebuffer framebuffer;
        int width = 0; // size that the plan requires
        int height = 0;
    };

    void prepareImage(const gl::Api& api, const DrawInputs& frame);
    void prepareShadow(const gl::Api& api, const plan::FramePlan& plan);
    glm::ivec2 shadowSize(const plan::FramePlan& plan) const;

    std::optional<Image> image_;
    std::optional<Shadow> shadow_;
};

} // namespace gnomon::render
