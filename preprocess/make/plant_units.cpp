#include "preprocess/make/plant_units.h"

#include "preprocess/make/noise.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

using glm::dvec3;

namespace {

void addTank(Site& site, const dvec3& foot, double radius, double height) {
    // The shell of a tank consists of rings of plates (courses). They overlap slightly and start at different angles,
    // so that consecutive courses share no vertices.
    const std::uint64_t courses = site.detail.amount(4, 2, 12);
    const std::uint64_t sides = std::max<std::uint64_t>(12, site.detail.sides(radius));
    for (std::uint64_t i = 0; i < courses; ++i) {
        const double low = height * share(i, courses);
        const double high = height * share(i + 1, courses);
        const double r = radius - 0.01 * static_cast<double>(i);
        const std::array<Station, 3> course{{{low, r}, {high - 0.05, r}, {high, r + 0.015}}};
        addLathe(site.parts, foot, kUp, course, sides, 0.37 * static_cast<double>(i));
    }
    const std::array<Station, 4> roof{
        {{height, radius + 0.1},
         {height + 0.02, radius + 0.1},
         {height + 0.05 * radius, 0.5 * radius},
         {height + 0.08 * radius, 0}}};
    addLathe(site.parts, foot, kUp, roof, sides);
    const std::uint64_t posts = std::max<std::uint64_t>(12, site.detail.amount(24, 12, 90));
    for (std::uint64_t i = 0; i < posts; ++i) {
        const dvec3 at = foot + radius * dvec3(cosTurns(share(i, posts)), 0, sinTurns(share(i, posts))) + kUp * height;
        addRod(site.parts, at, at + kUp * 1.1, 0.025, 4, Ends::Open);
    }
    for (const double lift : {0.55, 1.1})
        addRing(site.parts, foot + kUp * (height + lift), kUp, radius, 0.03, 2 * sides);
    // Adds the stair, which winds around the shell of the tank.
    const auto steps = static_cast<std::uint64_t>(height / 0.22);
    for (std::uint64_t i = 0; i < steps; ++i) {
        const double t = share(i, steps) * height * 1.6 / (6.2832 * radius);
        const dvec3 out(cosTurns(t), 0, sinTurns(t));
        const dvec3 along(-out.z, 0, out.x);
        const dvec3 at = foot + out * (radius + 0.05) + kUp * (height * share(i + 1, steps));
        addSheet(site.parts, at, out * 0.8, along * 0.3, i % 3 == 0 ? Sides::Both : Sides::One);
        if (i % 4 == 0) addRod(site.parts, at + out * 0.8, at + out * 0.8 + kUp * 1.05, 0.02, 4, Ends::Open);
    }
    for (const double t : {0.1, 0.35, 0.62}) {
        const dvec3 out(cosTurns(t), 0, sinTurns(t));
        const dvec3 nozzle = foot + out * (radius - 0.05) + kUp * 0.9;
        addRod(site.parts, nozzle, nozzle + out * 0.7, 0.22, site.detail.sides(0.22), Ends::Open);
        addFlange(site, nozzle + out * 0.7, out, 0.22);
    }
}

void addBund(Site& site, double half) {
    for (const double side : {-1.0, 1.0}) {
        addBox(site.parts, {-half, 0, side * half - 0.15}, {half, 1.0, side * half + 0.15});
        addBox(site.parts, {side * half - 0.15, 0, -half}, {side * half + 0.15, 1.0, half});
    }
}

} // namespace

void addTankFarm(Site& site) {
    addBund(site, 14.5);
    const bool isOne = site.random.below(2) == 0;
    // Each statement draws only one random number, because C++ does not specify in which order arguments are evaluated.
    const double scale = site.random.uniform(0.85, 1.0);
    if (isOne) addTank(site, {0, 0, 0}, 10.5 * scale, site.random.uniform(10, 14));
    for (const double x : {-7.0, 7.0})
        for (const double z : {-7.0, 7.0})
            if (!isOne) addTank(site, {x, 0, z}, 4.8 * scale, site.random.uniform(7, 11));
    addValve(site, {-13, 0.8, 12.5}, {1, 0, 0}, 0.18);
    addStairs(site, {14.9 + 1.2, 0, 3}, {14.9, 1.0, 3});
    const std::array<dvec3, 5> line{
        dvec3(-14, 0.8, 13.2),
        dvec3(10, 0.8, 13.2),
        dvec3(10, 2.2, 13.2),
        dvec3(13.4, 2.2, 13.2),
        dvec3(13.4, 2.2, -13)};
    addPipe(site, line, 0.15);
}

namespace {

void addTray(Site& site, const dvec3& a, const dvec3& b) {
    const dvec3 across(0.3, 0, 0);
    for (const double side : {-1.0, 1.0})
        addSheet(site.parts, a + across * side, b - a, kUp * 0.08);
    const std::uint64_t rungs = site.detail.amount(20, 6, 400);
    for (std::uint64_t i = 0; i < rungs; ++i) {
        const dvec3 at = a + (b - a) * share(i, rungs);
        addRod(site.parts, at - across, at + across, 0.012, 4, Ends::Open);
    }
    const std::uint64_t cables = site.detail.amount(2, 1, 14);
    for (std::uint64_t i = 0; i < cables; ++i) {
        const dvec3 shift(-0.26 + 0.52 * share(i, cables), 0.03, 0);
        addRod(site.parts, a + shift, b + shift, 0.016, site.detail.sides(0.016), Ends::Open);
    }
}

constexpr double kRackHalf = kLotPitch / 2;

/// Adds the pipes on one level of a pipe rack. Each pipe has a shoe at each support frame (bent) of the rack.
void addRackLevel(Site& site, double level, std::uint64_t bents) {
    const std::uint64_t pipes = site.detail.amount(7, 4, 26);
    for (std::uint64_t i = 0; i < pipes; ++i) {
        const double x = -4.0 + 7.0 * (share(i, pipes) + 0.5 / static_cast<double>(pipes));
        const double r = std::min(3.0 / static_cast<double>(pipes), site.random.uniform(0.05, 0.26));
        const double y = level + r;
        if (site.random.below(4) == 0) { // on average, one of four pipes goes down here
            const double z = site.random.uniform(-12, 12);
            const std::array<dvec3, 5> down{
                dvec3(x, y, -kRackHalf),
                dvec3(x, y, z),
                dvec3(x, y + 1.2, z),
                dvec3(-6.2, y + 1.2, z),
                dvec3(-6.2, 0, z)};
            addPipe(site, down, std::min(r, 0.18));
        } else {
            const std::array<dvec3, 2> straight{dvec3(x, y, -kRackHalf), dvec3(x, y, kRackHalf)};
            addPipe(site, straight, r);
        }
        for (std::uint64_t j = 0; j < bents; ++j) {
            const double z = -kRackHalf + 2 * kRackHalf * (share(j, bents) + 0.5 / static_cast<double>(bents));
            addBox(site.parts, {x - 0.06, y - r - 0.03, z - 0.15}, {x + 0.06, y - r + 0.02, z + 0.15});
        }
    }
}

} // namespace

void addPipeRack(Site& site) {
    constexpr double kHalf = kRackHalf;
    constexpr std::array<double, 3> kLevels{4.2, 6.0, 7.8};
    const std::uint64_t bents = std::min<std::uint64_t>(8, 4 + site.detail.amount(1, 1, 4));
    for (std::uint64_t i = 0; i < bents; ++i) {
        const double z = -kHalf + 2 * kHalf * (share(i, bents) + 0.5 / static_cast<double>(bents));
        for (const double x : {-4.5, 4.5}) {
            addIBeam(site.parts, {x, 0, z}, {x, 9, z}, {1, 0, 0}, 0.32);
            addBox(site.parts, {x - 0.35, 0, z - 0.35}, {x + 0.35, 0.25, z + 0.35});
            if (i % 3 == 0)
                addAngle(site.parts, {x, 0.3, z}, {x, 4, z + 2 * kHalf / static_cast<double>(bents)}, kUp, 0.1);
        }
        for (const double y : kLevels)
            addIBeam(site.parts, {-4.5, y - 0.2, z}, {4.5, y - 0.2, z}, kUp, 0.34);
    }
    for (const double x : {-4.5, 4.5})
        for (const double y : kLevels)
            addIBeam(site.parts, {x, y - 0.1, -kHalf}, {x, y - 0.1, kHalf}, kUp, 0.24);
    for (const double level : kLevels)
        addRackLevel(site, level, bents);
    addGrating(site, {3.2, 7.9, -kHalf}, {4.4, 7.9, kHalf});
    addHandrail(site, {4.4, 7.95, -kHalf}, {4.4, 7.95, kHalf});
    for (const double y : {5.0, 6.9})
        addTray(site, {3.7, y, -kHalf}, {3.7, y, kHalf});
    addLadder(site, {4.8, 0, 8}, 8);
}

void addPipeSleepers(Site& site) {
    constexpr double kHalf = 15;
    const std::uint64_t pipes = site.detail.amount(9, 5, 40);
    for (std::uint64_t i = 0; i < 7; ++i) {
        const double z = -kHalf + 5 * static_cast<double>(i);
        addBox(site.parts, {-9, 0, z - 0.2}, {9, 0.3, z + 0.2});
    }
    for (std::uint64_t i = 0; i < pipes; ++i) {
        const double x = -8.5 + 17 * (share(i, pipes) + 0.5 / static_cast<double>(pipes));
        const double r = std::min(5.0 / static_cast<double>(pipes), site.random.uniform(0.05, 0.3));
        const double y = 0.32 + r;
        const double z = site.random.uniform(-8, 4);
        // The pipe has an expansion loop, which rises above the neighbouring pipes.
        const double loop = 2 + 3 * share(i, pipes);
        const std::array<dvec3, 6> path{
            dvec3(x, y, -kHalf),
            dvec3(x, y, z),
            dvec3(x, y + loop, z),
            dvec3(x, y + loop, z + 3),
            dvec3(x, y, z + 3),
            dvec3(x, y, kHalf)};
        const std::array<dvec3, 2> straight{dvec3(x, y, -kHalf), dvec3(x, y, kHalf)};
        if (i % 3 == 0)
            addPipe(site, path, std::min(r, 0.2));
        else
            addPipe(site, straight, r);
        if (i % 4 == 1) addValve(site, {x, y, site.random.uniform(-12, 12)}, {0, 0, 1}, r);
    }
    // Adds a foot bridge over the pipes.
    addStairs(site, {-12.4, 0, 11}, {-10, 1.6, 11});
    addStairs(site, {12.4, 0, 11}, {10, 1.6, 11});
    addGrating(site, {-10, 1.6, 10.4}, {10, 1.6, 11.6});
    addHandrail(site, {-10, 1.63, 10.4}, {10, 1.63, 10.4});
    addHandrail(site, {-10, 1.63, 11.6}, {10, 1.63, 11.6});
}

void addExchangers(Site& site) {
    const std::uint64_t rows = 3;
    for (std::uint64_t row = 0; row < rows; ++row) {
        const double z = -10 + 9 * static_cast<double>(row);
        for (const double y : {1.7, 4.1}) {
            const double r = site.random.uniform(0.6, 0.95);
            addVessel(site, {-9, y, z}, {-1, y, z}, r);
            for (const double x : {-7.5, -2.5})
                addBox(site.parts, {x - 0.2, y > 2 ? 3.0 : 0.0, z - 0.7}, {x + 0.2, y - 0.8 * r, z + 0.7});
            addFlange(site, {-8.6, y, z}, {1, 0, 0}, r);
            const std::array<dvec3, 5> feed{
                dvec3(-2, y + r, z),
                dvec3(-2, y + r + 0.9, z),
                dvec3(2, y + r + 0.9, z),
                dvec3(2, y + r + 0.9, z + 3),
                dvec3(2, 0.4, z + 3)};
            addPipe(site, feed, 0.14);
        }
        for (const double x : {-10.2, 0.2}) {
            addIBeam(site.parts, {x, 0, z - 1.2}, {x, 6, z - 1.2}, {1, 0, 0}, 0.25);
            addIBeam(site.parts, {x, 0, z + 1.2}, {x, 6, z + 1.2}, {1, 0, 0}, 0.25);
            addIBeam(site.parts, {x, 2.9, z - 1.2}, {x, 2.9, z + 1.2}, kUp, 0.22);
        }
        addGrating(site, {-10, 3.0, z + 1.2}, {0, 3.0, z + 2.4});
        addHandrail(site, {-10, 3.03, z + 2.4}, {0, 3.03, z + 2.4});
        addLadder(site, {-10.4, 0, z + 1.8}, 3);
        const std::uint64_t pumps = std::min<std::uint64_t>(6, 2 + site.detail.amount(1, 1, 4));
        for (std::uint64_t i = 0; i < pumps; ++i) {
            const double x = 5 + 9 * share(i, pumps);
            addPump(site, {x, 0, z}, 0.45);
            const std::array<dvec3, 4> suction{
                dvec3(x + 0.6, 0.45, z + 0.3),
                dvec3(x + 0.6, 0.45, z + 2.2),
                dvec3(x + 0.6, 2.4, z + 2.2),
                dvec3(x + 0.6, 2.4, z + 4.6)};
            addPipe(site, suction, 0.09);
            addValve(site, {x + 0.6, 0.45, z + 1.2}, {0, 0, 1}, 0.09);
        }
    }
}

namespace {

void addInsulator(Site& site, const dvec3& foot, const dvec3& axis, double length, double radius) {
    std::vector<Station> profile;
    const std::uint64_t discs = site.detail.amount(5, 3, 24);
    for (std::uint64_t i = 0; i < discs; ++i) {
        profile.push_back({length * share(i, discs), 0.5 * radius});
        profile.push_back({length * (share(i, discs) + 0.3 / static_cast<double>(discs)), radius});
        profile.push_back({length * (share(i, discs) + 0.5 / static_cast<double>(discs)), 0.5 * radius});
    }
    profile.push_back({length, 0.4 * radius});
    addLathe(site.parts, foot, axis, profile, std::max<std::uint64_t>(6, site.detail.sides(radius)));
}

void addTransformer(Site& site, const dvec3& foot) {
    addUnweldedBox(site.parts, foot + dvec3(-2.2, 0.4, -1.3), foot + dvec3(2.2, 3.6, 1.3));
    for (const double side : {-1.0, 1.0}) {
        const std::uint64_t fins = site.detail.amount(14, 6, 120);
        for (std::uint64_t i = 0; i < fins; ++i) {
            const double x = -2.0 + 4.0 * share(i, fins);
            addRidgedSheet(
                site,
                foot + dvec3(x, 0.7, side * 1.3),
                {0, 0, side * 0.9},
                kUp * 2.4,
                i % 5 == 0 ? Sides::Both : Sides::One);
        }
        addRod(
            site.parts,
            foot + dvec3(-2.1, 3.2, side * 1.9),
            foot + dvec3(2.1, 3.2, side * 1.9),
            0.07,
            site.detail.sides(0.07),
            Ends::Closed);
    }
    addVessel(site, foot + dvec3(-1.6, 4.4, 0.9), foot + dvec3(1.4, 4.4, 0.9), 0.42);
    addRod(site.parts, foot + dvec3(0, 3.5, 0.9), foot + dvec3(0, 4.1, 0.9), 0.06, site.detail.sides(0.06), Ends::Open);
    for (const double x : {-1.4, 0.0, 1.4}) {
        const dvec3 lean = glm::normalize(dvec3(0.15 * x, 1, -0.25));
        addInsulator(site, foot + dvec3(x, 3.6, -0.6), lean, 2.2, 0.2);
        addRod(
            site.parts,
            foot + dvec3(x, 3.6, -0.6) + lean * 2.2,
            dvec3(foot.x + x, 9, foot.z - 4),
            0.015,
            3,
            Ends::Open);
    }
    addBox(site.parts, foot + dvec3(-3.4, 0, -2.6), foot + dvec3(3.4, 0.4, 2.6));
}

void addLatticeColumn(Site& site, const dvec3& foot, double height) {
    constexpr double kWidth = 0.8;
    const std::array<dvec3, 4> corners{
        dvec3(0, 0, 0), dvec3(kWidth, 0, 0), dvec3(kWidth, 0, kWidth), dvec3(0, 0, kWidth)};
    for (const dvec3& corner : corners)
        addAngle(site.parts, foot + corner, foot + corner + kUp * height, {1, 0, 0}, 0.1);
    const std::uint64_t bays = site.detail.amount(7, 5, 24);
    for (std::uint64_t i = 0; i < bays; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            const dvec3 a = foot + corners.at(j) + kUp * (height * share(i, bays));
            const dvec3 b = foot + corners.at((j + 1) % 4) + kUp * (height * share(i + 1, bays));
            addAngle(site.parts, i % 2 == 0 ? a : b, i % 2 == 0 ? b : a, kUp, 0.06);
        }
}

} // namespace

void addTransformers(Site& site) {
    for (const double x : {-9.5, 0.0, 9.5})
        addTransformer(site, {x, 0, 4});
    for (const double x : {-4.8, 4.8})
        addBox(site.parts, {x - 0.15, 0, 0}, {x + 0.15, 5, 9}); // fire walls
    for (const double x : {-13.0, -0.4, 12.2})
        addLatticeColumn(site, {x, 0, -5}, 11);
    addIBeam(site.parts, {-13, 11, -4.6}, {13, 11, -4.6}, kUp, 0.5);
    const std::uint64_t strings = 9;
    for (std::uint64_t i = 0; i < strings; ++i) {
        const double x = -11.5 + 23 * (share(i, strings) + 0.5 / static_cast<double>(strings));
        addInsulator(site, {x, 10.7, -4.6}, {0, -1, 0}, 1.7, 0.14);
        addRod(site.parts, {x, 9, -4.6}, {x, 9, -15}, 0.012, 3, Ends::Open);
    }
    for (std::uint64_t i = 0; i < 6; ++i) {
        const double x = -12 + 4.8 * static_cast<double>(i);
        addBox(site.parts, {x - 0.2, 0, -10.2}, {x + 0.2, 2.2, -9.8});
        addInsulator(site, {x, 2.2, -10}, kUp, 1.4, 0.16);
    }
    const std::array<dvec3, 4> corners{
        dvec3(-14.8, 0, -14.8), dvec3(14.8, 0, -14.8), dvec3(14.8, 0, 14.8), dvec3(-14.8, 0, 14.8)};
    for (std::size_t i = 0; i < 4; ++i)
        addFence(site, corners.at(i), corners.at((i + 1) % 4));
}

} // namespace gnomon::make
