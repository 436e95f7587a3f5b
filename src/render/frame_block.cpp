#include "render/frame_block.h"

#include "core/check.h"
#include "render/light/light_model.h"
#include "render/view/image_projection.h"
#include "shadow/depth_bias.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon::render {

// The C++ structs must have the same std140 memory layout as the uniform blocks of the shaders.
static_assert(offsetof(block::Frame, gridStep) == offsetof(block::Frame, eye) + 12 && sizeof(block::Frame) % 16 == 0);
static_assert(offsetof(block::Frame, sliceCount) % 16 == 0 && offsetof(block::Frame, ambientMean) % 16 == 0);
static_assert(offsetof(block::Shadows, partitions) % 256 == 0);
static_assert(sizeof(block::Partition) * GNOMON_FIRST_PARTITIONS % 256 == 0);
static_assert(sizeof(block::Partition) * GNOMON_FIRST_PARTITIONS <= 16384, "what a block of OpenGL may always have");
static_assert(sizeof(block::Slice) == 16 && sizeof(block::Partition) % 16 == 0);
static_assert(offsetof(block::Partition, axisX) % 16 == 0 && offsetof(block::Partition, firstTexel) % 16 == 0);

namespace {

glm::dmat4 fromRows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w) {
    return glm::transpose(glm::dmat4(x, y, z, w));
}

/// Converts a direction from camera space to camera-relative space, which has the axes of the world.
glm::vec4 toDraw(const CameraBasis& basis, const glm::dvec3& direction, double w = 0) {
    return {glm::vec3(toWorld(basis, direction)), static_cast<float>(w)};
}

/// Returns the matrix from camera-relative space to camera space, for an eye at the position `eye` in camera-relative
/// space.
glm::dmat4 cameraFromDraw(const CameraBasis& basis, const glm::dvec3& eye) {
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, eye)); };
    return fromRows(row(basis.right), row(basis.up), row(basis.view), {0, 0, 0, 1});
}

/// Returns the camera-relative space whose origin is the grid point nearest to `local`. The position `local` is in the
/// model's local space.
CameraRelativeSpace cameraRelativeSpaceAt(
    const plan::View& view, const hierarchy::Grid& grid, const glm::dvec3& local) {
    CameraRelativeSpace space;
    space.step = grid.step();
    const glm::dvec3 cell =
        glm::clamp(glm::round(local / space.step), glm::dvec3(0), glm::dvec3(hierarchy::kMaxGridCoordinate));
    space.originCell = {
        static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y), static_cast<std::uint32_t>(cell.z)};
    space.eye = (view.camera.eye - grid.origin) - grid.local(space.originCell);
    space.cameraFromDraw = cameraFromDraw(cameraBasis(view.camera), space.eye);
    return space;
}

/// Returns the position of the origin of `space` in the frame's camera-relative space.
glm::dvec3 originIn(const DrawInputs& frame, const CameraRelativeSpace& space) {
    const auto cells = [](const hierarchy::GridPoint& p) { return glm::dvec3(p.x, p.y, p.z); };
    return (cells(space.originCell) - cells(frame.space.originCell)) * space.step;
}

/// Returns the coordinate system for drawing a stabilised shadow map. It depends only on the map's place in the world,
/// not on the camera or the frame.
MapDrawing stableDrawing(const DrawInputs& frame, const shadow::ShadowMap& map) {
    const plan::View& view = frame.plan->view;
    const shadow::LightFrame axes = shadow::stableWorldFrame(frame.plan->light.unit());
    const shadow::StablePlace& place = *map.stable;
    const auto middle = [&](std::size_t axis) {
        return (static_cast<double>(place.corner[axis]) + place.texels / 2.0) * place.texel;
    };
    const glm::dvec3 center = axes.x * middle(0) - axes.y * middle(1) + axes.z * middle(2);
    MapDrawing result;
    result.space = cameraRelativeSpaceAt(view, frame.grid, center - frame.grid.origin);
    const glm::dvec3 origin = frame.grid.origin + frame.grid.local(result.space.originCell);
    const shadow::WarpedMap warped = shadow::stableMap(place, axes, shadow::toLight(axes, origin));
    const glm::dmat4 clip = map.lightClipFromMap() * shadow::textureFromCamera(warped);
    result.image = shadow::rounded(shadow::mapImage(map, clip, originIn(frame, result.space)));
    return result;
}

} // namespace

CameraRelativeSpace cameraRelativeSpace(const plan::View& view, const hierarchy::Grid& grid, const Box& bounds) {
    return cameraRelativeSpaceAt(view, grid, glm::clamp(view.camera.eye, bounds.min, bounds.max) - grid.origin);
}

double pixelWidth(const plan::FramePlan& plan, const CameraRelativeSpace& space, const glm::dvec3& p) {
    return 2 * plan.view.tanHalfY() * glm::dot(plan.basis.view, p - space.eye) / plan.view.height;
}

glm::dmat4 imageClipFromDraw(const DrawInputs& frame) {
    const plan::View& view = frame.plan->view;
    const ImageProjection projection = imageProjection(frame);
    // Shifts the image so that the sample position is at the centre of the pixel.
    const glm::dvec2 moved = glm::dvec2(0) - 2.0 * frame.subpixel / glm::dvec2(view.width, view.height);
    return projection.clipFromCamera(moved) * cameraFromDraw(projection.basis, projection.eye);
}

MapDrawing mapDrawing(const DrawInputs& frame, const shadow::ShadowMap& map) {
    if (map.stable) return stableDrawing(frame, map);
    const plan::View& view = frame.plan->view;
    MapDrawing result;
    result.space = frame.space;
    if (map.origin != glm::dvec3(0)) {
        const glm::dvec3 inside = view.camera.eye + toWorld(frame.plan->basis, map.origin);
        result.space = cameraRelativeSpaceAt(view, frame.grid, inside - frame.grid.origin);
    }
    const glm::dmat4 clip = map.lightClipFromCamera() * result.space.cameraFromDraw;
    result.image = shadow::rounded(shadow::mapImage(map, clip, originIn(frame, result.space)));
    return result;
}

block::Frame frameBlock(const DrawInputs& frame, const CameraRelativeSpace& space, const glm::dmat4& clipFromDraw) {
    const plan::FramePlan& plan = *frame.plan;
    const plan::View& view = plan.view;
    const CameraBasis& basis = plan.basis;
    block::Frame result{};
    result.clipFromDraw = glm::mat4(clipFromDraw);
    result.originCell = glm::ivec3(space.originCell.x, space.originCell.y, space.originCell.z);
    result.filterTexels = plan.quality.filter;
    result.eye = glm::vec3(space.eye);
    result.gridStep = static_cast<float>(space.step);
    result.viewDirection = glm::vec3(basis.view);
    result.originDepth = static_cast<float>(-glm::dot(basis.view, space.eye));
    result.towardsLight = glm::vec3(toDraw(basis, plan.towardsLight));
    if (view.pointLight) {
        result.towardsLight = glm::vec3(view.pointLight->at - frame.grid.origin - frame.grid.local(space.originCell));
        result.pointReach = static_cast<float>(view.pointLight->reach);
    }
    result.pixelSlope = static_cast<float>(2 * view.tanHalfY() / view.height);
    result.sliceCount = static_cast<int>(std::max<std::size_t>(plan.splits.size(), 2)) - 1;
    result.sideFaceCount = static_cast<int>(plan.selector.faces.size());
    result.hasOwnNear = plan.selector.ownNear ? 1 : 0;
    result.errorPixels = static_cast<float>(plan.quality.errorPixels);
    setLight(view, plan.quality.look, frame.shading, result);
    if (frame.lightPart == LightPart::WithoutSky) removeSkyLight(plan.quality.look, result);
    if (frame.lightPart == LightPart::SkyDirection) keepOnlySkyDirection(plan.quality.look, frame.skyWeight, result);
    return result;
}

block::Shadows shadowsBlock(const DrawInputs& frame) {
    const plan::FramePlan& plan = *frame.plan;
    GNOMON_CHECK_OP(plan.passes.size(), <=, std::size_t{GNOMON_MAX_PARTITIONS});
    GNOMON_CHECK_OP(plan.splits.size(), <=, std::size_t{GNOMON_MAX_SLICES});
    block::Shadows result{};
    for (std::size_t i = 0; i < plan.selector.faces.size(); ++i) {
        const shadow::FaceSelector& face = plan.selector.faces[i];
        result.faceFirst[i] = toDraw(plan.basis, face.first);
        result.faceSecond[i] = toDraw(plan.basis, face.second);
        result.faceEdge[i] = toDraw(plan.basis, face.edge, face.edgeOffset);
    }
    GNOMON_CHECK_OP(plan.passOfPartition.size(), <=, std::size_t{GNOMON_MAX_PARTITIONS});
    for (std::size_t i = 0; i < plan.passOfPartition.size(); ++i)
        result.passOfPartition[i / 4][static_cast<int>(i % 4)] = plan.passOfPartition[i];
    for (std::size_t i = 0; i + 1 < plan.splits.size(); ++i)
        result.slices[i] = {static_cast<float>(plan.splits[i]), static_cast<float>(plan.splits[i + 1]), glm::vec2(0)};
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        const shadow::ShadowMap& map = plan.passes[p].map;
        const shadow::FloatMapImage image = mapDrawing(frame, map).image;
        block::Partition& out = result.partitions[p];
        out.clipFromOffset = image.clipFromOffset;
        out.origin = image.origin;
        out.reach = image.reach;
        out.logRows = image.logRows;
        out.texelScale = image.texelScale;
        out.texelOffset = image.texelOffset;
        out.byColumn = image.byColumn;
        out.byRow = image.byRow;
        out.byDepth = image.byDepth;
        out.axisX = glm::vec3(toDraw(plan.basis, shadow::alongX(map.warped.frame)));
        out.unevenX = image.unevenX;
        out.axisZ = glm::vec3(toDraw(plan.basis, map.warped.frame.z));
        out.unevenZ = image.unevenZ;
        const shadow::TexelRectangle& r = map.rectangle;
        out.firstTexel = glm::vec2(r.x, r.y);
        out.endTexel = glm::vec2(r.x + r.width, r.y + r.height);
    }
    return result;
}

} // namespace gnomon::render
