#include "render/gl_executor.h"

#include "core/error.h"
#include "gl/program.h"
#include "render/frame_block.h"
#include "render/geometry_pool.h"
#include "render/stand_ins.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>

namespace gnomon::render {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

template <class Pixel>
void flipRows(Raster<Pixel>& raster) {
    const auto width = static_cast<std::ptrdiff_t>(raster.width);
    for (int top = 0, bottom = raster.height - 1; top < bottom; ++top, --bottom) {
        const auto a = raster.pixels.begin() + top * width;
        std::swap_ranges(a, a + width, raster.pixels.begin() + bottom * width);
    }
}

constexpr GLuint kShadowDepthUnit = 0;
constexpr GLuint kLitMaskUnit = 1;

/// The draws of one pass, gathered by the pool's chunks and issued together.
class Batch {
public:
    explicit Batch(const gl::Api& api) : api_(&api) {}

    void add(const PagePlace& place, const hierarchy::Page& page, const selection::ClusterRange& range) {
        const hierarchy::Cluster& first = page.clusters[range.firstCluster];
        const hierarchy::Cluster& last = page.clusters[range.firstCluster + range.clusterCount - 1];
        const std::uint32_t triangles = last.firstTriangle + last.triangleCount - first.firstTriangle;
        if (place.chunk >= draws_.size()) draws_.resize(place.chunk + 1);
        Draws& draws = draws_[place.chunk];
        draws.counts.push_back(static_cast<GLsizei>(triangles * 3));
        const std::size_t offset = place.indexOffset + std::size_t{first.firstTriangle} * 3 * sizeof(std::uint32_t);
        draws.offsets.push_back(reinterpret_cast<const void*>(offset)); // NOLINT(performance-no-int-to-ptr): GL's way
        draws.bases.push_back(place.baseVertex);
    }

    /// Issues what was added; returns how many draw calls that took.
    std::uint64_t flush(const GeometryPool& pool) {
        std::uint64_t calls = 0;
        for (std::size_t chunk = 0; chunk < draws_.size(); ++chunk) {
            Draws& draws = draws_[chunk];
            if (draws.counts.empty()) continue;
            api_->bindVertexArray(pool.vertexArray(chunk));
            api_->multiDrawElementsBaseVertex(
                GL_TRIANGLES,
                draws.counts.data(),
                GL_UNSIGNED_INT,
                draws.offsets.data(),
                static_cast<GLsizei>(draws.counts.size()),
                draws.bases.data());
            calls += draws.counts.size();
            draws = {};
        }
        return calls;
    }

private:
    struct Draws {
        std::vector<GLsizei> counts;
        std::vector<const void*> offsets;
        std::vector<GLint> bases;
    };

    const gl::Api* api_;
    std::vector<Draws> draws_; // by chunk
};

/// Colour, depth and, when asked for, surfaces of the image.
struct ImageTarget {
    gl::Texture color;
    gl::Texture normals; // these two are empty unless surfaces are asked for
    gl::Texture positions;
    gl::Texture depth;
    gl::Framebuffer framebuffer;
};

/// The depth texture that all shadow maps share.
struct ShadowTarget {
    gl::Texture depth;
    gl::Framebuffer framebuffer;
};

/// What the textures that a frame is drawn into take.
Bytes targetBytes(const FrameDrawing& frame) {
    const auto texels = [](int width, int height) {
        return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    };
    constexpr std::uint64_t kColorAndDepth = 4 + 4;
    constexpr std::uint64_t kSurfaces = 16 + 16;
    const plan::FramePlan& plan = *frame.plan;
    const std::uint64_t perPixel =
        kColorAndDepth + (frame.wantsSurfaces ? kSurfaces : 0) + (frame.litMask != nullptr ? 1 : 0);
    const std::uint64_t shadows =
        plan.passes.empty() ? 0 : sizeof(float) * texels(plan.textureWidth, plan.textureHeight);
    return {perPixel * texels(plan.view.width, plan.view.height) + shadows};
}

class GlExecutor final : public TextureExecutor {
public:
    /// `own` is the context to keep if `context` is this executor's alone.
    GlExecutor(
        std::unique_ptr<const gl::Context> own,
        const gl::Context& context,
        std::string name,
        gl::ShaderLibrary shaders,
        Bytes gpuMemory)
        : own_(std::move(own)),
          context_(&context),
          name_(std::move(name)),
          shaders_(std::move(shaders)),
          memory_(gpuMemory),
          pool_(context.api(), gpuMemory),
          frameBlock_(context.api(), sizeof(block::Frame)),
          shadowsBlock_(context.api(), sizeof(block::Shadows)) {}

    std::string name() const override { return name_; }

    const gl::Texture& texture() const override { return image_->color; }

    DrawStatistics draw(const FrameDrawing& frame) override;
    Picture picture() override;
    FloatPicture viewDepth() override;
    FloatPicture shadowDepth() override;
    Raster<SurfaceSample> surfaces() override;

private:
    const gl::Api& api() const { return context_->api(); }

    void prepareTargets(const FrameDrawing& frame);
    void shareMemory(const FrameDrawing& frame);
    void drawShadowMaps(const FrameDrawing& frame);
    void drawImage(const FrameDrawing& frame);
    void drawGeometry(const FrameDrawing& frame, const selection::DrawList& list);
    PagePlace placed(const FrameDrawing& frame, std::uint32_t id, Batch& batch);
    const gl::Program& surfaceProgram(const FrameDrawing& frame);
    void bindBlocks(const block::Frame& values);

    std::unique_ptr<const gl::Context> own_; // null in a window's
    const gl::Context* context_;
    std::string name_;
    gl::ShaderLibrary shaders_;
    Bytes memory_; // the cap on targets and geometry together
    GeometryPool pool_;
    gl::Buffer frameBlock_;
    gl::Buffer shadowsBlock_;
    std::optional<gl::Program> depthProgram_;
    std::map<std::string, gl::Program> surfacePrograms_; // by their defines
    std::optional<ImageTarget> image_;
    std::optional<ShadowTarget> shadow_;
    gl::Texture litMask_;
    double clipNear_ = 1;
    std::uint64_t drawCalls_ = 0;
};

DrawStatistics GlExecutor::draw(const FrameDrawing& frame) {
    DrawStatistics statistics;
    drawCalls_ = 0;
    clipNear_ = frame.clipNear;
    shareMemory(frame);
    prepareTargets(frame);
    const auto start = Clock::now();
    if (shadow_) drawShadowMaps(frame);
    api().finish();
    statistics.shadowMs = shadow_ ? millisecondsSince(start) : 0;
    const auto imageStart = Clock::now();
    drawImage(frame);
    api().finish();
    statistics.imageMs = millisecondsSince(imageStart);
    context_->check("frame");
    statistics.drawCalls = drawCalls_;
    statistics.deviceBytes = pool_.size().count + targetBytes(frame).count;
    return statistics;
}

/// What the targets leave of the memory is the geometry's.
void GlExecutor::shareMemory(const FrameDrawing& frame) {
    const Bytes targets = targetBytes(frame);
    if (targets >= memory_)
        throw Error(
            "--gpu-memory",
            "the image and its shadow maps alone take more",
            "above " + readableBytes(targets),
            readableBytes(memory_));
    pool_.keepUnder({memory_.count - targets.count});
}

void GlExecutor::prepareTargets(const FrameDrawing& frame) {
    const plan::FramePlan& plan = *frame.plan;
    const int width = plan.view.width;
    const int height = plan.view.height;
    const int largest = std::max(std::max(width, height), std::max(plan.textureWidth, plan.textureHeight));
    if (largest > context_->maxTextureSize())
        throw Error(
            "--size or --shadow-texels",
            "larger than a texture of this OpenGL",
            "at most " + std::to_string(context_->maxTextureSize()),
            std::to_string(largest));
    const bool hasSurfaces = image_ && image_->normals.id() != 0;
    if (!image_ || image_->color.width() != width || image_->color.height() != height ||
        hasSurfaces != frame.wantsSurfaces) {
        ImageTarget target;
        target.color = gl::Texture(api(), GL_RGBA8, width, height);
        target.depth = gl::Texture(api(), GL_DEPTH_COMPONENT32F, width, height);
        std::vector<const gl::Texture*> colors = {&target.color};
        if (frame.wantsSurfaces) {
            target.normals = gl::Texture(api(), GL_RGBA32F, width, height);
            target.positions = gl::Texture(api(), GL_RGBA32F, width, height);
            colors.push_back(&target.normals);
            colors.push_back(&target.positions);
        }
        target.framebuffer = gl::Framebuffer(api(), colors, target.depth);
        image_ = std::move(target);
    }
    if (plan.passes.empty()) {
        shadow_.reset();
    } else if (
        !shadow_ || shadow_->depth.width() != plan.textureWidth || shadow_->depth.height() != plan.textureHeight) {
        ShadowTarget target;
        target.depth = gl::Texture(api(), GL_DEPTH_COMPONENT32F, plan.textureWidth, plan.textureHeight);
        target.framebuffer = gl::Framebuffer(api(), {}, target.depth);
        shadow_ = std::move(target);
    }
}

void GlExecutor::bindBlocks(const block::Frame& values) {
    frameBlock_.write(0, std::as_bytes(std::span(&values, 1)));
    api().bindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.id());
    api().bindBufferBase(GL_UNIFORM_BUFFER, 1, shadowsBlock_.id());
}

void GlExecutor::drawShadowMaps(const FrameDrawing& frame) {
    const plan::FramePlan& plan = *frame.plan;
    const gl::Api& gl = api();
    if (!depthProgram_) depthProgram_.emplace(gl, shaders_, "shadow/depth.vert", "shadow/depth.frag");
    gl.useProgram(depthProgram_->id());
    gl.bindFramebuffer(GL_FRAMEBUFFER, shadow_->framebuffer.id());
    const float farthest = 1;
    const auto clear = [&] { gl.clearNamedFramebufferfv(shadow_->framebuffer.id(), GL_DEPTH, 0, &farthest); };
    const auto isReused = [](const plan::ShadowPass& pass) { return pass.isReused; };
    const bool keepsSome = std::any_of(plan.passes.begin(), plan.passes.end(), isReused);
    gl.disable(GL_SCISSOR_TEST);
    if (!keepsSome) clear();
    gl.enable(GL_DEPTH_TEST);
    gl.depthFunc(GL_LESS);
    // Clipping keeps within the viewport but for rounding; the scissor makes it exact.
    gl.enable(GL_SCISSOR_TEST);
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        if (plan.passes[p].isReused) continue;
        const plan::Rectangle& r = plan.passes[p].rectangle;
        gl.viewport(r.x, r.y, r.width, r.height);
        gl.scissor(r.x, r.y, r.width, r.height);
        if (keepsSome) clear();
        // Casters nearer to the light than the frustum count: they are clamped per fragment.
        (plan.passes[p].clampsDepth ? gl.enable : gl.disable)(GL_DEPTH_CLAMP);
        const MapDrawing map = mapDrawing(frame, plan.passes[p]);
        bindBlocks(frameBlock(frame, map.space, map.clipFromDraw));
        drawGeometry(frame, *frame.casters[p]);
    }
    gl.disable(GL_SCISSOR_TEST);
    gl.disable(GL_DEPTH_CLAMP);
}

const gl::Program& GlExecutor::surfaceProgram(const FrameDrawing& frame) {
    const int shadows = frame.litMask != nullptr ? 2 : (shadow_ ? 1 : 0);
    const std::string defines = "#define SHADOWS " + std::to_string(shadows) + "\n#define OVERLAY " +
                                std::to_string(static_cast<int>(frame.overlay)) + "\n#define AUXILIARY " +
                                (frame.wantsSurfaces ? "1\n" : "0\n");
    const auto found = surfacePrograms_.find(defines);
    if (found != surfacePrograms_.end()) return found->second;
    return surfacePrograms_
        .emplace(defines, gl::Program(api(), shaders_, "image/surface.vert", "image/surface.frag", defines))
        .first->second;
}

void GlExecutor::drawImage(const FrameDrawing& frame) {
    const gl::Api& gl = api();
    const plan::View& view = frame.plan->view;
    gl.useProgram(surfaceProgram(frame).id());
    gl.bindFramebuffer(GL_FRAMEBUFFER, image_->framebuffer.id());
    gl.viewport(0, 0, view.width, view.height);
    const std::array<float, 4> background = {0.86F, 0.89F, 0.93F, 1};
    const std::array<float, 4> nothing{};
    const float farthest = 0; // depth is reversed
    gl.clearNamedFramebufferfv(image_->framebuffer.id(), GL_COLOR, 0, background.data());
    if (frame.wantsSurfaces)
        for (const GLint target : {1, 2})
            gl.clearNamedFramebufferfv(image_->framebuffer.id(), GL_COLOR, target, nothing.data());
    gl.clearNamedFramebufferfv(image_->framebuffer.id(), GL_DEPTH, 0, &farthest);
    gl.enable(GL_DEPTH_TEST);
    gl.depthFunc(GL_GREATER);
    if (shadow_) {
        const block::Shadows values = shadowsBlock(frame);
        shadowsBlock_.write(0, std::as_bytes(std::span(&values, 1)));
        gl.bindTextureUnit(kShadowDepthUnit, shadow_->depth.id());
    }
    if (frame.litMask != nullptr) {
        Raster<std::uint8_t> mask = *frame.litMask;
        flipRows(mask);
        if (litMask_.width() != mask.width || litMask_.height() != mask.height)
            litMask_ = gl::Texture(gl, GL_R8, mask.width, mask.height);
        litMask_.write(GL_RED, GL_UNSIGNED_BYTE, std::as_bytes(std::span(mask.pixels)));
        gl.bindTextureUnit(kLitMaskUnit, litMask_.id());
    }
    block::Frame values = frameBlock(frame, frame.space, imageClipFromDraw(frame));
    if (frame.overlay == Overlay::Residency) {
        for (const Residence residence : {Residence::AsAsked, Residence::Awaited, Residence::Damaged}) {
            values.near.w = static_cast<float>(residence);
            bindBlocks(values);
            drawGeometry(frame, drawnAs(*frame.image, frame.standIns, residence, frame.pages));
        }
        return;
    }
    bindBlocks(values);
    drawGeometry(frame, *frame.image);
}

PagePlace GlExecutor::placed(const FrameDrawing& frame, std::uint32_t id, Batch& batch) {
    if (const auto place = pool_.find(id)) return *place;
    const hierarchy::Page& page = frame.pages(id);
    for (;;) {
        if (const auto place = pool_.insert(id, page, frame.grid)) return *place;
        // The pool is smaller than the pass: what was gathered is drawn first, so that its pages may go.
        drawCalls_ += batch.flush(pool_);
        pool_.evictOldest();
    }
}

void GlExecutor::drawGeometry(const FrameDrawing& frame, const selection::DrawList& list) {
    Batch batch(api());
    for (const selection::ClusterRange& range : list.ranges)
        batch.add(placed(frame, range.page, batch), frame.pages(range.page), range);
    drawCalls_ += batch.flush(pool_);
}

Picture GlExecutor::picture() {
    Raster<std::array<std::uint8_t, 3>> result(image_->color.width(), image_->color.height());
    image_->color.read(GL_RGB, GL_UNSIGNED_BYTE, std::as_writable_bytes(std::span(result.pixels)));
    flipRows(result);
    return result;
}

FloatPicture GlExecutor::viewDepth() {
    FloatPicture result(image_->depth.width(), image_->depth.height());
    image_->depth.read(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_writable_bytes(std::span(result.pixels)));
    for (float& depth : result.pixels)
        depth = static_cast<float>(clipNear_ / static_cast<double>(depth)); // infinite where nothing was drawn
    flipRows(result);
    return result;
}

FloatPicture GlExecutor::shadowDepth() {
    if (!shadow_) return {};
    FloatPicture result(shadow_->depth.width(), shadow_->depth.height());
    shadow_->depth.read(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_writable_bytes(std::span(result.pixels)));
    return result;
}

Raster<SurfaceSample> GlExecutor::surfaces() {
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

} // namespace

std::unique_ptr<Executor> makeGlExecutor(gl::Platform platform, const gl::ShaderLibrary& shaders, Bytes gpuMemory) {
    auto context = std::make_unique<const gl::Context>(platform);
    const gl::Context& ours = *context;
    const char* const name = platform == gl::Platform::Egl ? "egl" : "osmesa";
    return std::make_unique<GlExecutor>(std::move(context), ours, name, shaders, gpuMemory);
}

std::unique_ptr<TextureExecutor> makeWindowExecutor(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory) {
    return std::make_unique<GlExecutor>(nullptr, context, "window", shaders, gpuMemory);
}

} // namespace gnomon::render
