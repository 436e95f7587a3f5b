// Computes the squared distances from one point to up to 16 triangles at once, with one triangle per SIMD lane.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon::proximity {

/// A batch of up to kCapacity triangles. Each coordinate of each corner is stored in one row over all triangles.
class TriangleBatch {
public:
    static constexpr std::size_t kCapacity = 16;
    using Row = std::array<double, kCapacity>;

    std::size_t count() const { return count_; }

    bool isFull() const { return count_ == kCapacity; }

    void clear() { count_ = 0; }

    /// Adds a triangle. The batch must not be full.
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        put(corners_[0], a);
        put(corners_[1], b);
        put(corners_[2], c);
        ++count_;
    }

    /// Writes the squared distance from `point` to triangle i into `squares[i]`. The results are bit-identical to
    /// `squaredDistance` (triangle_distance.h). The values after the last triangle are undefined.
    void squaredDistances(const glm::dvec3& point, Row& squares) const;

private:
    void put(std::array<Row, 3>& corner, const glm::dvec3& position) {
        corner[0][count_] = position.x;
        corner[1][count_] = position.y;
        corner[2][count_] = position.z;
    }

    std::array<std::array<Row, 3>, 3> corners_{};
    std::size_t count_ = 0;
};

} // namespace gnomon::proximity
