#include "render/software_shading.h"

#include "render/frame_block.h"
#include "render/light/background.h"
#include "render/light/light_model.h"
#include "render/view/image_projection.h"
#include "render/view/section_caps.h"

#include <algorithm>

#include <hwy/cache_control.h>

namespace gnomon::render {

namespace {

std::array<float, 3> toArray(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

glm::vec3 toVector(const PixelBatch::Vectors<float>& values, std::size_t i) {
    return {values[0][i], values[1][i], values[2][i]};
}

glm::vec3 toVector(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

/// Converts a colour channel in [0, 1] to the nearest integer from 0 to 255.
std::uint8_t level(float channel) {
    return static_cast<std::uint8_t>((static_cast<int>(510 * std::clamp(channel, 0.0F, 1.0F)) + 1) / 2);
}

} // namespace

/// A batch of pixels for the shading kernel, with their positions in the image.
struct Shading::Work {
    PixelBatch batch;
    std::array<std::uint32_t, PixelBatch::kMaxPixels> triangles{}; // ids of the visible triangles
    std::array<std::array<const hierarchy::Vertex*, 3>, PixelBatch::kMaxPixels> corners{};
    std::array<int, PixelBatch::kMaxPixels> columns{};
    std::array<int, PixelBatch::kMaxPixels> rows{}; // row of each pixel, from the bottom
    // Pixel ids and tolerances of pixels whose exact shadows are computed later.
    std::array<std::uint32_t, PixelBatch::kMaxPixels> pixels{}, tolerances{};
    // Index of the shadow map whose sample grid contains the pixel.
    std::array<std::int32_t, PixelBatch::kMaxPixels> maps{};
    // Indices in the batch of pixels whose shadow map is drawn later.
    std::array<std::uint32_t, PixelBatch::kMaxPixels> awaiting{};
};

Shading::Shading(
    const DrawInputs& frame,
    const glm::dmat4& clipFromDraw,
    const FloatPicture& shadowDepth,
    std::span<const DrawnCluster> clusters,
    Verdict verdict)
    : frame_(&frame),
      rows_(rowsOf(frame)),
      clusters_(clusters),
      block_(frameBlock(frame, frame.space, clipFromDraw)),
      shadows_(shadowsBlock(frame)),
      overlay_(frame, block_, shadows_, clusters),
      background_(backgroundRows(frame)) {
    if (frame.ground != nullptr) {
        // The ground is drawn on white. SoftwareBackend::picture converts its shadow to coverage.
        if (isTransparent(frame)) background_.assign(background_.size(), {255, 255, 255});
        leftInShadow_ = leftInShadow(frame);
        shadowed_ = shadowedRows(background_, leftInShadow_);
    }
    shared_.frame = &block_;
    shared_.shadows = &shadows_;
    shared_.shadowDepth = shadowDepth.pixels.data();
    shared_.shadowWidth = shadowDepth.width;
    shared_.wantsLight = frame.wantsLight;
    if (verdict != Verdict::Known)
        shared_.litSource = verdict == Verdict::Unresolved ? LitSource::Unresolved : LitSource::Awaited;
    else if (frame.litMask != nullptr)
        shared_.litSource = LitSource::Mask;
    else if (!frame.plan->passes.empty())
        shared_.litSource = LitSource::Maps;
    const plan::View& view = frame.plan->view;
    const ImageProjection projection = imageProjection(frame);
    rayOrigin_ = projection.eye;
    const glm::dvec3 right = projection.basis.right * projection.half.x;
    const glm::dvec3 up = projection.basis.up * projection.half.y;
    const glm::dvec2 first = 2.0 * frame.subpixel / glm::dvec2(view.width, view.height) - 1.0;
    const glm::dvec3 perX = right * (2.0 / view.width);
    const glm::dvec3 perY = up * (2.0 / view.height);
    if (projection.depth.isParallel) {
        rayOrigin_ += projection.basis.view * projection.depth.clip.near + first.x * right + first.y * up;
        shared_.isParallel = true;
        shared_.rayFirst = toArray(projection.basis.view);
        shared_.originPerX = toArray(perX / frame.space.step);
        shared_.originPerY = toArray(perY / frame.space.step);
        originPerX_ = perX;
        originPerY_ = perY;
    } else {
        shared_.rayFirst = toArray(projection.basis.view + first.x * right + first.y * up);
        shared_.rayPerX = toArray(perX);
        shared_.rayPerY = toArray(perY);
    }
    shared_.rayOriginCells = toArray(rayOrigin_ / frame.space.step);
}

bool Shading::isGround(const Work& work, std::size_t i) const {
    return clusters_[work.triangles[i] >> kTriangleBits].isGround;
}

/// Computes the colours of pixels that show the ground: the background, darkened by the shadow of the sun.
void Shading::colorGround(Work& work) const {
    PixelBatch& batch = work.batch;
    const auto packed = [](const Rgb& c) {
        return std::uint32_t{c[0]} | std::uint32_t{c[1]} << 8U | std::uint32_t{c[2]} << 16U;
    };
    for (std::size_t i = 0; i < batch.count; ++i) {
        if (!isGround(work, i)) continue;
        const auto row = static_cast<std::size_t>(frame_->plan->view.height - 1 - work.rows[i]);
        const Rgb& bright = background_[row];
        Rgb dark = shadowed_[row];
        batch.litColor[i] = packed(bright);
        if (shared_.litSource != LitSource::Awaited)
            for (std::size_t c = 0; c < 3; ++c)
                dark[c] = static_cast<std::uint8_t>(std::lround(
                    static_cast<float>(dark[c]) +
                    batch.lit[i] * (static_cast<float>(bright[c]) - static_cast<float>(dark[c]))));
        batch.color[i] = packed(dark);
    }
}

/// Writes the surface and the light of pixel `at`, which shows the background or a section cap. The colour of the pixel
/// is already in the picture.
void Shading::leaveUnshaded(std::size_t at, bool isCap, const ShadingTarget& target) const {
    if (target.surfaces != nullptr) target.surfaces->pixels[at] = {};
    if (target.light == nullptr) return;
    target.light->pixels[at] = {-1, -1, -1};
    if (isCap) target.light->pixels[at] = lightOfCap(target.picture->pixels[at]);
}

void Shading::shade(
    const raster::PixelBox& box, std::span<const std::uint64_t> words, const ShadingTarget& target) const {
    // Pixels are processed in small squares, so that neighbouring samples are adjacent in the sample list. A triangle
    // is later tested against consecutive samples of this list.
    constexpr int kSide = 8;
    Work work;
    for (int y = box.y0; y < box.y1; y += kSide)
        for (int x = box.x0; x < box.x1; x += kSide)
            shadeSquare({x, y, std::min(box.x1, x + kSide), std::min(box.y1, y + kSide)}, words, target, work);
    flush(work, target);
}

/// Adds the pixels of a small square to the batch in `work`. The caller must shade the pixels that remain in the batch.
void Shading::shadeSquare(
    const raster::PixelBox& box, std::span<const std::uint64_t> words, const ShadingTarget& target, Work& work) const {
    const Picture& picture = *target.picture;
    for (int y = box.y0; y < box.y1; ++y) {
        const std::uint64_t* row = &words[picture.index(0, y - rows_.first)];
        Rgb* colors = &target.picture->at(0, fromTop(y));
        const Rgb background = background_[static_cast<std::size_t>(frame_->plan->view.height - 1 - y)];
        for (int x = box.x0; x < box.x1; ++x) {
            const std::uint32_t name = raster::visibleTriangle(row[x]);
            if (row[x] == 0 || isCapName(name)) {
                if (target.unresolved != nullptr) continue;
                colors[x] = row[x] == 0 ? background : capColor(*frame_, name);
                leaveUnshaded(picture.index(x, fromTop(y)), row[x] != 0, target);
                continue;
            }
            const std::size_t i = work.batch.count++;
            work.triangles[i] = name;
            work.columns[i] = x;
            work.rows[i] = y;
            const DrawnCluster& cluster = clusters_[work.triangles[i] >> kTriangleBits];
            hwy::Prefetch(&cluster.triangles[work.triangles[i] & (raster::kMaxClusterTriangles - 1)]);
            if (work.batch.count == PixelBatch::kMaxPixels) flush(work, target);
        }
    }
}

/// Copies the triangles of the batch into the input of the shading kernel. The corners are scattered over pages in
/// memory, so they are prefetched.
void Shading::gatherTriangles(Work& work) const {
    PixelBatch& batch = work.batch;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const DrawnCluster& cluster = clusters_[work.triangles[i] >> kTriangleBits];
        const hierarchy::Triangle& triangle = cluster.triangles[work.triangles[i] & (raster::kMaxClusterTriangles - 1)];
        for (std::size_t k = 0; k < 3; ++k) {
            work.corners[i][k] = cluster.vertices + triangle[k];
            hwy::Prefetch(work.corners[i][k]);
        }
    }
    const hierarchy::GridPoint origin = frame_->space.originCell;
    const auto difference = [](std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b); };
    const auto take = [&](PixelBatch::Vectors<std::int32_t>& to,
                          std::size_t i,
                          const hierarchy::GridPoint& point,
                          const hierarchy::GridPoint& from) {
        to[0][i] = difference(point.x, from.x);
        to[1][i] = difference(point.y, from.y);
        to[2][i] = difference(point.z, from.z);
    };
    for (std::size_t i = 0; i < batch.count; ++i) {
        const auto& [a, b, c] = work.corners[i];
        batch.x[i] = static_cast<float>(work.columns[i]) + 0.5F;
        batch.y[i] = static_cast<float>(work.rows[i]) + 0.5F;
        take(batch.corner, i, a->position, origin);
        take(batch.edge1, i, b->position, a->position);
        take(batch.edge2, i, c->position, a->position);
        if (shared_.litSource == LitSource::Unresolved) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            batch.normals[k][i] = work.corners[i][k]->normal;
            batch.colors[k][i] = work.corners[i][k]->color;
        }
    }
    if (shared_.litSource != LitSource::Mask) return;
    const Raster<std::uint8_t>& mask = *frame_->litMask;
    for (std::size_t i = 0; i < batch.count; ++i)
        batch.litMask[i] = static_cast<float>(mask.at(work.columns[i], fromTop(work.rows[i]))) / 255.0F;
}

void Shading::flush(Work& work, const ShadingTarget& target) const {
    PixelBatch& batch = work.batch;
    if (batch.count == 0) return;
    gatherTriangles(work);
    shadePixels(shared_, batch);
    if (target.unresolved != nullptr) {
        leaveUnresolved(work, target);
        batch.count = 0;
        return;
    }
    if (frame_->ground != nullptr) colorGround(work);
    if (target.awaited != nullptr) leaveAwaited(work, target);
    if (target.litPixels != nullptr) countLit(work, target);
    if (target.light != nullptr) keepLight(work, target);
    Picture& picture = *target.picture;
    const bool isPainted = frame_->overlay != Overlay::None;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const std::size_t at = picture.index(work.columns[i], fromTop(work.rows[i]));
        const bool isOnGround = isGround(work, i);
        picture.pixels[at] = isPainted && !isOnGround ? painted(work, i) : unpacked(batch.color[i]);
        if (target.surfaces == nullptr) continue;
        if (isOnGround) {
            target.surfaces->pixels[at] = {};
            continue;
        }
        const bool facesLight = batch.faces[i] != 0 || (shared_.litSource == LitSource::Mask && batch.lit[i] > 0);
        const float partitionAndLit = static_cast<float>(batch.pass[i] + 1) + 0.5F * batch.lit[i];
        target.surfaces->pixels[at] = {
            toVector(batch.flatNormal, i), facesLight ? partitionAndLit : -1.0F, toVector(batch.position, i), 1};
    }
    batch.count = 0;
}

/// Returns the linear light of a section cap whose displayed colour is `color`. A cap receives no light from single sky
/// directions.
std::array<float, 3> Shading::lightOfCap(const Rgb& color) const {
    std::array<float, 3> light{};
    if (frame_->lightPart == LightPart::SkyDirection) return light;
    for (std::size_t c = 0; c < 3; ++c) {
        const float shown = linearFromDisplay(static_cast<float>(color[c]) / 255);
        light[c] = block_.isToneMapped != 0 ? shown / std::max(1 - shown, 1e-3F) : shown;
    }
    return light;
}

/// Returns the value of a ground pixel in a LightPicture, which encodes the fraction of the background's light that the
/// shadow removes. `lit` is the lit fraction of the pixel.
std::array<float, 3> Shading::lightOfGround(float lit) const {
    std::array<float, 3> light{};
    for (int c = 0; c < 3; ++c)
        light[static_cast<std::size_t>(c)] = -1 + kGroundShade * (1 - leftInShadow_[c]) * (1 - lit);
    return light;
}

void Shading::keepLight(const Work& work, const ShadingTarget& target) const {
    const PixelBatch& batch = work.batch;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const std::size_t at = target.picture->index(work.columns[i], fromTop(work.rows[i]));
        target.light->pixels[at] = isGround(work, i)
                                       ? lightOfGround(batch.lit[i])
                                       : std::array{batch.light[0][i], batch.light[1][i], batch.light[2][i]};
    }
}

/// Returns true if pixel `i` of `work` counts as lit when light reaches it. Surfaces at a grazing angle to the light do
/// not count, because they are dark, and rounding determines which side faces the light.
bool Shading::countsAsLit(const Work& work, std::size_t i) const {
    constexpr float kMinCosine = 1e-3F;
    const PixelBatch& batch = work.batch;
    const glm::vec3 towardsLight =
        block_.pointReach > 0 ? glm::normalize(block_.towardsLight - toVector(batch.position, i)) : block_.towardsLight;
    return glm::dot(toVector(batch.flatNormal, i), towardsLight) > kMinCosine && !isGround(work, i);
}

void Shading::countLit(const Work& work, const ShadingTarget& target) const {
    const PixelBatch& batch = work.batch;
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const bool isKnown = target.awaited == nullptr || batch.pass[i] < 0;
        count += isKnown && batch.lit[i] > 0 && countsAsLit(work, i) ? 1U : 0U;
    }
    target.litPixels->fetch_add(count, std::memory_order_relaxed);
}

void Shading::leaveUnresolved(Work& work, const ShadingTarget& target) const {
    const PixelBatch& batch = work.batch;
    UnresolvedPixels& unresolved = *target.unresolved;
    for (std::size_t i = 0; i < batch.count; ++i) {
        const std::size_t at = target.picture->index(work.columns[i], fromTop(work.rows[i]));
        work.pixels[i] = static_cast<std::uint32_t>(at);
        work.tolerances[i] = unresolved.tolerance;
        work.maps[i] = 0;
        if (unresolved.sliceEnds.size() < 2) continue;
        const auto end = std::lower_bound(unresolved.sliceEnds.begin(), unresolved.sliceEnds.end(), batch.depth[i]);
        // A pixel behind the last slice receives an index that is too large by one. SampleList clamps it to the last
        // map.
        work.maps[i] = static_cast<std::int32_t>(end - unresolved.sliceEnds.begin());
    }
    exact::PointBatch points;
    points.count = batch.count;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        points.corner[axis] = batch.corner[axis].data();
        points.edge1[axis] = batch.edge1[axis].data();
        points.edge2[axis] = batch.edge2[axis].data();
    }
    points.second = batch.second.data();
    points.third = batch.third.data();
    points.map = work.maps.data();
    points.pixel = work.pixels.data();
    points.triangle = work.triangles.data();
    points.tolerance = work.tolerances.data();
    if (unresolved.points != nullptr)
        unresolved.points->add(points);
    else
        unresolved.samples->add(points);
}

void Shading::leaveAwaited(Work& work, const ShadingTarget& target) const {
    PixelBatch& batch = work.batch;
    AwaitedPixels& awaited = *target.awaited;
    exact::LookupMask::Run run(*awaited.mask);
    std::size_t count = 0;
    for (std::size_t i = 0; i < batch.count; ++i) {
        if (batch.faces[i] == 0) continue;
        if (batch.pass[i] < 0) {
            batch.color[i] = batch.litColor[i];
            continue;
        }
        run.add({batch.firstColumn[i], batch.firstRow[i], batch.lastColumn[i], batch.lastRow[i]}, batch.lookupDepth[i]);
        work.awaiting[count++] = static_cast<std::uint32_t>(i);
    }
    if (!awaited.isLitLater) return;
    std::size_t to = awaited.size.fetch_add(count, std::memory_order_relaxed);
    for (std::size_t k = 0; k < count; ++k, ++to) {
        const std::size_t i = work.awaiting[k];
        const std::size_t at = target.picture->index(work.columns[i], fromTop(work.rows[i]));
        awaited.pixels[to] = static_cast<std::uint32_t>(at);
        awaited.texels[to] = static_cast<std::uint32_t>(batch.firstRow[i] * shared_.shadowWidth + batch.firstColumn[i]);
        awaited.litColors[to] = batch.litColor[i];
        awaited.depths[to] = batch.lookupDepth[i];
        awaited.counts[to] = countsAsLit(work, i) ? 1 : 0;
    }
}

Rgb Shading::painted(const Work& work, std::size_t i) const {
    const PixelBatch& batch = work.batch;
    const glm::vec3 rayPerX = toVector(shared_.rayPerX);
    const glm::vec3 rayPerY = toVector(shared_.rayPerY);
    const glm::vec3 color = overlay_.painted(
        {toVector(batch.shaded, i),
         toVector(batch.position, i),
         batch.depth[i],
         batch.pass[i],
         rayOrigin_ + double{batch.x[i]} * originPerX_ + double{batch.y[i]} * originPerY_,
         originPerX_,
         originPerY_,
         toVector(shared_.rayFirst) + batch.x[i] * rayPerX + batch.y[i] * rayPerY,
         rayPerX,
         rayPerY,
         toVector(batch.flatNormal, i),
         work.columns[i],
         work.rows[i],
         &clusters_[work.triangles[i] >> kTriangleBits]});
    return {level(color.r), level(color.g), level(color.b)};
}

} // namespace gnomon::render
