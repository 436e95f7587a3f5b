#include "preprocess/make/noise.h"
#include "preprocess/make/plant_units.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

using glm::dvec3;

namespace {

void addWindow(Site& site, const dvec3& corner, double width, double height) {
    addBox(site.parts, corner, corner + dvec3(width, 0.08, 0.12));
    addBox(site.parts, corner + kUp * (height - 0.08), corner + dvec3(width, height, 0.12));
    const std::uint64_t panes = site.detail.amount(3, 2, 10);
    for (std::uint64_t i = 0; i <= panes; ++i) {
        const dvec3 at = corner + dvec3((width - 0.06) * share(i, panes), 0.08, 0);
        addBox(site.parts, at, at + dvec3(0.06, height - 0.16, 0.12));
    }
    addSheet(site.parts, corner + dvec3(0, 0.05, 0.06), {width, 0, 0}, kUp * (height - 0.1), Sides::Both);
}

} // namespace

void addTurbineHall(Site& site) {
    constexpr double kX = 20; // halls of neighbouring lots join along x
    constexpr double kZ = 14;
    constexpr double kEaves = 16;
    constexpr double kRidge = 19;
    for (std::uint64_t i = 0; i < 6; ++i) {
        const double x = -kX + 8 * static_cast<double>(i);
        for (const double z : {-kZ, kZ})
            addIBeam(site.parts, {x, 0, z}, {x, kEaves, z}, {0, 0, 1}, 0.5);
        const std::uint64_t bays = 8;
        for (std::uint64_t j = 0; j < bays; ++j) {
            const double z0 = -kZ + 2 * kZ * share(j, bays);
            const double z1 = -kZ + 2 * kZ * share(j + 1, bays);
            const double h0 = kEaves + (kRidge - kEaves) * (1 - std::abs(z0) / kZ);
            const double h1 = kEaves + (kRidge - kEaves) * (1 - std::abs(z1) / kZ);
            addAngle(site.parts, {x, h0, z0}, {x, h1, z1}, kUp, 0.15);
            addAngle(site.parts, {x, kEaves - 0.5, z0}, {x, kEaves - 0.5, z1}, kUp, 0.15);
            addAngle(site.parts, {x, kEaves - 0.5, z0}, {x, h1, z1}, kUp, 0.1);
        }
    }
    // Adds the walls of the turbine hall: a plinth, cladding above it, and a band of windows towards the road.
    for (const double z : {-kZ, kZ}) {
        const double out = z > 0 ? 1 : -1;
        addUnweldedBox(site.parts, {-kX, 0, z - 0.2}, {kX, 1.2, z + 0.2});
        addCladding(site, {-out * kX, 1.2, z + 0.3 * out}, {out * 2 * kX, 0, 0}, kUp * 8.8, 1.0);
        addCladding(site, {-out * kX, 12.4, z + 0.3 * out}, {out * 2 * kX, 0, 0}, kUp * (kEaves - 12.4), 1.0);
        for (std::uint64_t i = 0; i < 10; ++i)
            addWindow(site, {-kX + 4 * static_cast<double>(i) + 0.1, 10.05, z + 0.1 * out}, 3.8, 2.3);
    }
    const double slope = kRidge - kEaves;
    addCladding(site, {-kX, kEaves, kZ + 0.4}, {2 * kX, 0, 0}, {0, slope, -kZ - 0.4}, 1.0);
    addCladding(site, {kX, kEaves, -kZ - 0.4}, {-2 * kX, 0, 0}, {0, slope, kZ + 0.4}, 1.0);
    for (const double x : {-12.0, 0.0, 12.0}) {
        const std::array<Station, 5> vent{{{0, 0.8}, {1.2, 0.8}, {1.2, 1.3}, {1.6, 1.3}, {2.0, 0}}};
        addLathe(site.parts, {x, kRidge - 0.3, 0}, kUp, vent, site.detail.sides(1));
    }
    // Adds the turbine set with its foundation, and the crane, inside the hall.
    addBox(site.parts, {-14, 0, -4}, {14, 6, 4});
    const std::array<Station, 9> turbine{
        {{-12, 0}, {-12, 0.8}, {-9, 1.0}, {-8, 2.0}, {-3, 2.4}, {-1, 1.2}, {0, 2.2}, {9, 2.2}, {9.5, 0}}};
    addLathe(site.parts, {0, 8, 0}, {1, 0, 0}, turbine, std::max<std::uint64_t>(12, site.detail.sides(2.4)));
    addGrating(site, {-18, 6, 4.2}, {18, 6, 9});
    addHandrail(site, {-18, 6.03, 9}, {18, 6.03, 9});
    addStairs(site, {-10, 0, 12.5}, {-1, 6, 12.5});
    for (const double z : {-kZ + 1, kZ - 1})
        addIBeam(site.parts, {-kX, 13, z}, {kX, 13, z}, kUp, 0.6);
    addIBeam(site.parts, {3, 13.6, -kZ + 1}, {3, 13.6, kZ - 1}, kUp, 1.0);
    for (const double x : {-16.0, 16.0}) // rain pipes
        addRod(site.parts, {x, 0.2, kZ + 0.5}, {x, kEaves, kZ + 0.5}, 0.09, site.detail.sides(0.09), Ends::Open);
}

namespace {

/// Adds the steam drum on its saddles to the top floor of the boiler house, and a roof above it.
void addBoilerTop(Site& site, double half, double floor) {
    addVessel(site, {-8, floor + 3, 0}, {8, floor + 3, 0}, 1.1);
    for (const double x : {-6.0, 6.0})
        addBox(site.parts, {x - 0.3, floor, -0.9}, {x + 0.3, floor + 2.3, 0.9});
    for (const double x : {-half, half})
        for (const double z : {-half, half}) {
            const double top = floor + 6.5 - 0.5 * z / half; // the roof slopes down towards +z
            addIBeam(site.parts, {x, floor, z}, {x, top, z}, {1, 0, 0}, 0.4);
            if (z > 0) addIBeam(site.parts, {x, floor + 6, z}, {x, floor + 7, -z}, kUp, 0.4);
        }
    addCladding(site, {-half, floor + 6.2, half}, {2 * half, 0, 0}, {0, 1, -2 * half}, 1.2);
}

/// Adds one storey of the boiler's furnace. Its walls consist of adjacent tubes, held by beams.
void addFurnace(Site& site, double bottom, double ceiling) {
    const std::uint64_t tubes = site.detail.amount(16, 8, 120);
    const double radius = 5.5 / static_cast<double>(tubes);
    for (std::uint64_t i = 0; i < tubes; ++i) {
        const double t = -5.5 + 11 * (share(i, tubes) + 0.5 / static_cast<double>(tubes));
        const std::uint64_t sides = site.detail.sides(0.5 * radius) + 1;
        for (const double wall : {-5.8, 5.8}) {
            addRod(site.parts, {t, bottom, wall}, {t, ceiling, wall}, radius * 0.92, sides, Ends::Open);
            addRod(site.parts, {wall, bottom, t}, {wall, ceiling, t}, radius * 0.92, sides, Ends::Open);
        }
    }
    for (const double y : {bottom + 1, bottom + 3})
        for (const double wall : {-6.2, 6.2}) {
            addIBeam(site.parts, {-6.4, y, wall}, {6.4, y, wall}, kUp, 0.4);
            addIBeam(site.parts, {wall, y, -6.4}, {wall, y, 6.4}, kUp, 0.4);
        }
}

} // namespace

void addBoilerStorey(Site& site, std::uint64_t storey) {
    constexpr double kHalf = 14;
    constexpr double kHeight = 6;
    const double floor = kHeight * static_cast<double>(storey);
    constexpr std::array<double, 4> kLines{-14, -6, 6, 14};
    for (const double x : kLines)
        for (const double z : kLines) {
            if (std::abs(x) < 7 && std::abs(z) < 7) continue; // skips the place of the furnace
            addIBeam(site.parts, {x, floor, z}, {x, floor + kHeight, z}, {1, 0, 0}, 0.6);
        }
    const double ceiling = floor + kHeight;
    for (const double line : {-14.0, -7.0, 7.0, 14.0}) {
        addIBeam(site.parts, {-kHalf, ceiling - 0.3, line}, {kHalf, ceiling - 0.3, line}, kUp, 0.5);
        addIBeam(site.parts, {line, ceiling - 0.3, -kHalf}, {line, ceiling - 0.3, kHalf}, kUp, 0.5);
    }
    for (const double z : {-14.0, 14.0})
        addAngle(site.parts, {-14, floor, z}, {-6, ceiling, z}, kUp, 0.2);
    // The gratings form a ring of floor around the furnace.
    addGrating(site, {-kHalf, ceiling, -kHalf}, {kHalf, ceiling, -7});
    addGrating(site, {-kHalf, ceiling, 7}, {9, ceiling, kHalf});
    addGrating(site, {-kHalf, ceiling, -7}, {-7, ceiling, 7});
    addGrating(site, {7, ceiling, -7}, {kHalf, ceiling, 7});
    addHandrails(site, {-kHalf, ceiling + 0.03, -kHalf}, {kHalf, ceiling + 0.03, kHalf});
    const bool even = storey % 2 == 0;
    addStairs(site, {even ? 13.2 : 9.0, floor, even ? 8.0 : 13.0}, {even ? 13.2 : 9.0, ceiling, even ? 13.0 : 8.0});
    addLadder(site, {-13, floor, -12.5}, kHeight);
    if (storey > 0) addFurnace(site, storey == 1 ? floor + 2 : floor, ceiling);
    const std::uint64_t pipes = site.detail.amount(5, 3, 24);
    for (std::uint64_t i = 0; i < pipes; ++i) {
        const double x = -12 + 18 * share(i, pipes);
        const double y = floor + site.random.uniform(3, 5);
        const std::array<dvec3, 4> path{
            dvec3(x, floor, -9), dvec3(x, y, -9), dvec3(x, y, -13), dvec3(x, floor + 0.2, -13)};
        addPipe(site, path, site.random.uniform(0.06, 0.2));
        addValve(site, {x, floor + 1.2, -9}, kUp, 0.1);
    }
    if (storey + 1 == kBoilerStoreys) addBoilerTop(site, kHalf, ceiling);
}

void addChimney(Site& site) {
    const std::uint64_t sides = std::max<std::uint64_t>(16, site.detail.sides(4));
    const std::uint64_t rings = site.detail.amount(12, 6, 120);
    std::vector<Station> shell;
    for (std::uint64_t i = 0; i <= rings; ++i)
        shell.push_back({110 * share(i, rings), 4.6 - 1.9 * share(i, rings)});
    addLathe(site.parts, {0, 0, 0}, kUp, shell, sides);
    const std::array<Station, 3> flue{{{96, 1.9}, {112, 1.9}, {113, 1.8}}};
    addLathe(site.parts, {0, 0, 0}, kUp, flue, sides);
    for (const double y : {36.0, 72.0, 106.0}) {
        const double r = 4.6 - 1.9 * y / 110;
        const std::array<Station, 4> deck{{{y, r}, {y, r + 1.3}, {y + 0.1, r + 1.3}, {y + 0.1, r}}};
        addLathe(site.parts, {0, 0, 0}, kUp, deck, sides);
        for (const double lift : {0.6, 1.1})
            addRing(site.parts, {0, y + lift, 0}, kUp, r + 1.25, 0.03, 2 * sides);
        const std::uint64_t posts = 18;
        for (std::uint64_t i = 0; i < posts; ++i) {
            const dvec3 out = dvec3(cosTurns(share(i, posts)), 0, sinTurns(share(i, posts))) * (r + 1.25);
            addRod(site.parts, out + kUp * y, out + kUp * (y + 1.1), 0.025, 4, Ends::Open);
        }
    }
    addLadder(site, {0, 0, 4.9}, 36);
    // Adds the duct from the boiler, with its stiffeners.
    addUnweldedBox(site.parts, {-20, 6, -2}, {-3.8, 10, 2});
    for (std::uint64_t i = 0; i < 8; ++i) {
        const double x = -19.5 + 2 * static_cast<double>(i);
        addBox(site.parts, {x, 5.8, -2.2}, {x + 0.15, 10.2, 2.2});
        if (i % 3 == 0)
            for (const double z : {-1.8, 1.8})
                addIBeam(site.parts, {x, 0, z}, {x, 5.8, z}, {1, 0, 0}, 0.35);
    }
    for (const double z : {-10.0, 10.0}) { // filters
        addUnweldedBox(site.parts, {5, 4, z - 3}, {13, 12, z + 3});
        for (const double x : {6.0, 9.0, 12.0})
            addLathe(
                site.parts,
                {x, 4, z},
                {0, -1, 0},
                std::array<Station, 2>{{{0, 1.4}, {2.6, 0.2}}},
                site.detail.sides(1.4));
        for (const double x : {5.2, 12.8})
            for (const double side : {-2.8, 2.8})
                addIBeam(site.parts, {x, 0, z + side}, {x, 4, z + side}, {1, 0, 0}, 0.3);
        addStairs(site, {13.5, 0, z - 2.5}, {13.5, 4, z + 2.5});
        addHandrails(site, {5, 12, z - 3}, {13, 12, z + 3});
    }
}

void addCoolingTower(Site& site) {
    constexpr double kHeight = 46;
    const std::uint64_t sides = std::max<std::uint64_t>(24, site.detail.sides(14));
    const std::uint64_t rings = site.detail.amount(14, 8, 200);
    std::vector<Station> shell;
    const auto radiusAt = [](double y) {
        const double t = (y - 34) / 21; // the throat of the cooling tower is at 34 m
        return 8.6 * std::sqrt(1 + t * t * 0.62);
    };
    for (std::uint64_t i = 0; i <= rings; ++i) {
        const double y = 4 + (kHeight - 4) * share(i, rings);
        shell.push_back({y, radiusAt(y)});
    }
    addLathe(site.parts, {0, 0, 0}, kUp, shell, sides);
    for (Station& station : shell)
        station.radius -= 0.25;
    std::reverse(shell.begin(), shell.end());
    addLathe(site.parts, {0, 0, 0}, kUp, shell, sides);
    const std::uint64_t legs = 24;
    for (std::uint64_t i = 0; i < legs; ++i) {
        const dvec3 top = dvec3(cosTurns(share(i, legs)), 0, sinTurns(share(i, legs))) * radiusAt(4) + kUp * 4.1;
        for (const double side : {-0.5, 0.5}) {
            const double t = (static_cast<double>(i) + side) / static_cast<double>(legs);
            addRod(
                site.parts,
                dvec3(cosTurns(t), 0, sinTurns(t)) * 14.6,
                top,
                0.3,
                std::max<std::uint64_t>(5, site.detail.sides(0.3)),
                Ends::Open);
        }
    }
    const std::array<Station, 4> basin{{{0, 14.9}, {1.1, 14.9}, {1.1, 14.6}, {0.2, 14.6}}};
    addLathe(site.parts, {0, 0, 0}, kUp, basin, sides);
    const std::uint64_t packs = site.detail.amount(40, 10, 900);
    for (std::uint64_t i = 0; i < packs; ++i) {
        const double x = -10 + 20 * share(i, packs);
        const double z = std::sqrt(121 - x * x);
        addRidgedSheet(site, {x, 4.6, -z}, {0, 0, 2 * z}, kUp * 1.2, i % 6 == 0 ? Sides::Both : Sides::One);
    }
    addLadder(site, {0, 0, 15.1}, 5);
}

void addStore(Site& site) {
    for (std::uint64_t i = 0; i < 4; ++i) {
        const double z = -12 + 3.2 * static_cast<double>(i);
        const double y = i % 3 == 2 ? 2.62 : 0;
        const double x = i % 3 == 2 ? -13 : -13 + site.random.uniform(0, 0.6);
        addBox(site.parts, {x, y, z}, {x + 6.06, y + 0.12, z + 2.44});
        addCladding(site, {x, y + 0.12, z + 2.44}, {6.06, 0, 0}, kUp * 2.4, 3.0);
        addCladding(site, {x + 6.06, y + 0.12, z}, {-6.06, 0, 0}, kUp * 2.4, 3.0);
        addCladding(site, {x + 6.06, y + 0.12, z + 2.44}, {0, 0, -2.44}, kUp * 2.4, 2.44);
        addCladding(site, {x, y + 0.12, z}, {0, 0, 2.44}, kUp * 2.4, 2.44);
        addSheet(site.parts, {x, y + 2.54, z + 2.44}, {6.06, 0, 0}, {0, 0, -2.44}, Sides::Both);
    }
    const std::uint64_t pipes = site.detail.amount(18, 10, 200);
    const auto inRow = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(pipes))) + 2;
    const double radius = 2.4 / static_cast<double>(inRow);
    for (std::uint64_t i = 0; i < pipes; ++i) {
        const std::uint64_t layer = i / inRow; // the drums of a layer are in the gaps of the layer below
        const double shift = static_cast<double>(i % inRow) + 0.5 * static_cast<double>(layer % 2);
        const dvec3 at(-2 + 2 * radius * shift, radius * (1 + 1.75 * static_cast<double>(layer)), -13);
        for (const double wall : {0.98, 0.9}) // outer and inner wall
            addRod(
                site.parts,
                at,
                at + dvec3(0, 0, 11),
                radius * wall,
                std::max<std::uint64_t>(6, site.detail.sides(radius)),
                Ends::Open);
    }
    for (std::uint64_t i = 0; i < 5; ++i) { // cable drums
        const dvec3 at(-11 + 4.4 * static_cast<double>(i), 1.1, 5);
        const std::array<Station, 6> drum{{{-0.6, 0}, {-0.6, 1.1}, {-0.5, 1.1}, {-0.5, 0.7}, {0.5, 0.7}, {0.5, 1.1}}};
        addLathe(site.parts, at, {0, 0, 1}, drum, std::max<std::uint64_t>(12, site.detail.sides(1.1)));
        addLathe(
            site.parts,
            at,
            {0, 0, 1},
            std::array<Station, 3>{{{0.5, 1.1}, {0.6, 1.1}, {0.6, 0}}},
            std::max<std::uint64_t>(12, site.detail.sides(1.1)));
    }
    const std::uint64_t stacks = site.detail.amount(4, 2, 24);
    for (std::uint64_t i = 0; i < stacks; ++i) { // pallets of boards
        const dvec3 at(-12 + 24 * share(i, stacks), 0, 10 + site.random.uniform(-0.4, 0.4));
        for (int board = 0; board < 12; ++board) {
            const dvec3 corner = at + dvec3(0.168 * (board % 6), board < 6 ? 0 : 0.15, 0);
            addBox(site.parts, corner, corner + dvec3(0.13, 0.05, 1.1));
        }
    }
    addLamp(site, {13, 0, 0});
}

void addGasTurbine(Site& site) {
    addUnweldedBox(site.parts, {-12, 0.4, -3}, {2, 5, 3});
    addBox(site.parts, {-12.4, 0, -3.4}, {9, 0.4, 3.4});
    addUnweldedBox(site.parts, {2, 0.4, -2.2}, {8.5, 4, 2.2});
    addUnweldedBox(site.parts, {-13, 7, -4.5}, {-6, 13, 4.5}); // the filter house
    for (const double x : {-12.6, -6.4})
        for (const double z : {-4.2, 4.2})
            addIBeam(site.parts, {x, 0, z}, {x, 7, z}, {1, 0, 0}, 0.35);
    const std::uint64_t louvres = site.detail.amount(16, 8, 160);
    for (std::uint64_t i = 0; i < louvres; ++i)
        for (const double z : {-4.6, 4.6})
            addRidgedSheet(
                site,
                {-12.8, 7.2 + 5.6 * share(i, louvres), z},
                {6.6, 0, 0},
                {0, 0.1, z > 0 ? 0.3 : -0.3},
                i % 4 == 0 ? Sides::Both : Sides::One);
    addUnweldedBox(site.parts, {-10.5, 5, -1.5}, {-7.5, 7, 1.5});
    const std::array<Station, 4> stack{{{5, 1.8}, {22, 1.8}, {22, 1.7}, {18, 1.7}}};
    addLathe(site.parts, {0, 0, 0}, kUp, stack, std::max<std::uint64_t>(12, site.detail.sides(1.8)));
    addLadder(site, {0, 5, 1.95}, 17);
    addHandrails(site, {-12, 5, -3}, {2, 5, 3});
    addStairs(site, {-4, 0, 4.6}, {1.6, 5, 4.6});
    for (std::uint64_t i = 0; i < 6; ++i) { // fin-fan coolers
        const dvec3 at(-12.5 + 5 * static_cast<double>(i), 0, 10);
        addLathe(
            site.parts,
            at,
            kUp,
            std::array<Station, 3>{{{3.2, 2.0}, {3.4, 1.8}, {4.2, 1.8}}},
            std::max<std::uint64_t>(12, site.detail.sides(1.8)));
        for (std::uint64_t blade = 0; blade < 6; ++blade) {
            const double t = share(blade, 6);
            const dvec3 out(cosTurns(t), 0, sinTurns(t));
            addSheet(site.parts, at + kUp * 3.7 + out * 0.2, out * 1.5, dvec3(-out.z, 0.25, out.x) * 0.4, Sides::Both);
        }
        const std::uint64_t tubes = site.detail.amount(10, 6, 80);
        for (std::uint64_t tube = 0; tube < tubes; ++tube) {
            const double x = at.x - 2.2 + 4.4 * share(tube, tubes);
            addRod(site.parts, {x, 2.9, 7.2}, {x, 2.9, 12.8}, 0.03, site.detail.sides(0.03), Ends::Open);
        }
        for (const double z : {7.2, 12.8})
            addIBeam(site.parts, {at.x - 2.3, 0, z}, {at.x - 2.3, 3, z}, {1, 0, 0}, 0.2);
        addPump(site, {at.x, 0, -9}, 0.5);
    }
    const std::array<dvec3, 4> fuel{dvec3(-14, 0.5, -7), dvec3(5, 0.5, -7), dvec3(5, 0.5, -4), dvec3(5, 3, -4)};
    addPipe(site, fuel, 0.12);
}

} // namespace gnomon::make
