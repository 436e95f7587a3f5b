#include "shadow/shadow_map.h"

#include "shadow/partition/grazing.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

TexelRectangle ShadowMap::innerRectangle() const {
    TexelRectangle inner = rectangle;
    inner.x += gutter;
    inner.y += gutter;
    inner.width -= 2 * gutter;
    inner.height -= 2 * gutter;
    return inner;
}

Resolution ShadowMap::texels() const {
    const TexelRectangle inner = innerRectangle();
    const double columns = inner.width;
    const double rows = inner.height;
    return {1, rectangle.transposed ? rows : columns, rectangle.transposed ? columns : rows};
}

glm::dmat4 ShadowMap::lightClipFromMap() const {
    // Converts the map coordinates [0, 1] to [-1, 1], scaled to the part of the rectangle inside its borders.
    const TexelRectangle inner = innerRectangle();
    const double scaleX = static_cast<double>(inner.width) / rectangle.width;
    const double scaleY = static_cast<double>(inner.height) / rectangle.height;
    const glm::dvec4 alongX(2 * scaleX, 0, 0, 0);
    const glm::dvec4 alongY(0, 2 * scaleY, 0, 0);
    glm::dmat4 clip(1);
    clip[0] = rectangle.transposed ? alongY : alongX;
    clip[1] = rectangle.transposed ? alongX : alongY;
    clip[3] = {-scaleX, -scaleY, 0, 1};
    if (warped.rows == RowSpacing::Even) return clip;
    // With logarithmic rows, the row is computed from w = 1 + kappa zeta. The matrix contains w through t w = (1 +
    // kappa d) / (kappa d) (w - 1). This code makes y / w equal to -1.
    const double warp = warped.kappa * warped.length;
    for (glm::length_t column = 0; column < 4; ++column)
        clip[column].y = 0;
    clip[1].y = warp / (1 + warp);
    clip[3].y = -1;
    const double wAtEdge = std::exp(-gutter / rowsPerLog());
    for (glm::length_t column = 0; column < 4; ++column)
        clip[column] /= glm::dvec4(wAtEdge, 1, wAtEdge, wAtEdge);
    return clip;
}

double ShadowMap::rowsPerLog() const {
    return texels().t / std::log1p(warped.kappa * warped.length);
}

namespace {

/// Returns the matrix `clip` with columns and even rows shifted by the map's shift. The width of the map's rectangle in
/// clip space is 2 w.
glm::dmat4 shifted(const ShadowMap& map, glm::dmat4 clip) {
    if (map.shift == glm::dvec2(0)) return clip;
    const bool hasEvenRows = map.cubeFace || map.warped.rows == RowSpacing::Even;
    const glm::dvec2 perW = 2.0 * map.shift / glm::dvec2(map.rectangle.width, map.rectangle.height);
    for (glm::length_t column = 0; column < 4; ++column) {
        clip[column].x += perW.x * clip[column].w;
        if (hasEvenRows) clip[column].y += perW.y * clip[column].w;
    }
    return clip;
}

} // namespace

DoubleMapImage mapImage(const ShadowMap& map, const glm::dmat4& unmovedClipFromOffset, const glm::dvec3& origin) {
    const TexelRectangle& r = map.rectangle;
    const glm::dmat4 lightClipFromOffset = shifted(map, unmovedClipFromOffset);
    DoubleMapImage image;
    image.origin = origin;
    image.clipFromOffset = lightClipFromOffset;
    image.texelScale = glm::dvec2(r.width, r.height) / 2.0;
    image.texelOffset = glm::dvec2(r.x, r.y) + image.texelScale;
    const glm::dmat4 offsetFromClip = glm::inverse(lightClipFromOffset);
    image.byColumn = offsetFromClip[0] / image.texelScale.x;
    image.byRow = offsetFromClip[1] / image.texelScale.y;
    image.byDepth = offsetFromClip[2];
    const TexelDepth texel = texelDepth(map.warped, map.texels());
    image.unevenX = kUnevenSlope * texel.x;
    image.unevenZ = kUnevenSlope * texel.z;
    image.reach = reachTexels(map.filterTexels);
    if (map.cubeFace) {
        const Resolution texels = map.texels();
        image.unevenX = kUnevenSlope * map.cubeFace->sRange / texels.s * map.cubeFace->depthSlope();
        image.unevenZ = kUnevenSlope * map.cubeFace->tRange / texels.t * map.cubeFace->depthSlope();
        image.fromPoint = 1;
        return image;
    }
    if (map.warped.rows == RowSpacing::Even) return image;
    image.logRows = 1;
    image.reach += rowsMissed(map.region.frustum, map.region.face, map.warped.frame.y, map.texels().t);
    image.texelScale.y = map.rowsPerLog();
    image.texelOffset.y = r.y + map.shift.y;
    // A step of `reach` rows towards the near end of the map is the longest step, because 1 / w grows by the factor
    // e^(reach / rowsPerLog).
    const double steps = image.reach / map.rowsPerLog();
    const double longer = std::expm1(steps) / steps;
    image.byRow = offsetFromClip[1] * (longer / map.rowsPerLog());
    image.unevenZ *= longer;
    return image;
}

std::vector<float> rowPositions(const FloatMapImage& image, int firstRow, int count) {
    std::vector<float> positions;
    if (image.logRows == 0) return positions;
    positions.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double row = firstRow + i + 0.5;
        const double up = (row - double{image.texelOffset.y}) / double{image.texelScale.y};
        positions.push_back(static_cast<float>(-std::exp(-up)));
    }
    return positions;
}

DoubleMapImage cameraImage(const ShadowMap& map) {
    return mapImage(map, relativeTo(map.lightClipFromCamera(), map.origin), map.origin);
}

FloatMapImage rounded(const DoubleMapImage& image) {
    FloatMapImage result;
    result.origin = glm::vec3(image.origin);
    result.clipFromOffset = glm::mat4(image.clipFromOffset);
    result.texelScale = glm::vec2(image.texelScale);
    result.texelOffset = glm::vec2(image.texelOffset);
    result.byColumn = glm::vec4(image.byColumn);
    result.byRow = glm::vec4(image.byRow);
    result.byDepth = glm::vec4(image.byDepth);
    result.unevenX = static_cast<float>(image.unevenX);
    result.unevenZ = static_cast<float>(image.unevenZ);
    result.reach = static_cast<float>(image.reach);
    result.logRows = static_cast<float>(image.logRows);
    result.fromPoint = static_cast<float>(image.fromPoint);
    return result;
}

} // namespace gnomon::shadow
