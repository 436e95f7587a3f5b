#include "preprocess/make/plant_kit.h"

#include "preprocess/make/noise.h"

#include <algorithm>
#include <cmath>

namespace gnomon::make {

using glm::dvec3;

namespace {

constexpr double kPipeLength = 2;

std::uint64_t pieces(double length, double spacing) {
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(length / spacing)));
}

} // namespace

Detail::Detail(double level) : level_(level), growth_(std::sqrt(level * std::sqrt(level))) {}

std::uint64_t Detail::amount(double base, std::uint64_t minAmount, std::uint64_t maxAmount) const {
    return std::clamp(static_cast<std::uint64_t>(std::llround(base * growth_)), minAmount, maxAmount);
}

std::uint64_t Detail::sides(double radius) const {
    const double wanted = 4 + 14 * std::sqrt(radius * std::sqrt(level_));
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(wanted), 3, 256);
}

std::uint64_t Detail::bend() const {
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(2 + std::sqrt(level_)), 1, 24);
}

void addGrating(Site& site, const dvec3& min, const dvec3& max) {
    const double width = max.x - min.x;
    const double length = max.z - min.z;
    // A grating consists of panels of 1 m by about 3 m. Each panel has its own bars, like a real grating.
    const std::uint64_t across = pieces(width, 3.0);
    const std::uint64_t along = pieces(length, 1.0);
    const std::uint64_t bars = site.detail.amount(1.6, 1, 34);
    // The number of vertices along a bar depends on the cross bars that are welded to the bar.
    const std::uint64_t cuts = site.detail.amount(3, 1, 30);
    const std::uint64_t crossBars = site.detail.amount(1.2, 1, 30);
    const double height = 0.03;
    for (std::uint64_t i = 0; i < across; ++i)
        for (std::uint64_t j = 0; j < along; ++j) {
            const double x = min.x + width * share(i, across);
            const double z = min.z + length * share(j, along);
            const double w = width / static_cast<double>(across) - 0.01;
            const double l = length / static_cast<double>(along);
            for (std::uint64_t bar = 0; bar < bars; ++bar) {
                const double at = z + l * (share(bar, bars) + 0.5 / static_cast<double>(bars));
                std::vector<dvec3> path;
                for (std::uint64_t cut = 0; cut <= cuts; ++cut)
                    path.emplace_back(x + w * share(cut, cuts), min.y + height, at);
                addTube(site.parts, path, 0.012, 4, Ends::Open);
            }
            for (std::uint64_t bar = 0; bar < crossBars; ++bar) {
                const double at = x + w * share(bar, crossBars);
                addSheet(
                    site.parts,
                    {at, min.y + 2 * height, z},
                    {0.012, 0, 0},
                    {0, 0, l - 0.01},
                    bar == 0 ? Sides::Both : Sides::One);
            }
        }
}

void addHandrail(Site& site, const dvec3& a, const dvec3& b) {
    const std::uint64_t posts = pieces(glm::distance(a, b), 1.5);
    const std::uint64_t sides = site.detail.sides(0.03);
    for (std::uint64_t i = 0; i <= posts; ++i) {
        const dvec3 foot = a + (b - a) * share(i, posts);
        addRod(site.parts, foot, foot + kUp * 1.08, 0.022, sides, Ends::Open);
    }
    for (const double height : {0.55, 1.1})
        addRod(site.parts, a + kUp * height, b + kUp * height, 0.024, sides, Ends::Open);
    addSheet(site.parts, a + kUp * 0.01, b - a, kUp * 0.12, Sides::Both); // the toe board
}

void addHandrails(Site& site, const dvec3& min, const dvec3& max) {
    const std::array<dvec3, 4> corners{
        min, dvec3(max.x, min.y, min.z), dvec3(max.x, min.y, max.z), dvec3(min.x, min.y, max.z)};
    for (std::size_t i = 0; i < 4; ++i)
        addHandrail(site, corners.at(i), corners.at((i + 1) % 4));
}

void addLadder(Site& site, const dvec3& foot, double height) {
    const std::uint64_t sides = site.detail.sides(0.02);
    for (const double x : {-0.22, 0.22})
        addRod(site.parts, foot + dvec3(x, 0, 0), foot + dvec3(x, height + 1, 0), 0.025, sides, Ends::Open);
    const std::uint64_t rungs = pieces(height, 0.3);
    for (std::uint64_t i = 0; i < rungs; ++i) {
        const dvec3 at = foot + kUp * (height * share(i + 1, rungs));
        addRod(site.parts, at - dvec3(0.22, 0, 0), at + dvec3(0.22, 0, 0), 0.014, sides, Ends::Open);
    }
    if (height < 4) return;
    const std::uint64_t hoops = pieces(height - 3, 1.0);
    for (std::uint64_t i = 0; i <= hoops; ++i)
        addRing(
            site.parts,
            foot + dvec3(0, 3 + (height - 3) * share(i, hoops), 0.36),
            kUp,
            0.4,
            0.015,
            2 * site.detail.sides(0.3));
    for (const double x : {-0.3, 0.0, 0.3})
        addSheet(
            site.parts, foot + dvec3(x - 0.02, 3, 0.36 + std::sqrt(0.16 - x * x)), {0.04, 0, 0}, kUp * (height - 3));
}

void addStairs(Site& site, const dvec3& foot, const dvec3& head) {
    const double rise = head.y - foot.y;
    const std::uint64_t steps = pieces(rise, 0.19);
    const dvec3 along = glm::normalize(dvec3(head.x - foot.x, 0, head.z - foot.z));
    const dvec3 across = glm::cross(along, kUp) * 0.45;
    for (std::uint64_t i = 1; i < steps; ++i) {
        const dvec3 at = foot + (head - foot) * share(i, steps);
        addSheet(site.parts, at - across - along * 0.13, along * 0.26, across * 2.0, Sides::Both);
        addRod(site.parts, at - across - kUp * 0.02, at + across - kUp * 0.02, 0.02, 4, Ends::Closed);
    }
    for (const double side : {-1.0, 1.0}) {
        const dvec3 shift = across * side - kUp * 0.12;
        addIBeam(site.parts, foot + shift, head + shift, kUp, 0.2);
        addHandrail(site, foot + across * side, head + across * side);
    }
}

void addFlange(Site& site, const dvec3& center, const dvec3& axis, double radius) {
    const double thick = 0.15 * radius + 0.01;
    const std::array<Station, 4> disc{
        {{-thick, radius}, {-thick, radius * 1.6}, {thick, radius * 1.6}, {thick, radius}}};
    const std::uint64_t sides = std::max<std::uint64_t>(5, site.detail.sides(radius));
    addLathe(site.parts, center, axis, disc, sides);
    const std::uint64_t bolts = site.detail.amount(2.5, 0, 24);
    const dvec3 u = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? kUp : dvec3(1, 0, 0)));
    const dvec3 v = glm::cross(axis, u);
    for (std::uint64_t i = 0; i < bolts; ++i) {
        const dvec3 at = center + 1.35 * radius * (u * cosTurns(share(i, bolts)) + v * sinTurns(share(i, bolts)));
        addRod(
            site.parts, at - axis * (thick + 0.02), at + axis * (thick + 0.02), 0.1 * radius + 0.004, 6, Ends::Closed);
    }
}

void addPipe(Site& site, std::span<const dvec3> corners, double radius) {
    std::vector<dvec3> path;
    for (const dvec3& next : roundedPath(corners, 2.5 * radius, site.detail.bend())) {
        // A long pipe consists of welded pieces. A ring of vertices represents each weld.
        const dvec3 last = path.empty() ? next : path.back();
        const std::uint64_t lengths = pieces(glm::distance(last, next), kPipeLength);
        for (std::uint64_t i = 1; i < lengths; ++i)
            path.push_back(last + (next - last) * share(i, lengths));
        path.push_back(next);
    }
    addTube(site.parts, path, radius, std::max<std::uint64_t>(5, site.detail.sides(radius)), Ends::Open);
    addFlange(site, corners.front(), glm::normalize(corners[1] - corners[0]), radius);
    addFlange(site, corners.back(), glm::normalize(corners.back() - corners[corners.size() - 2]), radius);
}

void addValve(Site& site, const dvec3& center, const dvec3& axis, double radius) {
    const double r = radius;
    const std::array<Station, 6> body{
        {{-2.2 * r, 1.05 * r},
         {-1.5 * r, 1.1 * r},
         {-0.7 * r, 1.8 * r},
         {0.7 * r, 1.8 * r},
         {1.5 * r, 1.1 * r},
         {2.2 * r, 1.05 * r}}};
    addLathe(site.parts, center, axis, body, std::max<std::uint64_t>(6, site.detail.sides(r)));
    for (const double side : {-2.2, 2.2})
        addFlange(site, center + axis * (side * r), axis, r);
    addRod(site.parts, center + kUp * r, center + kUp * (5 * r), 0.25 * r, site.detail.sides(0.2 * r), Ends::Open);
    const std::array<Station, 4> bonnet{
        {{1.4 * r, 1.2 * r}, {2.6 * r, 0.9 * r}, {2.7 * r, 0.5 * r}, {3.2 * r, 0.4 * r}}};
    addLathe(site.parts, center, kUp, bonnet, std::max<std::uint64_t>(5, site.detail.sides(r)));
    addRing(site.parts, center + kUp * (5 * r), kUp, 1.8 * r, 0.15 * r, 3 + 2 * site.detail.sides(r));
    for (const double turn : {0.0, 0.25}) {
        const dvec3 spoke = dvec3(cosTurns(turn), 0, sinTurns(turn)) * (1.8 * r);
        addRod(site.parts, center + kUp * (5 * r) - spoke, center + kUp * (5 * r) + spoke, 0.1 * r, 3, Ends::Open);
    }
}

void addPump(Site& site, const dvec3& foot, double size) {
    const double s = size;
    addBox(site.parts, foot + dvec3(-1.6 * s, 0, -0.6 * s), foot + dvec3(1.6 * s, 0.35 * s, 0.6 * s));
    const dvec3 axis(1, 0, 0);
    const dvec3 center = foot + kUp * (0.95 * s);
    const std::uint64_t sides = std::max<std::uint64_t>(6, site.detail.sides(0.5 * s));
    const std::array<Station, 6> motor{
        {{-1.4 * s, 0},
         {-1.4 * s, 0.35 * s},
         {-1.3 * s, 0.45 * s},
         {-0.3 * s, 0.45 * s},
         {-0.2 * s, 0.3 * s},
         {-0.2 * s, 0}}};
    addLathe(site.parts, center, axis, motor, sides);
    const std::uint64_t fins = site.detail.amount(5, 3, 40);
    for (std::uint64_t i = 0; i < fins; ++i) {
        const double t = share(i, fins);
        const dvec3 out(0, cosTurns(t), sinTurns(t));
        addRidgedSheet(site, center + axis * (-1.25 * s) + out * (0.44 * s), axis * (0.9 * s), out * (0.07 * s));
    }
    const std::array<Station, 7> pump{
        {{0, 0},
         {0, 0.2 * s},
         {0.3 * s, 0.25 * s},
         {0.5 * s, 0.6 * s},
         {1.0 * s, 0.6 * s},
         {1.2 * s, 0.25 * s},
         {1.4 * s, 0.25 * s}}};
    addLathe(site.parts, center, axis, pump, sides);
    addRod(site.parts, center - axis * (0.2 * s), center, 0.08 * s, sides, Ends::Open); // the shaft
    addBox(site.parts, foot + dvec3(-1.2 * s, 0.35 * s, -0.3 * s), foot + dvec3(-0.4 * s, 0.55 * s, 0.3 * s));
    addFlange(site, center + axis * (1.4 * s), axis, 0.25 * s);
}

void addVessel(Site& site, const dvec3& a, const dvec3& b, double radius) {
    const double length = glm::distance(a, b);
    const dvec3 axis = (b - a) / length;
    std::vector<Station> profile;
    const std::uint64_t steps = site.detail.bend() + 1;
    for (std::uint64_t i = 0; i <= steps; ++i) {
        const double t = 0.25 * share(i, steps);
        profile.push_back({-0.5 * radius * cosTurns(t), i == 0 ? 0 : radius * sinTurns(t)});
    }
    const std::size_t half = profile.size();
    for (std::size_t i = half; i-- > 0;)
        profile.push_back({length - profile[i].along, profile[i].radius});
    addLathe(site.parts, a, axis, profile, std::max<std::uint64_t>(8, site.detail.sides(radius)));
}

void addRidgedSheet(Site& site, const dvec3& corner, const dvec3& u, const dvec3& v, Sides sides) {
    Panel panel;
    panel.corner = corner;
    panel.u = u;
    panel.v = v;
    panel.cellsU = 2 * site.detail.amount(2, 1, 16);
    panel.cellsV = site.detail.amount(3, 1, 16);
    panel.waveDepth = 0.012;
    panel.sides = sides;
    addPanel(site.parts, panel);
}

void addFence(Site& site, const dvec3& a, const dvec3& b) {
    constexpr double kHeight = 2.2;
    const double length = glm::distance(a, b);
    const std::uint64_t posts = pieces(length, 5.0);
    for (std::uint64_t i = 0; i <= posts; ++i) {
        const dvec3 foot = a + (b - a) * share(i, posts);
        addRod(site.parts, foot, foot + kUp * (kHeight + 0.2), 0.035, site.detail.sides(0.04), Ends::Open);
    }
    for (std::uint64_t i = 0; i < 3; ++i) {
        const dvec3 lift = kUp * (0.1 + kHeight * 0.5 * static_cast<double>(i));
        addRod(site.parts, a + lift, b + lift, 0.006, 3, Ends::Open);
    }
    const std::uint64_t bars = posts * site.detail.amount(1.5, 1, 100);
    const dvec3 step = (b - a) / static_cast<double>(bars);
    const dvec3 thick = glm::normalize(step) * 0.01;
    const double lean = std::min(0.45 * length, kHeight);
    for (std::uint64_t i = 0; i < bars; ++i) {
        const dvec3 foot = a + step * static_cast<double>(i);
        const double direction = (i % 2 == 0) == (glm::dot(foot - a, b - a) < glm::dot(b - foot, b - a)) ? 1 : -1;
        const bool inside = direction > 0 ? glm::distance(foot, b) > lean : glm::distance(foot, a) > lean;
        const dvec3 top = kUp * kHeight + glm::normalize(step) * (inside ? direction * lean : 0.0);
        addSheet(site.parts, foot + kUp * 0.05, thick, top);
    }
}

void addCladding(Site& site, const dvec3& corner, const dvec3& u, const dvec3& v, double sheetWidth) {
    const double width = glm::length(u);
    const std::uint64_t sheets = pieces(width, sheetWidth);
    const std::uint64_t courses = pieces(glm::length(v), 6.0);
    const std::uint64_t waves = site.detail.amount(2, 1, 24);
    for (std::uint64_t i = 0; i < sheets; ++i)
        for (std::uint64_t j = 0; j < courses; ++j) {
            Panel panel;
            panel.corner = corner + u * share(i, sheets) + v * share(j, courses);
            panel.u = u / static_cast<double>(sheets);
            panel.v = v / static_cast<double>(courses);
            panel.cellsU = 2 * waves;
            panel.cellsV = 1 + (i + j) % 2; // makes the vertices of neighbouring sheets different
            panel.waveDepth = 0.04;
            panel.sides = i % 4 == 0 ? Sides::Both : Sides::One;
            addPanel(site.parts, panel);
        }
}

void addLamp(Site& site, const dvec3& foot) {
    const std::array<Station, 3> pole{{{0, 0.12}, {0.6, 0.08}, {7.5, 0.05}}};
    const std::uint64_t sides = std::max<std::uint64_t>(6, site.detail.sides(0.1));
    addLathe(site.parts, foot, kUp, pole, sides);
    const std::array<dvec3, 3> arm{foot + kUp * 7.4, foot + kUp * 8.0, foot + dvec3(1.6, 8.0, 0)};
    addTube(site.parts, roundedPath(arm, 0.5, site.detail.bend()), 0.04, sides, Ends::Open);
    addBox(site.parts, foot + dvec3(1.3, 7.86, -0.14), foot + dvec3(2.1, 7.98, 0.14));
    addSheet(site.parts, foot + dvec3(1.35, 7.855, -0.1), {0.7, 0, 0}, {0, 0, 0.2}, Sides::Both);
    addFlange(site, foot + kUp * 0.02, kUp, 0.12);
}

} // namespace gnomon::make
