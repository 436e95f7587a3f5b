// Buildings of boxes for walks: rows of rooms that are connected by doors, rotated by any angle.
#pragma once

#include "core/random.h"
#include "tests/path/boxes.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>

namespace gnomon::path {

/// A seeded storey of rooms between two slabs. The seed determines positions and widths of doors, obstacles and the
/// angle.
class Building {
public:
    static constexpr double kRoom = 5; // in metres
    static constexpr double kCeiling = 2.7;

    Building(std::uint64_t seed, int roomsX, int roomsZ) : roomsX_(roomsX), roomsZ_(roomsZ), random_(seed) {
        angle_ = random_.uniform(0, 6.28);
        const double x = kRoom * roomsX;
        const double z = kRoom * roomsZ;
        boxes_.add({0, -0.2, 0}, {x, 0, z});
        boxes_.add({0, kCeiling, 0}, {x, kCeiling + 0.2, z});
        boxes_.add({-0.2, -0.2, -0.2}, {0, kCeiling, z});
        boxes_.add({x, -0.2, -0.2}, {x + 0.2, kCeiling, z});
        boxes_.add({0, -0.2, -0.2}, {x, kCeiling, 0});
        boxes_.add({0, -0.2, z}, {x, kCeiling, z + 0.2});
        for (int j = 0; j < roomsZ; ++j)
            for (int i = 0; i < roomsX; ++i)
                addRoom(i, j);
        for (glm::dvec3& corner : boxes_.corners)
            corner = turned(corner, angle_);
    }

    void operator()(const std::string& path) const { boxes_.write(path); }

    /// Returns the room that contains a world point.
    int roomAt(const glm::dvec3& point) const {
        const glm::dvec3 at = turned(point, -angle_) / kRoom;
        return static_cast<int>(std::floor(at.z)) * roomsX_ + static_cast<int>(std::floor(at.x));
    }

    bool areJoined(int a, int b) const { return doors_.count(std::minmax(a, b)) > 0; }

    /// Returns the number of rooms on the longest of all shortest paths.
    int longestWay() const {
        int longest = 0;
        for (int start = 0; start < roomsX_ * roomsZ_; ++start) {
            std::vector<int> rooms(static_cast<std::size_t>(roomsX_ * roomsZ_), 0);
            std::queue<int> open({start});
            rooms[static_cast<std::size_t>(start)] = 1;
            for (; !open.empty(); open.pop())
                for (int next = 0; next < roomsX_ * roomsZ_; ++next) {
                    int& count = rooms[static_cast<std::size_t>(next)];
                    if (count > 0 || !areJoined(open.front(), next)) continue;
                    count = rooms[static_cast<std::size_t>(open.front())] + 1;
                    open.push(next);
                }
            longest = std::max(longest, *std::max_element(rooms.begin(), rooms.end()));
        }
        return longest;
    }

private:
    static glm::dvec3 turned(const glm::dvec3& p, double angle) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
    }

    /// Adds the walls of a room towards -x and -z, with or without a door, and sometimes a table.
    void addRoom(int i, int j) {
        const int room = j * roomsX_ + i;
        const bool isJoinedAlongX = i > 0 && (j == 0 || random_.below(2) == 0); // one door per room connects all rooms
        if (i > 0) addWall(i, j, true, isJoinedAlongX || random_.below(5) == 0 ? room - 1 : -1);
        if (j > 0) addWall(i, j, false, !isJoinedAlongX || random_.below(5) == 0 ? room - roomsX_ : -1);
        if (random_.below(2) == 0) return;
        const glm::dvec3 corner{kRoom * i + random_.uniform(1.2, 3), 0, kRoom * j + random_.uniform(1.2, 3)};
        boxes_.add(corner, corner + glm::dvec3(0.8, random_.uniform(0.5, 2), 0.8));
    }

    void addWall(int i, int j, bool isAlongZ, int joined) {
        const glm::dvec3 start(kRoom * i, 0, kRoom * j);
        const glm::dvec3 along = isAlongZ ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const glm::dvec3 half = 0.1 * (isAlongZ ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
        const auto part = [&](double from, double to, double bottom, double top) {
            const glm::dvec3 a = start + from * along - half + glm::dvec3(0, bottom, 0);
            boxes_.add(a, start + to * along + half + glm::dvec3(0, top, 0));
        };
        if (joined < 0) {
            part(0, kRoom, 0, kCeiling);
            return;
        }
        const double width = random_.uniform(0.8, 1.2);
        const double door = random_.uniform(0.5, kRoom - 0.5 - width);
        part(0, door, 0, kCeiling);
        part(door + width, kRoom, 0, kCeiling);
        part(door, door + width, 2.1, kCeiling);
        doors_.insert(std::minmax(joined, j * roomsX_ + i));
    }

    int roomsX_;
    int roomsZ_;
    Random random_;
    double angle_ = 0;
    Boxes boxes_;
    std::set<std::pair<int, int>> doors_;
};

} // namespace gnomon::path
