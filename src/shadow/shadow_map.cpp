#include "shadow/shadow_map.h"

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
    // [0, 1] over the map becomes [-1, 1] over it, and that what the map is of its rectangle.
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
    // t w = (1 + kappa d) / (kappa d) (w - 1), so that y is -1.
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

/// The longest rows, in unfitted ones, of those that a kernel reads within `reach` rows of a point of each part.
std::array<double, kFittedParts> longestRows(const FittedRows& rows, double reach) {
    std::array<double, kFittedParts> longest{};
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        const double from = rows.start(i) - reach;
        const double to = rows.start(i + 1) + reach;
        for (std::size_t k = 0; k < kFittedParts; ++k)
            if (rows.start(k + 1) >= from && rows.start(k) <= to) longest[i] = std::max(longest[i], 1 / rows.ofPart(k));
    }
    return longest;
}

/// Counts the unfitted rows of `image` from where the fitted ones begin.
void fitRows(const ShadowMap& map, DoubleMapImage& image) {
    const FittedRows& rows = *map.warped.fitted;
    const double count = map.texels().t;
    const double first = map.rectangle.y + map.gutter;
    image.texelOffset.y -= first + rows.low() * count;
    RowParts<double> parts;
    parts.partsPerRow = kFittedParts / (count * (rows.high() - rows.low()));
    parts.longest = longestRows(rows, image.reach / count);
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        parts.start[i] = first + rows.start(i) * count;
        parts.density[i] = rows.ofPart(i);
        if (image.logRows == 0) continue;
        const double steps = image.reach / image.texelScale.y;
        parts.longest[i] = std::expm1(steps * parts.longest[i]) / steps;
    }
    image.rowParts = std::make_shared<const RowParts<double>>(parts);
}

} // namespace

DoubleMapImage mapImage(const ShadowMap& map, const glm::dmat4& lightClipFromOffset, const glm::dvec3& origin) {
    const TexelRectangle& r = map.rectangle;
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
    if (map.warped.rows == RowSpacing::Even) {
        if (map.warped.fitted) fitRows(map, image);
        return image;
    }
    image.logRows = 1;
    image.texelScale.y = map.rowsPerLog();
    image.texelOffset.y = r.y;
    // A step of `reach` rows towards the light's near end is the longest: 1 / w grows by e^(reach / rowsPerLog).
    const double steps = image.reach / map.rowsPerLog();
    const double longer = map.warped.fitted ? 1 : std::expm1(steps) / steps; // else it is the parts'
    image.byRow = offsetFromClip[1] * (longer / map.rowsPerLog());
    image.unevenZ *= longer;
    if (map.warped.fitted) fitRows(map, image);
    return image;
}

namespace {

/// The inverse of `rowAt`.
double unfittedFrom(const RowParts<float>& parts, double row) {
    const auto after = std::upper_bound(parts.start.begin() + 1, parts.start.end(), row);
    const auto i = static_cast<std::size_t>(after - parts.start.begin()) - 1;
    return static_cast<double>(i) / double{parts.partsPerRow} +
           (row - double{parts.start[i]}) / double{parts.density[i]};
}

} // namespace

std::vector<float> rowPositions(const FloatMapImage& image, int firstRow, int count) {
    std::vector<float> positions;
    if (image.logRows == 0 && !image.rowParts) return positions;
    positions.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double row = firstRow + i + 0.5;
        const double unfitted = image.rowParts ? unfittedFrom(*image.rowParts, row) : row;
        const double up = (unfitted - double{image.texelOffset.y}) / double{image.texelScale.y};
        positions.push_back(static_cast<float>(image.logRows == 0 ? up : -std::exp(-up)));
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
    if (!image.rowParts) return result;
    RowParts<float> parts;
    parts.partsPerRow = static_cast<float>(image.rowParts->partsPerRow);
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        parts.start[i] = static_cast<float>(image.rowParts->start[i]);
        parts.density[i] = static_cast<float>(image.rowParts->density[i]);
        parts.longest[i] = static_cast<float>(image.rowParts->longest[i]);
    }
    result.rowParts = std::make_shared<const RowParts<float>>(parts);
    return result;
}

} // namespace gnomon::shadow
