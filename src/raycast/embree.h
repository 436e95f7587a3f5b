// What all who ask Embree share: a device, its errors, its triangles, its rays.
#pragma once

#include "core/error.h"
#include "raycast/ray.h"

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace gnomon::raycast {

/// A device of its own, to be released. Throws Error if there is none.
inline RTCDevice newDevice() {
    RTCDevice device = rtcNewDevice(nullptr);
    if (device == nullptr) throw Error("ray tracing: Embree gives no device");
    return device;
}

/// Throws Error if Embree has failed at `what`.
inline void requireNoError(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw Error(std::string("ray tracing: ") + what + ": Embree error " + std::to_string(error));
}

/// `ray` as Embree takes it.
inline RTCRay embreeRay(const Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tnear = ray.least;
    result.tfar = ray.greatest;
    result.mask = ~0U;
    return result;
}

/// A geometry of triangles that is to be filled and committed, and its room.
struct TriangleGeometry {
    RTCGeometry geometry = nullptr;
    float* positions = nullptr;       // 3 a vertex
    std::uint32_t* indices = nullptr; // 3 a triangle
};

/// Room for so many vertices and triangles. Throws Error if there is none.
inline TriangleGeometry newTriangles(RTCDevice device, std::size_t vertices, std::size_t triangles) {
    TriangleGeometry result{rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE)};
    result.positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        result.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    result.indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        result.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
    requireNoError(device, "making room");
    return result;
}

/// Commits what was filled and hands it to `scene`.
inline void attachTriangles(RTCScene scene, const TriangleGeometry& filled) {
    rtcCommitGeometry(filled.geometry);
    rtcAttachGeometry(scene, filled.geometry);
    rtcReleaseGeometry(filled.geometry);
}

} // namespace gnomon::raycast
