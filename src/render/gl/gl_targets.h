// The textures that OpenGL draws into. They are created on demand and can be read back as pictures.
#pragma once

#include "core/units.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "render/backend.h"
#include "render/view/image_projection.h"

#include <algorithm>
#include <optional>

namespace gnomon::render {

/// Flips `raster` vertically, because the first row of an OpenGL image is the bottom row.
template <class Pixel>
void flipRows(Raster<Pixel>& raster) {
    const auto width = static_cast<std::ptrdiff_t>(raster.width);
    for (int top = 0, bottom = raster.height - 1; top < bottom; ++top, --bottom) {
        const auto a = raster.pixels.begin() + top * width;
        std::swap_ranges(a, a + width, raster.pixels.begin() + bottom * width);
    }
}

/// The textures that a frame draws into. Call `prepare` for the frame before any other function except `bytes`. The
/// depth texture of the shadow maps can be larger than the plan requires, so that changed plans do not need a new
/// texture. The maps are in its first columns and rows.
class GlTargets {
public:
    /// Returns the memory that the textures will use after `prepare` for `frame`.
    Bytes bytes(const DrawInputs& frame) const;

    /// Creates the textures that `frame` needs and that do not exist. Throws Error if a texture exceeds the max size of
    /// OpenGL.
    void prepare(const gl::Context& context, const DrawInputs& frame);

    /// Returns the colour texture of the image.
    const gl::Texture& color() const { return image_->color; }

    /// Returns the framebuffer of the image, with colour and reversed depth. If surfaces are requested, it also has
    /// normals and positions.
    GLuint imageFramebuffer() const { return image_->framebuffer.id(); }

    bool hasShadowMaps() const { return shadow_.has_value(); }

    /// Returns the depth texture that contains all shadow maps.
    const gl::Texture& shadowMaps() const { return shadow_->depth; }

    GLuint shadowFramebuffer() const { return shadow_->framebuffer.id(); }

    Picture picture() const;

    /// Returns the light of each pixel. Requires a frame with `wantsLight`.
    LightPicture light() const;

    /// Returns the view depth of each pixel, or infinity where nothing was drawn. `meaning` converts stored depths to
    /// view depths.
    FloatPicture viewDepth(const ImageDepth& meaning) const;

    /// Returns the depths of all shadow maps, lowest row first, or an empty raster without shadow maps.
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
