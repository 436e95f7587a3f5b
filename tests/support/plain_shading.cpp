#include "tests/support/plain_shading.h"

#include "render/light/light_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::render {
namespace {

using glm::vec3;
using glm::vec4;

vec3 at(const std::array<float, 3>& v) {
    return {v[0], v[1], v[2]};
}

template <class T>
vec3 at(const PixelBatch::Vectors<T>& values, std::size_t i) {
    return {static_cast<float>(values[0][i]), static_cast<float>(values[1][i]), static_cast<float>(values[2][i])};
}

void put(const vec3& v, PixelBatch::Vectors<float>& values, std::size_t i) {
    for (int axis = 0; axis < 3; ++axis)
        values[static_cast<std::size_t>(axis)][i] = v[axis];
}

vec3 cross(const vec3& a, const vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

float dot(const vec3& a, const vec3& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

vec3 normalizedOr(const vec3& a, const vec3& otherwise) {
    const float square = dot(a, a);
    return square > 0 ? a * (1 / std::sqrt(square)) : otherwise;
}

vec3 turned(const vec3& a, const vec3& towards) {
    return dot(a, towards) < 0 ? -a : a;
}

vec3 octahedral(std::uint32_t bits) {
    if (bits == 0x80008000U) return vec3(0);
    const auto half = [](std::uint32_t b) {
        return std::max(static_cast<float>(static_cast<std::int16_t>(b)) * (1 / 32767.0F), -1.0F);
    };
    const float ex = half(bits & 0xFFFFU);
    const float ey = half(bits >> 16U);
    vec3 n(ex, ey, (1 - std::abs(ex)) - std::abs(ey));
    if (n.z < 0) {
        n.x = std::copysign(1 - std::abs(ey), ex);
        n.y = std::copysign(1 - std::abs(ex), ey);
    }
    return n * (1 / std::sqrt(dot(n, n)));
}

/// How far along an edge lies its point that is seen nearest to the ray, and how far beside the ray.
std::pair<float, float> nearestOnEdge(const vec3& ray, bool isParallel, const vec3& end, const vec3& edge) {
    const vec3 u = cross(end, ray);
    const vec3 v = cross(edge, ray);
    const float along = std::min(std::max(-dot(u, v) / std::max(dot(v, v), 1e-30F), 0.0F), 1.0F);
    const vec3 point = end + edge * along;
    const vec3 beside = u + v * along;
    if (isParallel) return {along, dot(beside, beside)};
    return {along, dot(beside, beside) / std::max(dot(point, point), 1e-30F)};
}

/// Of corner 0, 1 and 2: where the ray meets the triangle, or the outline's nearest point.
vec3 weights(const vec3& ray, bool isParallel, const vec3& fromCorner, const vec3& e1, const vec3& e2) {
    const vec3 across = cross(fromCorner, ray);
    const vec3 normal = cross(e1, e2);
    const float determinant = dot(ray, normal);
    const float largest = std::max(std::max(std::abs(normal.x), std::abs(normal.y)), std::abs(normal.z));
    if (std::abs(determinant) > std::max(1e-4F * largest, 1e-20F)) {
        const float scaling = 1 / determinant;
        const float second = -(dot(e2, across) * scaling);
        const float third = dot(e1, across) * scaling;
        if (second >= 0 && third >= 0 && second + third <= 1) return {(1 - second) - third, second, third};
    }
    const auto [first, besideFirst] = nearestOnEdge(ray, isParallel, -fromCorner, e1);
    const auto [second, besideSecond] = nearestOnEdge(ray, isParallel, -fromCorner, e2);
    const auto [opposite, besideOpposite] = nearestOnEdge(ray, isParallel, -fromCorner + e1, e2 - e1);
    if (besideOpposite < std::min(besideFirst, besideSecond)) {
        const float w = 1 - opposite;
        return {(1 - w) - opposite, w, opposite};
    }
    if (besideSecond < besideFirst) return {(1 - 0.0F) - second, 0, second};
    return {(1 - first) - 0.0F, first, 0};
}

template <class T>
T mix(const vec3& w, const T& a, const T& b, const T& c) {
    return (w.x * a + w.y * b) + w.z * c;
}

std::uint32_t level(float value) {
    return (static_cast<std::uint32_t>(510 * std::min(std::max(value, 0.0F), 1.0F)) + 1) / 2;
}

vec3 colorOf(std::uint32_t bits) {
    return {bits & 0xFFU, bits >> 8U & 0xFFU, bits >> 16U & 0xFFU};
}

/// What comes from everywhere but the sun.
vec3 ambientLight(const block::Frame& frame, const vec3& normal, const vec3& eyeDirection) {
    const float cosine = dot(normal, eyeDirection);
    return (frame.ambientMean + frame.ambientTilt * dot(normal, frame.skyAxis)) +
           vec3(frame.headlight * (cosine * cosine));
}

void shadeOne(const ShadingFrame& f, PixelBatch& batch, std::size_t i) {
    const vec3 ray = (at(f.rayFirst) + at(f.rayPerX) * batch.x[i]) + at(f.rayPerY) * batch.y[i];
    const vec3 corner = at(batch.corner, i);
    const vec3 e1 = at(batch.edge1, i);
    const vec3 e2 = at(batch.edge2, i);
    vec3 origin = at(f.rayOriginCells);
    if (f.isParallel) origin = (origin + at(f.originPerX) * batch.x[i]) + at(f.originPerY) * batch.y[i];
    const vec3 w = weights(ray, f.isParallel, origin - corner, e1, e2);
    const vec3 position = ((corner + e1 * w.y) + e2 * w.z) * f.frame->gridStep;
    const vec3 towardsEye = f.frame->eye - position;
    const vec3 eyeDirection = normalizedOr(towardsEye, vec3(0));
    const vec3 flat = turned(normalizedOr(cross(e1, e2), eyeDirection), towardsEye);
    vec3 smooth =
        mix(w, octahedral(batch.normals[0][i]), octahedral(batch.normals[1][i]), octahedral(batch.normals[2][i]));
    smooth = f.frame->isFaceted != 0 ? flat : turned(normalizedOr(smooth, flat), flat);
    const vec3 light = f.frame->towardsLight;
    const float cosine = dot(flat, light);
    const float depth = dot(f.frame->viewDirection, position) + f.frame->originDepth;

    batch.lit[i] = cosine > 0 ? 1.0F : 0.0F;
    batch.pass[i] = -1;
    if (f.litSource == LitSource::Mask) batch.lit[i] = batch.litMask[i];
    if (cosine > 0 && f.litSource == LitSource::Maps) {
        batch.pass[i] = plainPassOf(f, position - f.frame->eye, depth);
        if (batch.pass[i] >= 0) batch.lit[i] = plainLitFraction(f, batch.pass[i], position, flat, cosine);
    }
    const float direct = batch.lit[i] * std::max(dot(smooth, light), 0.0F);
    const vec3 color = mix(w, colorOf(batch.colors[0][i]), colorOf(batch.colors[1][i]), colorOf(batch.colors[2][i]));
    const vec3 received = ambientLight(*f.frame, smooth, eyeDirection) + f.frame->sun * direct;
    vec3 shaded(0);
    for (int c = 0; c < 3; ++c)
        shaded[c] = displayFromLinear(toneMapped(*f.frame, linearFromDisplay(color[c] * (1 / 255.0F)) * received[c]));
    put(position, batch.position, i);
    put(flat, batch.flatNormal, i);
    put(shaded, batch.shaded, i);
    batch.depth[i] = depth;
    batch.faces[i] = cosine > 0 ? -1 : 0;
    batch.color[i] = level(shaded.x) | level(shaded.y) << 8U | level(shaded.z) << 16U;
}

} // namespace

int plainPassOf(const ShadingFrame& f, const vec3& p, float z) {
    const block::Frame& frame = *f.frame;
    int slice = 0;
    while (slice + 1 < frame.sliceCount && z >= f.shadows->slices[slice].far)
        ++slice;
    int face = 0;
    if (frame.sideFaceCount > 0) {
        const auto owns = [&](int i) {
            return dot(vec3(f.shadows->faceFirst[i]), p) >= 0 && dot(vec3(f.shadows->faceSecond[i]), p) >= 0;
        };
        while (face + 1 < frame.sideFaceCount && !owns(face))
            ++face;
        const vec4& edge = f.shadows->faceEdge[face];
        if (frame.hasOwnNear == 1 && dot(vec3(edge), p) < edge.w * f.shadows->slices[slice].near)
            face = frame.sideFaceCount;
    }
    const int index = slice * (std::max(frame.sideFaceCount, 1) + frame.hasOwnNear) + face;
    return f.shadows->passOfPartition[index / 4][index % 4];
}

/// The logarithm by powers of (m - 1) / (m + 1), m between sqrt(1/2) and sqrt 2.
float plainLog(float value) {
    constexpr std::int32_t kRootOfHalf = 0x3F3504F3;
    const std::int32_t bits = std::bit_cast<std::int32_t>(value) - kRootOfHalf;
    const auto exponent = static_cast<float>(bits >> 23);
    const auto m = std::bit_cast<float>((bits & 0x7FFFFF) + kRootOfHalf);
    const float s = (m - 1) / (m + 1);
    const float square = s * s;
    const float series = (((2.0F / 9 * square + 2.0F / 7) * square + 2.0F / 5) * square + 2.0F / 3) * square + 2.0F;
    return exponent * 0.693359375F + (s * series + exponent * -2.12194440e-4F);
}

float plainLitFraction(const ShadingFrame& f, int pass, const vec3& p, const vec3& normal, float cosine) {
    const block::Partition& part = f.shadows->partitions[pass];
    const vec3 offset = p - part.origin;
    const auto coordinate = [&](int row) {
        const glm::mat4& m = part.clipFromOffset;
        return (m[0][row] * offset.x + m[1][row] * offset.y) + (m[2][row] * offset.z + m[3][row]);
    };
    const float w = coordinate(3);
    const float inverseW = 1 / (std::abs(w) > 1e-30F ? w : 1e-30F);
    const auto withPlane = [&](const vec4& by) {
        return std::abs(dot(normal, vec3(by)) + -dot(normal, offset) * by.w);
    };
    const int width = std::max(f.frame->filterTexels, 1);
    const bool isLog = part.logRows > 0;
    const float along = isLog ? plainLog(std::max(w, 1e-30F)) : coordinate(1) * inverseW;
    const glm::vec2 texels = glm::vec2(coordinate(0) * inverseW, along) * part.texelScale + part.texelOffset;
    const float byRow = withPlane(part.byRow) * (isLog ? inverseW : 1.0F);
    const float slope = (withPlane(part.byColumn) + byRow) / std::max(withPlane(part.byDepth), 1e-30F);
    const float uneven = std::hypot(part.unevenX, part.unevenZ * (isLog ? 1.0F : w));
    const float bias = (slope * std::min(1.0F, cosine * 10) + uneven) * part.reach + 6e-7F;
    const float depth = std::min(coordinate(2) * inverseW - bias, 1.0F);
    const auto start = [&](int axis) {
        return std::min(std::max(texels[axis] - 0.5F * static_cast<float>(width - 1), -1e6F), 1e6F);
    };
    const auto isLit = [&](int x, int y) {
        const int texelX =
            std::min(std::max(x, static_cast<int>(part.firstTexel.x)), static_cast<int>(part.endTexel.x) - 1);
        const int texelY =
            std::min(std::max(y, static_cast<int>(part.firstTexel.y)), static_cast<int>(part.endTexel.y) - 1);
        return depth <= f.shadowDepth[texelY * f.shadowWidth + texelX] ? 1.0F : 0.0F;
    };
    // The mean over each of the four squares that the kernel holds and that are a texel narrower, between them.
    const int box = std::max(width - 1, 1);
    const float firstX = std::floor(start(0));
    const float firstY = std::floor(start(1));
    const auto ofRow = [&](int y) {
        float left = 0;
        float right = 0;
        for (int x = 0; x < box; ++x) {
            left += isLit(static_cast<int>(firstX) + x, y);
            right += isLit(static_cast<int>(firstX) + x + width - box, y);
        }
        return left + (start(0) - firstX) * (right - left);
    };
    float above = 0;
    float below = 0;
    for (int y = 0; y < box; ++y) {
        above += ofRow(static_cast<int>(firstY) + y);
        below += ofRow(static_cast<int>(firstY) + y + width - box);
    }
    return (above + (start(1) - firstY) * (below - above)) / static_cast<float>(box * box);
}

void plainShade(const ShadingFrame& frame, PixelBatch& batch) {
    for (std::size_t i = 0; i < batch.count; ++i)
        shadeOne(frame, batch, i);
}

} // namespace gnomon::render
