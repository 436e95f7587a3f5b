// Common helpers for Embree: the device, error checks, triangle geometries and rays.
#pragma once

#include "core/error.h"
#include "raytrace/ray.h"

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace gnomon::raytrace {

/// Returns a new Embree device, which the caller must release. Throws Error if Embree returns none.
inline RTCDevice newDevice() {
    RTCDevice device = rtcNewDevice(nullptr);
    if (device == nullptr) throw Error("ray tracing: cannot create an Embree device");
    return device;
}

/// Throws Error if Embree has reported an error. `what` is the name of the failed operation for the message.
inline void requireNoError(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw Error(std::string("ray tracing: ") + what + ": Embree error " + std::to_string(error));
}

/// Converts `ray` to Embree's ray format.
inline RTCRay embreeRay(const Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tnear = ray.tMin;
    result.tfar = ray.tMax;
    result.mask = ~0U;
    return result;
}

/// A triangle geometry of Embree with its buffers. The caller first fills the buffers, and then calls attachTriangles.
struct TriangleGeometry {
    RTCGeometry geometry = nullptr;
    float* positions = nullptr;       // 3 per vertex
    std::uint32_t* indices = nullptr; // 3 per triangle
};

/// Returns a new Embree geometry with buffers for the given numbers of vertices and triangles. Throws Error if Embree
/// fails.
inline TriangleGeometry newTriangles(RTCDevice device, std::size_t vertices, std::size_t triangles) {
    TriangleGeometry result{rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE)};
    result.positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        result.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    result.indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        result.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
    requireNoError(device, "allocating geometry");
    return result;
}

/// Commits the Embree geometry `filled`, whose buffers the caller has filled, and attaches it to `scene`.
inline void attachTriangles(RTCScene scene, const TriangleGeometry& filled) {
    rtcCommitGeometry(filled.geometry);
    rtcAttachGeometry(scene, filled.geometry);
    rtcReleaseGeometry(filled.geometry);
}

} // namespace gnomon::raytrace
