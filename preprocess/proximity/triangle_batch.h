// The distances of one point from several triangles at once, in vector lanes.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon::proximity {

/// Up to kCapacity triangles, by corner and coordinate.
class TriangleBatch {
public:
    static constexpr std::size_t kCapacity = 16;
    using Row = std::array<double, kCapacity>;

    std::size_t count() const { return count_; }

    bool isFull() const { return count_ == kCapacity; }

    void clear() { count_ = 0; }

    /// There must be room.
    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        put(corners_[0], a);
        put(corners_[1], b);
        put(corners_[2], c);
        ++count_;
    }

    /// The squared distance of `point` from each triangle in turn, to the bit that of `squaredDistance`
    /// (triangle_distance.h); behind the last there is anything.
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
