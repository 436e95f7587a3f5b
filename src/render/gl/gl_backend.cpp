#include "render/gl/gl_backend.h"

#include "core/limit_error.h"
#include "core/stopwatch.h"
#include "gl/gpu_timer.h"
#include "gl/mapped_ring.h"
#include "gl/program.h"
#include "render/frame_block.h"
#include "render/gl/geometry_pool.h"
#include "render/gl/gl_batch.h"
#include "render/gl/gl_targets.h"
#include "render/gl/lit_count.h"
#include "render/light/background.h"
#include "render/lod_substitutes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <map>

namespace gnomon::render {

namespace {

constexpr GLuint kShadowDepthUnit = 0;
constexpr GLuint kLitMaskUnit = 1;

/// Segment size in bytes of the ring buffer for uniform blocks. A segment contains the uniform blocks of several
/// frames.
constexpr std::size_t kBlockSegment = std::size_t{128} << 10U;

/// Returns the segment size in bytes of a ring buffer: `memory` / `share`, clamped to [minBytes, maxBytes].
std::size_t ringSegment(Bytes memory, std::uint64_t share, std::size_t minBytes, std::size_t maxBytes) {
    return std::clamp<std::size_t>(memory.count / share, minBytes, maxBytes);
}

constexpr std::size_t kKibibyte = 1024;

class GlBackend final : public Backend {
public:
    /// Creates a backend that draws with `context`. If the backend owns the context, `own` contains it, otherwise `own`
    /// is null.
    GlBackend(
        std::unique_ptr<const gl::Context> own,
        const gl::Context& context,
        std::string name,
        gl::ShaderLibrary shaders,
        Bytes gpuMemory,
        GlSubmission submission)
        : own_(std::move(own)),
          context_(&context),
          name_(std::move(name)),
          shaders_(std::move(shaders)),
          memory_(gpuMemory),
          submission_(submission),
          blocks_(context.api(), kBlockSegment),
          commands_(context.api(), ringSegment(gpuMemory, 1024, 64 * kKibibyte, 1024 * kKibibyte)),
          staging_(context.api(), ringSegment(gpuMemory, 256, 256 * kKibibyte, 4096 * kKibibyte)),
          pool_(context.api(), staging_, gpuMemory) {
        if (submission == GlSubmission::WaitsForEachPass) return;
        shadowTimer_.emplace(context.api());
        imageTimer_.emplace(context.api());
    }

    std::string name() const override { return name_; }

    std::uint32_t texture() const override { return targets_.color().id(); }

    PassStatistics drawShadowMaps(const DrawInputs& frame) override;

    PassStatistics drawImage(const DrawInputs& frame) override;

    DrawStatistics draw(const DrawInputs& frame) override;

    Bytes deviceMemory() const override { return {pool_.size().count + targetMemory_.count + ringBytes()}; }

    Picture picture() override { return targets().picture(); }

    LightPicture light() override { return targets().light(); }

    std::optional<std::uint64_t> litPixels() override;

    FloatPicture viewDepth() override { return targets().viewDepth(depth_); }

    FloatPicture shadowDepth() override { return targets().shadowDepth(); }

    Raster<SurfaceSample> surfaces() override { return targets().surfaces(); }

private:
    const gl::Api& api() const { return context_->api(); }

    /// Makes the OpenGL context current, and returns the render targets for reading.
    const GlTargets& targets() const {
        context_->makeCurrent();
        return targets_;
    }

    void prepareTargets(const DrawInputs& frame);
    void drawMaps(const DrawInputs& frame);
    void drawBackground(const DrawInputs& frame);
    void drawSurfaces(const DrawInputs& frame);
    void drawGeometry(const DrawInputs& frame, const lod::DrawList& list, bool withAttributes);
    void bringIn(const DrawInputs& frame, const lod::DrawList& list);
    PagePlace placed(const DrawInputs& frame, std::uint32_t id, GlBatch& batch);
    bool waitsForDraws() const;
    const gl::Program& surfaceProgram(const DrawInputs& frame);
    void bindFrameBlock(const block::Frame& values);
    void bindShadowsBlock(const DrawInputs& frame);

    std::uint64_t ringBytes() const { return blocks_.size() + commands_.size() + staging_.size(); }

    std::unique_ptr<const gl::Context> own_; // null if a window owns the context
    const gl::Context* context_;
    std::string name_;
    gl::ShaderLibrary shaders_;
    Bytes memory_; // limit for the sum of render targets, rings and geometry
    GlSubmission submission_;
    std::optional<gl::GpuTimer> shadowTimer_; // both timers are empty if the program waits after each pass
    std::optional<gl::GpuTimer> imageTimer_;
    gl::MappedRing blocks_;
    gl::MappedRing commands_;
    gl::MappedRing staging_;
    GeometryPool pool_;
    std::optional<gl::Program> depthProgram_;
    std::optional<gl::Program> skyProgram_;
    gl::VertexArray vertexless_;
    std::optional<LitCount> litCount_;
    plan::Shading shading_{};                            // shading of the last frame
    std::map<std::string, gl::Program> surfacePrograms_; // one program per list of defines
    GlTargets targets_;
    gl::Texture litMask_;
    Bytes targetMemory_;
    ImageDepth depth_;
    std::uint64_t drawCalls_ = 0; // number of draws in the current pass
    gl::CurrentAtDestruction deletesInItsContext_{*context_};
};

PassStatistics GlBackend::drawShadowMaps(const DrawInputs& frame) {
    prepareTargets(frame);
    drawCalls_ = 0;
    const Stopwatch watch;
    if (shadowTimer_) shadowTimer_->begin();
    if (targets_.hasShadowMaps()) drawMaps(frame);
    if (shadowTimer_) shadowTimer_->end();
    if (!shadowTimer_) api().finish();
    return {targets_.hasShadowMaps() ? watch.elapsed() : Milliseconds(), drawCalls_, std::nullopt};
}

PassStatistics GlBackend::drawImage(const DrawInputs& frame) {
    prepareTargets(frame);
    drawCalls_ = 0;
    depth_ = imageProjection(frame).depth;
    shading_ = frame.shading;
    const Stopwatch watch;
    if (imageTimer_) imageTimer_->begin();
    drawSurfaces(frame);
    if (imageTimer_) imageTimer_->end();
    if (!imageTimer_) api().finish();
    const Milliseconds time = watch.elapsed();
    context_->check("frame");
    return {time, drawCalls_, std::nullopt};
}

/// Draws a frame and measures its time, with the clock of the GPU if available. If the program waits for each frame,
/// the times belong to this frame. Otherwise they belong to the last finished frame.
DrawStatistics GlBackend::draw(const DrawInputs& frame) {
    DrawStatistics statistics = Backend::draw(frame);
    if (submission_ == GlSubmission::WaitsForEachFrame) {
        statistics.image.time = imageTimer_->finished();
        statistics.shadows.time = shadowTimer_->finished();
    } else if (submission_ == GlSubmission::Queues) {
        statistics.image.time = imageTimer_->latest();
        statistics.shadows.time = shadowTimer_->latest();
    }
    return statistics;
}

/// Creates the render targets of the frame. The rest of the GPU memory limit becomes the limit of the geometry pool.
void GlBackend::prepareTargets(const DrawInputs& frame) {
    context_->makeCurrent();
    targetMemory_ = targets_.bytes(frame);
    const Bytes taken{targetMemory_.count + ringBytes()};
    if (taken >= memory_)
        throw LimitError(
            Limit::DrawingMemory,
            {"drawing memory",
             "too small: the image and its shadow maps alone need more",
             "above " + readableBytes(taken),
             readableBytes(memory_)});
    pool_.keepUnder({memory_.count - taken.count});
    targets_.prepare(*context_, frame);
}

void GlBackend::bindFrameBlock(const block::Frame& values) {
    const gl::RingPiece piece = blocks_.take(sizeof values);
    std::memcpy(piece.bytes.data(), &values, sizeof values);
    api().bindBufferRange(
        GL_UNIFORM_BUFFER, 0, blocks_.id(), static_cast<GLintptr>(piece.offset), GLsizeiptr{sizeof values});
}

/// Binds the shadow map parameters (block::Shadows) as three uniform blocks, because OpenGL guarantees only 16 KiB per
/// block.
void GlBackend::bindShadowsBlock(const DrawInputs& frame) {
    constexpr std::size_t kFirst = offsetof(block::Shadows, partitions);
    constexpr std::size_t kOthers = kFirst + GNOMON_FIRST_PARTITIONS * sizeof(block::Partition);
    constexpr std::array<std::size_t, 4> kStarts = {0, kFirst, kOthers, sizeof(block::Shadows)};
    const block::Shadows values = shadowsBlock(frame);
    const gl::RingPiece piece = blocks_.take(sizeof values);
    std::memcpy(piece.bytes.data(), &values, sizeof values);
    for (std::size_t i = 0; i + 1 < kStarts.size(); ++i)
        api().bindBufferRange(
            GL_UNIFORM_BUFFER,
            static_cast<GLuint>(1 + i),
            blocks_.id(),
            static_cast<GLintptr>(piece.offset + kStarts[i]),
            static_cast<GLsizeiptr>(kStarts[i + 1] - kStarts[i]));
}

void GlBackend::drawMaps(const DrawInputs& frame) {
    const plan::FramePlan& plan = *frame.plan;
    const gl::Api& gl = api();
    if (!depthProgram_) depthProgram_.emplace(gl, shaders_, "shadow/depth.vert", "shadow/depth.frag");
    gl.useProgram(depthProgram_->id());
    gl.bindFramebuffer(GL_FRAMEBUFFER, targets_.shadowFramebuffer());
    const float farthest = 1;
    const auto clear = [&] { gl.clearNamedFramebufferfv(targets_.shadowFramebuffer(), GL_DEPTH, 0, &farthest); };
    const auto isReused = [](const plan::ShadowPass& pass) { return pass.isReused; };
    const bool keepsSome = std::any_of(plan.passes.begin(), plan.passes.end(), isReused);
    gl.disable(GL_SCISSOR_TEST);
    if (!keepsSome) clear();
    gl.enable(GL_DEPTH_TEST);
    gl.depthFunc(GL_LESS);
    // The scissor test removes fragments outside the viewport. Clipping can create such fragments by rounding.
    gl.enable(GL_SCISSOR_TEST);
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        if (plan.passes[p].isReused) continue;
        const shadow::TexelRectangle& r = plan.passes[p].map.rectangle;
        gl.viewport(r.x, r.y, r.width, r.height);
        gl.scissor(r.x, r.y, r.width, r.height);
        if (keepsSome) clear();
        // Depth clamping preserves casters that are nearer to the light than the depth range of the map.
        (plan.passes[p].clampsDepth ? gl.enable : gl.disable)(GL_DEPTH_CLAMP);
        const MapDrawing map = mapDrawing(frame, plan.passes[p].map);
        bindFrameBlock(frameBlock(frame, map.space, map.clipFromDraw()));
        drawGeometry(frame, *frame.casters[p], false);
    }
    gl.disable(GL_SCISSOR_TEST);
    gl.disable(GL_DEPTH_CLAMP);
}

const gl::Program& GlBackend::surfaceProgram(const DrawInputs& frame) {
    const int shadows = frame.litMask != nullptr ? 2 : (targets_.hasShadowMaps() ? 1 : 0);
    const bool hasMany = frame.plan->passes.size() > GNOMON_FIRST_PARTITIONS;
    const std::string defines =
        "#define MANY_PARTITIONS " + std::to_string(hasMany ? 1 : 0) + "\n#define SHADOWS " + std::to_string(shadows) +
        "\n#define OVERLAY " + std::to_string(static_cast<int>(frame.overlay)) + "\n#define AUXILIARY " +
        (frame.wantsSurfaces ? "1" : "0") + "\n#define LIGHT " + (frame.wantsLight ? "1\n" : "0\n");
    const auto found = surfacePrograms_.find(defines);
    if (found != surfacePrograms_.end()) return found->second;
    return surfacePrograms_
        .emplace(defines, gl::Program(api(), shaders_, "image/surface.vert", "image/surface.frag", defines))
        .first->second;
}

std::optional<std::uint64_t> GlBackend::litPixels() {
    context_->makeCurrent();
    if (!litCount_) litCount_.emplace(api(), shaders_);
    if (submission_ == GlSubmission::Queues) return litCount_->nowAndThen(targets_.color(), shading_);
    return litCount_->of(targets_.color());
}

void GlBackend::drawBackground(const DrawInputs& frame) {
    const gl::Api& gl = api();
    if (const std::optional<SkyRows> sky = skyRows(frame)) {
        if (!skyProgram_) {
            skyProgram_.emplace(gl, shaders_, "image/fullscreen.vert", "image/sky.frag");
            vertexless_ = gl::VertexArray(gl);
        }
        gl.programUniform4f(
            skyProgram_->id(),
            0,
            sky->middle,
            sky->perHeight,
            sky->tanHalfY,
            static_cast<float>(frame.plan->view.height));
        gl.useProgram(skyProgram_->id());
        gl.bindVertexArray(vertexless_.id());
        gl.disable(GL_DEPTH_TEST);
        gl.drawArrays(GL_TRIANGLES, 0, 3);
        return;
    }
    const Rgb color = frame.plan->quality.look.background.color;
    const glm::vec4 value(glm::vec3(color[0], color[1], color[2]) / 255.0F, 1);
    gl.clearNamedFramebufferfv(targets_.imageFramebuffer(), GL_COLOR, 0, &value.x);
}

void GlBackend::drawSurfaces(const DrawInputs& frame) {
    const gl::Api& gl = api();
    const plan::View& view = frame.plan->view;
    gl.bindFramebuffer(GL_FRAMEBUFFER, targets_.imageFramebuffer());
    gl.viewport(0, 0, view.width, view.height);
    const std::array<float, 4> nothing{};
    const float farthest = 0; // depth is reversed, so 0 is the farthest
    drawBackground(frame);
    gl.useProgram(surfaceProgram(frame).id());
    if (frame.wantsSurfaces)
        for (const GLint target : {1, 2})
            gl.clearNamedFramebufferfv(targets_.imageFramebuffer(), GL_COLOR, target, nothing.data());
    if (frame.wantsLight) gl.clearNamedFramebufferfv(targets_.imageFramebuffer(), GL_COLOR, 1, nothing.data());
    gl.clearNamedFramebufferfv(targets_.imageFramebuffer(), GL_DEPTH, 0, &farthest);
    gl.enable(GL_DEPTH_TEST);
    gl.depthFunc(GL_GREATER);
    if (targets_.hasShadowMaps()) {
        bindShadowsBlock(frame);
        gl.bindTextureUnit(kShadowDepthUnit, targets_.shadowMaps().id());
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
        for (const Residence residence : {Residence::Final, Residence::Pending, Residence::Damaged}) {
            values.drawnResidence = static_cast<float>(residence);
            bindFrameBlock(values);
            drawGeometry(frame, drawnAs(*frame.image, frame.substitutes, residence, frame.pages), true);
        }
        return;
    }
    bindFrameBlock(values);
    drawGeometry(frame, *frame.image, true);
}

void GlBackend::bringIn(const DrawInputs& frame, const lod::DrawList& list) {
    std::vector<GeometryPool::NewPage> missing;
    for (const lod::ClusterRange& range : list.ranges)
        if (!pool_.find(range.page)) missing.push_back({range.page, &frame.pages(range.page)});
    const auto isBefore = [](const auto& a, const auto& b) { return a.id < b.id; };
    std::sort(missing.begin(), missing.end(), isBefore);
    const auto isSame = [](const auto& a, const auto& b) { return a.id == b.id; };
    missing.erase(std::unique(missing.begin(), missing.end(), isSame), missing.end());
    pool_.insertAll(missing, frame.grid);
}

PagePlace GlBackend::placed(const DrawInputs& frame, std::uint32_t id, GlBatch& batch) {
    if (const auto place = pool_.find(id)) return *place;
    const hierarchy::Page& page = frame.pages(id);
    for (;;) {
        if (const auto place = pool_.insert(id, page, frame.grid)) return *place;
        // The pool has no memory for more pages. The clusters collected so far are drawn now, so that their pages can
        // be evicted.
        drawCalls_ += batch.flush(pool_, waitsForDraws());
        pool_.evictOldest();
    }
}

void GlBackend::drawGeometry(const DrawInputs& frame, const lod::DrawList& list, bool withAttributes) {
    GlBatch batch(api(), commands_, withAttributes);
    bringIn(frame, list);
    for (const lod::ClusterRange& range : list.ranges)
        batch.add(placed(frame, range.page, batch), frame.pages(range.page), range);
    drawCalls_ += batch.flush(pool_, waitsForDraws());
}

/// Returns true if the program waits for each draw call to finish. Mesa's software renderer stores the binned triangles
/// of all unfinished draws, about 200 MiB outside the memory limit. Waiting limits this memory, but increases the time
/// by a sixth.
bool GlBackend::waitsForDraws() const {
    return submission_ == GlSubmission::WaitsForEachPass;
}

} // namespace

std::unique_ptr<Backend> makeGlBackend(
    gl::Platform platform,
    const gl::ShaderLibrary& shaders,
    Bytes gpuMemory,
    const std::function<void(const std::string&)>& warn) {
    auto context = std::make_unique<const gl::Context>(platform, warn);
    const gl::Context& ours = *context;
    const char* const name = platform == gl::Platform::Egl ? "egl" : "osmesa";
    const GlSubmission submission =
        ours.isHardware() ? GlSubmission::WaitsForEachFrame : GlSubmission::WaitsForEachPass;
    return std::make_unique<GlBackend>(std::move(context), ours, name, shaders, gpuMemory, submission);
}

std::unique_ptr<Backend> makeWindowBackend(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory) {
    return makeWindowBackend(
        context, shaders, gpuMemory, context.isHardware() ? GlSubmission::Queues : GlSubmission::WaitsForEachPass);
}

std::unique_ptr<Backend> makeWindowBackend(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory, GlSubmission submission) {
    return std::make_unique<GlBackend>(nullptr, context, "window", shaders, gpuMemory, submission);
}

} // namespace gnomon::render
