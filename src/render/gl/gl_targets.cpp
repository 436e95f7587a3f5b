#include "render/gl/gl_targets.h"

#include "core/check.h"
#include "core/limit_error.h"

namespace gnomon::render {

Bytes GlTargets::bytes(const DrawInputs& frame) const {
    const auto texels = [](int width, int height) {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    };
    constexpr std::uint64_t kColorAndDepth = 4 + 4;
    constexpr std::uint64_t kSurfaces = 16 + 16;
    constexpr std::uint64_t kLight = 16;
    const plan::FramePlan& plan = *frame.plan;
    const std::uint64_t perPixel = kColorAndDepth + (frame.wantsSurfaces ? kSurfaces : 0) +
                                   (frame.wantsLight ? kLight : 0) + (frame.litMask != nullptr ? 1 : 0);
    const glm::ivec2 shadow = shadowSize(plan);
    const std::uint64_t shadows = sizeof(float) * texels(shadow.x, shadow.y);
    return {perPixel * texels(plan.view.width, plan.view.height) + shadows};
}

void GlTargets::prepare(const gl::Context& context, const DrawInputs& frame) {
    const plan::FramePlan& plan = *frame.plan;
    const int largest = std::max({plan.view.width, plan.view.height, plan.textureWidth, plan.textureHeight});
    if (largest > context.maxTextureSize())
        throw LimitError(
            {Limit::ImageSize, Limit::ShadowTexels},
            {"image size or shadow texels",
             "larger than the max texture size of this OpenGL",
             "at most " + std::to_string(context.maxTextureSize()),
             std::to_string(largest)});
    prepareImage(context.api(), frame);
    prepareShadow(context.api(), plan);
}

void GlTargets::prepareImage(const gl::Api& api, const DrawInputs& frame) {
    const int width = frame.plan->view.width;
    const int height = frame.plan->view.height;
    const bool hasSurfaces = image_ && image_->normals.id() != 0;
    const bool hasLight = image_ && image_->light.id() != 0;
    if (image_ && image_->color.width() == width && image_->color.height() == height &&
        hasSurfaces == frame.wantsSurfaces && hasLight == frame.wantsLight)
        return;
    GNOMON_CHECK(!frame.wantsSurfaces || !frame.wantsLight);
    Image image;
    image.color = gl::Texture(api, GL_RGBA8, width, height);
    image.depth = gl::Texture(api, GL_DEPTH_COMPONENT32F, width, height);
    std::vector<const gl::Texture*> colors = {&image.color};
    if (frame.wantsSurfaces) {
        image.normals = gl::Texture(api, GL_RGBA32F, width, height);
        image.positions = gl::Texture(api, GL_RGBA32F, width, height);
        colors.push_back(&image.normals);
        colors.push_back(&image.positions);
    }
    if (frame.wantsLight) {
        image.light = gl::Texture(api, GL_RGBA32F, width, height);
        colors.push_back(&image.light);
    }
    image.framebuffer = gl::Framebuffer(api, colors, image.depth);
    image_ = std::move(image);
}

void GlTargets::prepareShadow(const gl::Api& api, const plan::FramePlan& plan) {
    if (plan.passes.empty()) return shadow_.reset();
    const glm::ivec2 size = shadowSize(plan);
    if (!shadow_ || shadow_->depth.width() != size.x || shadow_->depth.height() != size.y) {
        Shadow shadow;
        shadow.depth = gl::Texture(api, GL_DEPTH_COMPONENT32F, size.x, size.y);
        shadow.framebuffer = gl::Framebuffer(api, {}, shadow.depth);
        shadow_ = std::move(shadow);
    }
    shadow_->width = plan.textureWidth;
    shadow_->height = plan.textureHeight;
}

/// Returns the size of the depth texture for the shadow maps of `plan`. Each side is the max of the current and the
/// required size. If more than half of this texture would be unused, the function returns the required size.
glm::ivec2 GlTargets::shadowSize(const plan::FramePlan& plan) const {
    if (plan.passes.empty()) return {0, 0};
    const glm::ivec2 needed(plan.textureWidth, plan.textureHeight);
    if (!shadow_) return needed;
    constexpr double kMaxIdle = 0.5;
    const glm::ivec2 both = glm::max(needed, glm::ivec2(shadow_->depth.width(), shadow_->depth.height()));
    const auto area = [](const glm::ivec2& size) { return static_cast<double>(size.x) * size.y; };
    return area(needed) >= (1 - kMaxIdle) * area(both) ? both : needed;
}

Picture GlTargets::picture() const {
    Picture result(image_->color.width(), image_->color.height());
    image_->color.read(GL_RGB, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(result.pixels)));
    flipRows(result);
    return result;
}

LightPicture GlTargets::light() const {
    Raster<glm::vec4> light(image_->light.width(), image_->light.height());
    image_->light.read(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(light.pixels)));
    LightPicture result(light.width, light.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const glm::vec4& pixel = light.pixels[i];
        result.pixels[i] = {pixel.r, pixel.g, pixel.b};
        if (pixel.a == 0) result.pixels[i] = {-1, -1, -1};
    }
    flipRows(result);
    return result;
}

FloatPicture GlTargets::viewDepth(const ImageDepth& meaning) const {
    FloatPicture result(image_->depth.width(), image_->depth.height());
    image_->depth.read(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_writable_bytes(std::span(result.pixels)));
    for (float& depth : result.pixels)
        depth = static_cast<float>(meaning.asked(depth));
    flipRows(result);
    return result;
}

FloatPicture GlTargets::shadowDepth() const {
    if (!shadow_) return {};
    FloatPicture whole(shadow_->depth.width(), shadow_->depth.height());
    shadow_->depth.read(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_writable_bytes(std::span(whole.pixels)));
    if (whole.width == shadow_->width && whole.height == shadow_->height) return whole;
    FloatPicture result(shadow_->width, shadow_->height);
    for (int row = 0; row < result.height; ++row)
        std::copy_n(
            whole.pixels.begin() + std::ptrdiff_t{row} * whole.width,
            result.width,
            result.pixels.begin() + std::ptrdiff_t{row} * result.width);
    return result;
}

Raster<SurfaceSample> GlTargets::surfaces() const {
    Raster<glm::vec4> normals(image_->normals.width(), image_->normals.height());
    Raster<glm::vec4> positions = normals;
    image_->normals.read(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(normals.pixels)));
    image_->positions.read(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(positions.pixels)));
    Raster<SurfaceSample> result(normals.width, normals.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const glm::vec4& normal = normals.pixels[i];
        const glm::vec4& position = positions.pixels[i];
        result.pixels[i] = {glm::vec3(normal), normal.w, glm::vec3(position), position.w};
    }
    flipRows(result);
    return result;
}

} // namespace gnomon::render
