#include "shadow/partition/faces.h"

#include "core/check.h"

#include <cmath>

namespace gnomon::shadow {

namespace {

constexpr std::array<Face, 4> kSides{Face::Top, Face::Bottom, Face::Left, Face::Right};

/// Returns the two near corners of a side face of the frustum, as indices into shadow::corners. The far corners have
/// these indices plus 4.
std::array<std::size_t, 2> nearCorners(Face face) {
    switch (face) {
    case Face::Top:
        return {2, 3};
    case Face::Bottom:
        return {0, 1};
    case Face::Left:
        return {0, 2};
    case Face::Right:
        return {1, 3};
    default:
        break;
    }
    GNOMON_CHECK(false && "not a side face");
    return {};
}

/// Returns the light-space axes for the map of the near square. The square is a rectangle in these axes, with rows
/// parallel to the rows of the image. If the light sees the square edge-on, returns the axes in the plain orientation.
LightFrame squareFrame(const glm::dvec3& towardsLight) {
    const glm::dvec3 guide = glm::cross(glm::dvec3(1, 0, 0), towardsLight);
    if (!(glm::length(guide) > 1e-12)) return lightFrame(towardsLight);
    const LightFrame frame = lightFrameAlong(towardsLight, guide);
    const glm::dvec3 up(0, 1, 0);
    return std::abs(glm::dot(frame.z, up)) > 1e-12 ? leant(frame, up) : frame;
}

/// Returns the light-space axes for the map of a side face whose z is perpendicular to the near edge from `left` to
/// `right`.
LightFrame edgeFrame(const glm::dvec3& towardsLight, const glm::dvec3& left, const glm::dvec3& right) {
    const glm::dvec3 guide = glm::cross(towardsLight, right - left);
    // If the light is parallel to the edge, it sees the whole face as a line.
    if (!(glm::length(guide) > 1e-12 * glm::length(right - left))) return lightFrame(towardsLight);
    const LightFrame frame = lightFrameAlong(towardsLight, guide);
    return glm::dot(frame.z, left + right) < 0 ? LightFrame{-frame.x, frame.y, -frame.z} : frame;
}

} // namespace

const char* name(Face face) {
    switch (face) {
    case Face::Whole:
        return "whole";
    case Face::Top:
        return "top";
    case Face::Bottom:
        return "bottom";
    case Face::Left:
        return "left";
    case Face::Right:
        return "right";
    case Face::Near:
        return "near";
    case Face::PlusX:
        return "+x";
    case Face::MinusX:
        return "-x";
    case Face::PlusY:
        return "+y";
    case Face::MinusY:
        return "-y";
    case Face::PlusZ:
        return "+z";
    case Face::MinusZ:
        return "-z";
    }
    return "";
}

glm::dvec3 outwardNormal(const ViewFrustum& frustum, Face face) {
    switch (face) {
    case Face::Top:
        return glm::normalize(glm::dvec3(0, 1, -tanHalfY(frustum)));
    case Face::Bottom:
        return glm::normalize(glm::dvec3(0, -1, -tanHalfY(frustum)));
    case Face::Left:
        return glm::normalize(glm::dvec3(-1, 0, -tanHalfX(frustum)));
    case Face::Right:
        return glm::normalize(glm::dvec3(1, 0, -tanHalfX(frustum)));
    case Face::Near:
        return {0, 0, -1};
    default:
        break;
    }
    GNOMON_CHECK(false && "the whole and the faces of a cube have no normal of the view");
    return {};
}

std::vector<Face> sideFaces(const ViewFrustum& frustum, const glm::dvec3& towardsLight, double grazing) {
    const double sign = towardsLight.z <= 0 ? 1 : -1;
    std::vector<Face> faces;
    for (const Face face : kSides)
        if (sign * glm::dot(outwardNormal(frustum, face), towardsLight) > grazing) faces.push_back(face);
    return faces;
}

std::array<FitVertex, 4> faceVertices(const ViewFrustum& slice, Face face) {
    const std::array<glm::dvec3, 8> points = corners(slice);
    std::array<FitVertex, 4> vertices;
    if (face == Face::Near) {
        for (std::size_t i = 0; i < 4; ++i)
            vertices[i] = {points[i], DepthEnd::Near};
        return vertices;
    }
    const std::array<std::size_t, 2> near = nearCorners(face);
    for (std::size_t i = 0; i < 2; ++i) {
        vertices[i] = {points[near[i]], DepthEnd::Near};
        vertices[i + 2] = {points[near[i] + 4], DepthEnd::Far};
    }
    return vertices;
}

LightFrame faceFrame(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector) {
    if (face == Face::Near && bisector == Bisector::NearEdge) return squareFrame(towardsLight);
    if (face == Face::Near || face == Face::Whole) return lightFrame(towardsLight);
    const std::array<FitVertex, 4> vertices = faceVertices(slice, face);
    if (bisector == Bisector::NearEdge) return edgeFrame(towardsLight, vertices[0].position, vertices[1].position);
    const auto projectedEdge = [&](std::size_t side) {
        const glm::dvec3 edge = vertices[side + 2].position - vertices[side].position;
        const glm::dvec3 flat = edge - towardsLight * glm::dot(edge, towardsLight);
        const double length = glm::length(flat);
        return bisector == Bisector::Normalized && length > 0 ? flat / length : flat;
    };
    const glm::dvec3 guide = projectedEdge(0) + projectedEdge(1);
    // If the two projected edges are opposite, the light grazes the face, and the projection of the face defines no
    // orientation.
    if (!(glm::length(glm::cross(towardsLight, guide)) > 1e-12 * slice.far)) return lightFrame(towardsLight);
    return lightFrameAlong(towardsLight, guide);
}

LightFit fitFace(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector) {
    return fitRegion(faceFrame(slice, towardsLight, face, bisector), slice, faceVertices(slice, face));
}

} // namespace gnomon::shadow
