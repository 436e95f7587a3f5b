// Solids and sheets one by one: what is counted is what is made, closed ones face outwards, and sizes are as asked for.
#include "core/box.h"
#include "made_mesh.h"
#include "preprocess/make/noise.h"
#include "preprocess/make/parts.h"
#include "preprocess/make/plant_kit.h"
#include "preprocess/make/plant_units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace gnomon::make {
namespace {

using glm::dvec3;

/// Collects what a part makes.
class Collector final : public MeshSink {
public:
    void addVertices(std::span<const glm::vec3> positions) override {
        mesh.vertices.insert(mesh.vertices.end(), positions.begin(), positions.end());
    }

    void addTriangles(std::span<const MadeTriangle> triangles) override {
        mesh.triangles.insert(mesh.triangles.end(), triangles.begin(), triangles.end());
    }

    MadeMesh mesh;
};

using AddPart = std::function<void(PartSink&)>;

/// What `add` makes, after counting it: both must agree, and triangles must have three corners that are there.
MadeMesh made(const AddPart& add) {
    PartSink counter;
    add(counter);
    Collector collector;
    PartSink maker(collector, 0);
    add(maker);
    maker.finish();
    EXPECT_EQ(maker.size(), counter.size());
    EXPECT_EQ(collector.mesh.vertices.size(), counter.size().vertices);
    EXPECT_EQ(collector.mesh.triangles.size(), counter.size().triangles);
    for (const MadeTriangle& t : collector.mesh.triangles) {
        for (const std::uint64_t corner : t)
            EXPECT_LT(corner, collector.mesh.vertices.size());
        EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    return collector.mesh;
}

/// Six times the signed volume of a closed surface.
double volume(const MadeMesh& mesh) {
    double sum = 0;
    for (const MadeTriangle& t : mesh.triangles) {
        const dvec3 a(mesh.vertices[t[0]]);
        sum += glm::dot(a, glm::cross(dvec3(mesh.vertices[t[1]]), dvec3(mesh.vertices[t[2]]))) / 6;
    }
    return sum;
}

double totalArea(const MadeMesh& mesh) {
    double sum = 0;
    for (const MadeTriangle& t : mesh.triangles)
        sum += area(mesh, t);
    return sum;
}

/// Whether every edge has one triangle on each side, in opposite directions.
bool isClosed(const MadeMesh& mesh) {
    const auto uses = edgeUses(mesh);
    return std::all_of(
        uses.begin(), uses.end(), [](const auto& use) { return use.second.upwards == 1 && use.second.downwards == 1; });
}

std::size_t openEdges(const MadeMesh& mesh) {
    const auto uses = edgeUses(mesh);
    return static_cast<std::size_t>(std::count_if(
        uses.begin(), uses.end(), [](const auto& use) { return use.second.upwards + use.second.downwards == 1; }));
}

TEST(Parts, ABoxIsClosedAndHasItsVolume) {
    const MadeMesh box = made([](PartSink& sink) { addBox(sink, {1, 2, 3}, {2, 4, 6}); });
    EXPECT_EQ(box.triangles.size(), 12U);
    EXPECT_TRUE(isClosed(box));
    EXPECT_NEAR(volume(box), 6, 1e-5);
    const MadeMesh unwelded = made([](PartSink& sink) { addUnweldedBox(sink, {1, 2, 3}, {2, 4, 6}); });
    EXPECT_EQ(unwelded.vertices.size(), 24U);
    EXPECT_EQ(componentCount(unwelded), 6U) << "six sheets that share no vertex";
    EXPECT_TRUE(isClosed(welded(unwelded)));
    EXPECT_NEAR(volume(unwelded), 6, 1e-5);
}

TEST(Parts, ASheetFacesItsOwnWayAndBothSidesFaceBoth) {
    const MadeMesh one = made([](PartSink& sink) { addSheet(sink, {0, 0, 0}, {2, 0, 0}, {0, 3, 0}); });
    EXPECT_EQ(one.triangles.size(), 2U);
    EXPECT_NEAR(totalArea(one), 6, 1e-5);
    const auto facing = [](const MadeMesh& mesh, std::size_t t) {
        const MadeTriangle& c = mesh.triangles[t];
        return glm::cross(mesh.vertices[c[1]] - mesh.vertices[c[0]], mesh.vertices[c[2]] - mesh.vertices[c[0]]).z;
    };
    EXPECT_GT(facing(one, 0), 0);
    EXPECT_GT(facing(one, 1), 0);
    const MadeMesh both = made([](PartSink& sink) { addSheet(sink, {0, 0, 0}, {2, 0, 0}, {0, 3, 0}, Sides::Both); });
    EXPECT_EQ(both.triangles.size(), 4U);
    EXPECT_LT(facing(both, 2), 0);
    EXPECT_LT(facing(both, 3), 0);
    EXPECT_EQ(doubledCount(welded(both)), 2U) << "the same triangles, turned over";
}

TEST(Parts, APanelHasItsCellsAndItsWave) {
    for (const Sides sides : {Sides::One, Sides::Both}) {
        Panel panel{{1, 1, 1}, {8, 0, 0}, {0, 0, -4}, 8, 3, 0.25, sides};
        const MadeMesh mesh = made([&](PartSink& sink) { addPanel(sink, panel); });
        const std::size_t count = sides == Sides::Both ? 2 : 1;
        EXPECT_EQ(mesh.triangles.size(), 48 * count);
        EXPECT_EQ(mesh.vertices.size(), 36 * count);
        int ridges = 0;
        for (const glm::vec3& v : mesh.vertices) {
            EXPECT_TRUE(v.y == 1 || v.y == 1.25F) << v.y;
            ridges += v.y == 1.25F ? 1 : 0;
        }
        EXPECT_EQ(ridges, static_cast<int>(16 * count)) << "every second column of nine";
    }
    Panel flat{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, 2, 2};
    EXPECT_NEAR(totalArea(made([&](PartSink& sink) { addPanel(sink, flat); })), 6, 1e-5);
}

TEST(Parts, SteelSectionsAreOpenAndOfTheirLength) {
    const MadeMesh beam = made([](PartSink& sink) { addIBeam(sink, {0, 0, 0}, {0, 0, 5}, {0, 1, 0}, 0.4); });
    EXPECT_EQ(beam.triangles.size(), 24U);
    EXPECT_EQ(openEdges(beam), 24U) << "both ends";
    Box box;
    for (const glm::vec3& v : beam.vertices)
        box.add(dvec3(v));
    EXPECT_NEAR(box.extent().y, 0.4, 1e-6) << "its depth";
    EXPECT_NEAR(box.extent().z, 5, 1e-6);
    EXPECT_NEAR(box.extent().x, 0.28, 1e-6);
    EXPECT_GT(volume(beam), 0) << "faces outwards";
    const MadeMesh angle = made([](PartSink& sink) { addAngle(sink, {0, 0, 0}, {0, 0, 5}, {0, 1, 0}, 0.1); });
    EXPECT_EQ(angle.triangles.size(), 4U);
    EXPECT_NEAR(totalArea(angle), 1, 1e-5);
}

TEST(Parts, ATubeIsARoundAsItsSidesAreMany) {
    const std::vector<dvec3> path{{0, 0, 0}, {0, 0, 2}, {0, 2, 4}};
    for (const std::uint64_t sides : {3U, 8U, 64U}) {
        const MadeMesh open = made([&](PartSink& sink) { addTube(sink, path, 0.1, sides, Ends::Open); });
        EXPECT_EQ(open.triangles.size(), 4 * sides);
        EXPECT_EQ(openEdges(open), 2 * sides);
        const MadeMesh closed = made([&](PartSink& sink) { addTube(sink, path, 0.1, sides, Ends::Closed); });
        EXPECT_TRUE(isClosed(closed));
        EXPECT_GT(volume(closed), 0);
        const MadeMesh rod = made([&](PartSink& sink) {
            addRod(sink, {0, 0, 0}, {0, 3, 0}, 0.5, sides, Ends::Closed);
        });
        const auto n = static_cast<double>(sides);
        EXPECT_NEAR(volume(rod), 3 * n / 2 * 0.25 * std::sin(2 * 3.141592653589793 / n), 1e-4) << "a prism";
        for (const glm::vec3& v : rod.vertices) {
            const double away = std::hypot(v.x, v.z);
            EXPECT_TRUE(std::abs(away - 0.5) < 1e-6 || away < 1e-6);
        }
    }
}

TEST(Parts, RingsAndTurnedBodiesAreClosed) {
    const MadeMesh ring = made([](PartSink& sink) { addRing(sink, {1, 2, 3}, {0, 1, 0}, 2, 0.1, 24); });
    EXPECT_TRUE(isClosed(ring));
    EXPECT_GT(volume(ring), 0);
    for (const glm::vec3& v : ring.vertices)
        EXPECT_NEAR(std::hypot(std::hypot(v.x - 1, v.z - 3) - 2, v.y - 2), 0.1, 1e-5);
    const std::vector<Station> ball{{0, 0}, {0.3, 0.4}, {1, 0.5}, {1.5, 0}};
    const MadeMesh turned = made([&](PartSink& sink) { addLathe(sink, {0, 0, 0}, {0, 1, 0}, ball, 12, 0.03); });
    EXPECT_TRUE(isClosed(turned));
    EXPECT_GT(volume(turned), 0);
    EXPECT_EQ(turned.vertices.size(), 26U) << "two tips and two rings";
    const std::vector<Station> pipe{{0, 0.5}, {1, 0.5}};
    EXPECT_EQ(openEdges(made([&](PartSink& sink) { addLathe(sink, {0, 0, 0}, {1, 0, 0}, pipe, 10); })), 20U);
}

TEST(Parts, ASkinAroundRingsIsClosed) {
    const MadeMesh skin = made([](PartSink& sink) {
        addSkin(sink, 9, 16, [](double along, double around) {
            return dvec3(cosTurns(around), 3 * along, -sinTurns(around)) * dvec3(1 + 0.3 * along, 1, 1);
        });
    });
    EXPECT_EQ(skin.vertices.size(), 9 * 16 + 2U);
    EXPECT_TRUE(isClosed(skin));
    EXPECT_GT(std::abs(volume(skin)), 8);
}

TEST(Parts, ARoundedPathKeepsItsEndsAndItsRadius) {
    const std::vector<dvec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {4, 3, 5}};
    const std::vector<dvec3> path = roundedPath(corners, 0.5, 6);
    EXPECT_EQ(path.size(), 2 + 2 * 7U);
    EXPECT_EQ(path.front(), corners.front());
    EXPECT_EQ(path.back(), corners.back());
    for (std::size_t i = 1; i <= 7; ++i)
        EXPECT_NEAR(glm::distance(path[i], dvec3(3.5, 0.5, 0)), 0.5, 1e-9);
    EXPECT_NEAR(glm::distance(path[1], dvec3(3.5, 0, 0)), 0, 1e-9) << "it leaves the line where the bend begins";
    EXPECT_NEAR(glm::distance(path[7], dvec3(4, 0.5, 0)), 0, 1e-9);
    EXPECT_EQ(roundedPath(std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}}, 0.5, 6).size(), 2U);
}

TEST(Parts, ArePlacedAndTurnedExactly) {
    for (int turns = 0; turns < 8; ++turns) {
        const glm::dmat3 axes = quarterTurned(turns);
        EXPECT_EQ(glm::determinant(axes), 1);
        EXPECT_EQ(axes * dvec3(0, 1, 0), dvec3(0, 1, 0));
        EXPECT_EQ(quarterTurned(1) * axes, quarterTurned(turns + 1));
    }
    EXPECT_EQ(quarterTurned(1) * dvec3(1, 0, 0), dvec3(0, 0, -1));
    const MadeMesh placed = made([](PartSink& sink) {
        sink.place({10, 0, 0}, quarterTurned(1));
        addSheet(sink, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    });
    EXPECT_EQ(placed.vertices[0], glm::vec3(10, 0, 0));
    EXPECT_EQ(placed.vertices[1], glm::vec3(10, 0, -1));
}

TEST(Parts, FollowOneAnotherWhateverIsHeldBack) {
    const AddPart many = [](PartSink& sink) {
        for (int i = 0; i < 700; ++i)
            addBox(sink, {i, 0, 0}, {i + 0.5, 1, 1});
    };
    const MadeMesh mesh = made(many);
    EXPECT_EQ(componentCount(mesh), 700U);
    EXPECT_NEAR(volume(mesh), 350, 0.1);
    Collector later;
    PartSink maker(later, 1000);
    many(maker);
    maker.finish();
    EXPECT_EQ(later.mesh.triangles[0][0], mesh.triangles[0][0] + 1000) << "indices are those of the whole model";
}

/// The box of what `add` adds to a site.
Box boxOf(const Detail& detail, const std::function<void(Site&)>& add) {
    const MadeMesh mesh = made([&](PartSink& sink) {
        Site site{sink, detail, Random(5)};
        add(site);
    });
    Box box;
    for (const glm::vec3& v : mesh.vertices)
        box.add(dvec3(v));
    EXPECT_FALSE(box.isEmpty());
    return box;
}

TEST(PlantKit, EachThingIsMadeAsItIsCountedAtEveryDetail) {
    for (const double level : {0.01, 0.3, 1.0, 7.0}) {
        const Detail detail(level);
        const auto size = [&](const std::function<void(Site&)>& add) { return boxOf(detail, add).extent(); };
        EXPECT_NEAR(size([](Site& s) { addGrating(s, {0, 1, 0}, {4, 1, 3}); }).x, 4, 0.2);
        EXPECT_NEAR(size([](Site& s) { addHandrail(s, {0, 0, 0}, {6, 0, 0}); }).y, 1.1, 0.05);
        EXPECT_NEAR(size([](Site& s) { addHandrails(s, {0, 0, 0}, {6, 0, 4}); }).z, 4, 0.1);
        EXPECT_GT(size([](Site& s) { addLadder(s, {0, 0, 0}, 6); }).y, 5.5);
        EXPECT_GT(size([](Site& s) { addStairs(s, {0, 0, 0}, {4, 3, 0}); }).y, 3);
        EXPECT_GT(
            size([](Site& s) {
                const std::vector<dvec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}};
                addPipe(s, corners, 0.2);
            }).x,
            4);
        EXPECT_GT(size([](Site& s) { addFlange(s, {0, 0, 0}, {1, 0, 0}, 0.3); }).y, 0.6);
        EXPECT_GT(size([](Site& s) { addValve(s, {0, 0, 0}, {1, 0, 0}, 0.3); }).y, 0.6);
        EXPECT_GT(size([](Site& s) { addPump(s, {0, 0, 0}, 1); }).x, 0.5);
        EXPECT_GT(size([](Site& s) { addVessel(s, {0, 0, 0}, {0, 8, 0}, 2); }).y, 8);
        EXPECT_NEAR(size([](Site& s) { addRidgedSheet(s, {0, 0, 0}, {2, 0, 0}, {0, 3, 0}); }).y, 3, 0.01);
        EXPECT_GT(size([](Site& s) { addFence(s, {0, 0, 0}, {10, 0, 0}); }).x, 9.9);
        EXPECT_NEAR(size([](Site& s) { addCladding(s, {0, 0, 0}, {10, 0, 0}, {0, 4, 0}, 1); }).y, 4, 0.1);
        EXPECT_GT(size([](Site& s) { addLamp(s, {0, 0, 0}); }).y, 2);
    }
}

TEST(PlantUnits, StandOnTheirLotsAtEveryDetail) {
    using Unit = void (*)(Site&);
    for (const double level : {0.01, 1.0})
        for (const Unit add :
             {addTankFarm,
              addPipeRack,
              addPipeSleepers,
              addExchangers,
              addTransformers,
              addTurbineHall,
              addChimney,
              addCoolingTower,
              addStore,
              addGasTurbine}) {
            const Box box = boxOf(Detail(level), add);
            const double max = kLotPitch / 2 + 0.2; // halls and racks join those of the next lot
            EXPECT_GE(std::min(box.min.x, box.min.z), -max);
            EXPECT_LE(std::max(box.max.x, box.max.z), max);
            EXPECT_GT(std::min(box.extent().x, box.extent().z), 11);
            EXPECT_GT(box.extent().y, 4);
            EXPECT_GE(box.min.y, -0.25) << "on the ground";
        }
}

TEST(PlantKit, DetailGrowsInNumbersAndInRoundness) {
    const Detail coarse(0.1);
    const Detail middle(1);
    const Detail fine(100);
    EXPECT_EQ(middle.amount(10), 10U) << "as many as there are at level 1";
    EXPECT_LT(coarse.amount(10), 10U);
    EXPECT_GT(fine.amount(10), 100U);
    EXPECT_EQ(coarse.amount(0.01, 3), 3U);
    EXPECT_EQ(fine.amount(1000, 1, 50), 50U);
    for (const double radius : {0.001, 0.02, 0.5, 100.0}) {
        EXPECT_LE(coarse.sides(radius), middle.sides(radius));
        EXPECT_LE(middle.sides(radius), fine.sides(radius));
        EXPECT_GE(coarse.sides(radius), 3U);
        EXPECT_LE(fine.sides(radius), 256U);
    }
    EXPECT_GE(coarse.bend(), 1U);
    EXPECT_EQ(middle.bend(), 3U);
    EXPECT_EQ(fine.bend(), 12U);
    EXPECT_EQ(share(1, 4), 0.25);
}

} // namespace
} // namespace gnomon::make
