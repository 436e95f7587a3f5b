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

/// The longest texels along an axis, in unfitted ones, of those that a kernel reads within `reach`, of the axis, of a
/// point of each part.
std::array<double, kFittedParts> longestTexels(const FittedAxis& axis, double reach) {
    std::array<double, kFittedParts> longest{};
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        const double from = axis.start(i) - reach;
        const double to = axis.start(i + 1) + reach;
        for (std::size_t k = 0; k < kFittedParts; ++k)
            if (axis.start(k + 1) >= from && axis.start(k) <= to) longest[i] = std::max(longest[i], 1 / axis.ofPart(k));
    }
    return longest;
}

/// The parts of an axis of `count` texels from `first` on, for a kernel that reaches so many; takes from `offset` what
/// unfitted texels then are counted from.
AxisParts<double> axisParts(const FittedAxis& axis, double first, double count, double reach, double& offset) {
    offset -= first + axis.low() * count;
    AxisParts<double> parts;
    parts.partsPerTexel = kFittedParts / (count * (axis.high() - axis.low()));
    parts.longest = longestTexels(axis, reach / count);
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        parts.start[i] = first + axis.start(i) * count;
        parts.density[i] = axis.ofPart(i);
    }
    return parts;
}

void fitGrid(const ShadowMap& map, DoubleMapImage& image) {
    const FittedGrid& grid = *map.warped.fitted;
    const TexelRectangle inner = map.innerRectangle();
    GridParts<double> parts;
    parts.columns = axisParts(grid.columns, inner.x, inner.width, image.reach, image.texelOffset.x);
    parts.rows = axisParts(grid.rows, inner.y, inner.height, image.reach, image.texelOffset.y);
    for (std::size_t i = 0; i < kFittedParts; ++i) {
        parts.columns.start[i] += map.shift.x;
        parts.rows.start[i] += map.shift.y;
    }
    if (image.logRows != 0) {
        const double steps = image.reach / image.texelScale.y;
        for (double& longest : parts.rows.longest)
            longest = std::expm1(steps * longest) / steps;
    }
    image.fitted = std::make_shared<const GridParts<double>>(parts);
}

} // namespace

namespace {

/// `clip` with even columns and rows moved by the map's shift. Clip space is 2 w wide over the rectangle.
glm::dmat4 shifted(const ShadowMap& map, glm::dmat4 clip) {
    if (map.shift == glm::dvec2(0) || map.warped.fitted) return clip;
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
    if (map.warped.rows == RowSpacing::Even) {
        if (map.warped.fitted) fitGrid(map, image);
        return image;
    }
    image.logRows = 1;
    image.reach += rowsMissed(map.region.frustum, map.region.face, map.warped.frame.y, map.texels().t);
    image.texelScale.y = map.rowsPerLog();
    image.texelOffset.y = r.y + (map.warped.fitted ? 0 : map.shift.y);
    // A step of `reach` rows towards the light's near end is the longest: 1 / w grows by e^(reach / rowsPerLog).
    const double steps = image.reach / map.rowsPerLog();
    const double longer = map.warped.fitted ? 1 : std::expm1(steps) / steps; // else it is the parts'
    image.byRow = offsetFromClip[1] * (longer / map.rowsPerLog());
    image.unevenZ *= longer;
    if (map.warped.fitted) fitGrid(map, image);
    return image;
}

namespace {

/// The part that a texel lies in.
std::size_t partFrom(const AxisParts<float>& parts, double texel) {
    const auto after = std::upper_bound(parts.start.begin() + 1, parts.start.end(), texel);
    return static_cast<std::size_t>(after - parts.start.begin()) - 1;
}

/// The inverse of `texelAt`.
double unfittedFrom(const AxisParts<float>& parts, double row) {
    const std::size_t i = partFrom(parts, row);
    return static_cast<double>(i) / double{parts.partsPerTexel} +
           (row - double{parts.start[i]}) / double{parts.density[i]};
}

} // namespace

std::vector<float> rowPositions(const FloatMapImage& image, int firstRow, int count) {
    std::vector<float> positions;
    if (image.logRows == 0 && !image.fitted) return positions;
    positions.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double row = firstRow + i + 0.5;
        const double unfitted = image.fitted ? unfittedFrom(image.fitted->rows, row) : row;
        const double up = (unfitted - double{image.texelOffset.y}) / double{image.texelScale.y};
        positions.push_back(static_cast<float>(image.logRows == 0 ? up : -std::exp(-up)));
    }
    return positions;
}

std::vector<EvenColumns> columnRuns(const FloatMapImage& image, int firstColumn, int count) {
    std::vector<EvenColumns> runs;
    if (!image.fitted) return runs;
    const AxisParts<float>& parts = image.fitted->columns;
    const auto run = [&](std::size_t part, int end) -> EvenColumns {
        const double density = parts.density[part];
        const double begins = static_cast<double>(part) / double{parts.partsPerTexel};
        return {
            end,
            static_cast<float>(double{image.texelScale.x} * density),
            static_cast<float>(double{parts.start[part]} + (double{image.texelOffset.x} - begins) * density)};
    };
    // Parts beside each other that are alike are one run.
    float before = 0;
    for (int i = 0; i < count; ++i) {
        const std::size_t part = partFrom(parts, firstColumn + i + 0.5);
        const float density = parts.density[part];
        if (i == 0 || density != before) runs.push_back(run(part, 0));
        runs.back().end = firstColumn + i + 1;
        before = density;
    }
    if (runs.size() == 1) runs.clear(); // even over all of the map
    return runs;
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
    if (!image.fitted) return result;
    const auto roundedParts = [](const AxisParts<double>& from) {
        AxisParts<float> parts;
        parts.partsPerTexel = static_cast<float>(from.partsPerTexel);
        for (std::size_t i = 0; i < kFittedParts; ++i) {
            parts.start[i] = static_cast<float>(from.start[i]);
            parts.density[i] = static_cast<float>(from.density[i]);
            parts.longest[i] = static_cast<float>(from.longest[i]);
        }
        return parts;
    };
    result.fitted = std::make_shared<const GridParts<float>>(
        GridParts<float>{roundedParts(image.fitted->columns), roundedParts(image.fitted->rows)});
    return result;
}

} // namespace gnomon::shadow
