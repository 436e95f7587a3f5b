// Framing: what fills the picture, where the light stands, and that both turn with the world.
#include "core/angle.h"
#include "core/random.h"
#include "hierarchy/upright_frame.h"
#include "path/camera_path.h"
#include "path/framing.h"
#include "path/outline.h"
#include "tests/path/made_model.h"

#include <gtest/gtest.h>

#include <fstream>

namespace gnomon::path {
namespace {

constexpr std::array<glm::dvec3, 6> kAxes = {
    glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};

/// Where points lie in a picture, from -1 to 1 each way.
struct Seen {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};
    double nearest = std::numeric_limits<double>::infinity();

    Seen(const std::vector<glm::dvec3>& points, const Camera& camera, double aspect) {
        const CameraBasis basis = cameraBasis(camera);
        const double tangent = std::tan(camera.fovYRadians / 2);
        for (const glm::dvec3& point : points) {
            const glm::dvec3 p = toCamera(basis, point - camera.eye);
            const glm::dvec2 at(p.x / p.z / tangent / aspect, p.y / p.z / tangent);
            min = glm::min(min, at);
            max = glm::max(max, at);
            nearest = std::min(nearest, p.z);
        }
    }

    double fill() const { return std::max(max.x - min.x, max.y - min.y) / 2; }

    double offMiddle() const { return std::max(std::abs(max.x + min.x), std::abs(max.y + min.y)) / 2; }
};

TEST(UprightFrame, TurnsByQuartersAndMovesNoDigit) {
    for (const glm::dvec3& up : kAxes) {
        const hierarchy::UprightFrame frame = hierarchy::uprightFrame(3.0 * up);
        EXPECT_EQ(frame.up, up);
        EXPECT_EQ(glm::cross(frame.right, frame.up), frame.front);
        const glm::dvec3 point(0.1, 1e17 / 3, -1e-9 / 7);
        EXPECT_EQ(frame.toUpright(frame.toWorld(point)), point);
    }
    EXPECT_EQ(hierarchy::uprightFrame({0, 1, 0}).toWorld({1, 2, 3}), glm::dvec3(1, 2, 3));
    EXPECT_EQ(hierarchy::uprightFrame({0, 0, 1}).toWorld({1, 2, 3}), glm::dvec3(1, -3, 2));
    Random random(4);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 up(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
        EXPECT_NEAR(glm::dot(frame.up, glm::normalize(up)), 1, 1e-12);
        EXPECT_LT(glm::length(glm::cross(frame.right, frame.up) - frame.front), 1e-12);
        EXPECT_NEAR(glm::length(frame.front), 1, 1e-12);
    }
}

TEST(Framing, FillsAPictureOfAnyShapeFromAnySideAndLiesInItsMiddle) {
    Random random(11);
    int framed = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const glm::dvec3 size(
            std::exp2(random.uniform(-6, 6)), std::exp2(random.uniform(-6, 6)), std::exp2(random.uniform(-6, 6)));
        const glm::dvec3 middle(random.uniform(-99, 99), random.uniform(-99, 99), random.uniform(-99, 99));
        std::vector<glm::dvec3> points;
        points.reserve(30);
        for (int i = 0; i < 30; ++i)
            points.push_back(
                middle + size * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
        const glm::dvec3 up(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        std::optional<ViewSide> side;
        if (const auto choice = random.below(kViewSides.size() + 1); choice > 0) side = kViewSides.at(choice - 1).value;
        const double aspect = std::exp2(random.uniform(-3, 3));
        const Camera camera = framingCamera(points, vantageOf(side, up), aspect, random.uniform(0.1, 2.5));
        const Seen seen(points, camera, aspect);
        Box box;
        for (const glm::dvec3& point : points)
            box.add(point);
        const double closest = 0.02 * glm::length(box.extent());
        EXPECT_GT(seen.nearest, 0.999999 * closest);
        EXPECT_LT(seen.fill(), kFramedPart + 1e-9);
        const bool isFree = seen.nearest > 1.000001 * closest;
        EXPECT_TRUE(!isFree || seen.fill() > kFramedPart - 1e-9);
        framed += isFree ? 1 : 0;
        EXPECT_LT(seen.offMiddle(), 1e-6);
    }
    EXPECT_GT(framed, 250);
}

TEST(Framing, FillsAPictureByParallelLinesToo) {
    Random random(17);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<glm::dvec3> points(30);
        const glm::dvec3 middle(random.uniform(-99, 99), random.uniform(-99, 99), random.uniform(-99, 99));
        for (glm::dvec3& point : points)
            point = middle + glm::dvec3(random.uniform(-9, 9), random.uniform(-1, 1), random.uniform(-0.1, 0.1));
        const glm::dvec3 up(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const double aspect = std::exp2(random.uniform(-3, 3));
        const Vantage vantage = vantageOf(kViewSides.at(static_cast<std::size_t>(trial) % 7).value, up);
        const Camera camera = orthographicFraming(points, vantage, aspect, random.uniform(0.1, 2.5));
        EXPECT_TRUE(camera.isParallel());
        const CameraBasis basis = cameraBasis(camera);
        glm::dvec2 min(1e9);
        glm::dvec2 max(-1e9);
        for (const glm::dvec3& point : points) {
            const glm::dvec3 p = toCamera(basis, point - camera.eye) / halfHeightAtTarget(camera);
            min = glm::min(min, {p.x / aspect, p.y});
            max = glm::max(max, {p.x / aspect, p.y});
        }
        EXPECT_NEAR(std::max(max.x - min.x, max.y - min.y) / 2, kFramedPart, 1e-9);
        EXPECT_LT(glm::length(max + min), 1e-9);
    }
}

// The picture of a world is the same whichever of its axes is up: camera and light turn with it.
TEST(Framing, TurnsWithTheWorld) {
    Random random(12);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<glm::dvec3> points;
        points.reserve(20);
        for (int i = 0; i < 20; ++i)
            points.emplace_back(random.uniform(-3, 3), random.uniform(-1, 1), random.uniform(-2, 2));
        for (const glm::dvec3& up : kAxes) {
            const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
            std::vector<glm::dvec3> turned;
            turned.reserve(points.size());
            for (const glm::dvec3& point : points)
                turned.push_back(frame.toWorld(point));
            std::optional<ViewSide> side;
            if (trial % 8 > 0) side = kViewSides.at(static_cast<std::size_t>(trial % 8 - 1)).value;
            const Camera plain = framingCamera(points, vantageOf(side, {0, 1, 0}), 1.3, 0.9);
            const Camera camera = framingCamera(turned, vantageOf(side, up), 1.3, 0.9);
            EXPECT_LT(glm::distance(camera.eye, frame.toWorld(plain.eye)), 1e-9);
            EXPECT_LT(glm::distance(camera.target, frame.toWorld(plain.target)), 1e-9);
            EXPECT_LT(glm::distance(camera.up, frame.toWorld(plain.up)), 1e-12);
            EXPECT_EQ(usualLight(up), frame.toWorld(usualLight({0, 1, 0})));
        }
    }
}

TEST(Framing, APointAndALineAreSeenTooFromOutside) {
    for (const auto& [side, word] : kViewSides) {
        const std::vector<glm::dvec3> line = {{1, 2, 3}, {1, 2, 9}};
        const Camera camera = framingCamera(line, vantageOf(side, {0, 1, 0}), 1, 1);
        EXPECT_GT(Seen(line, camera, 1).nearest, 0) << word;
        EXPECT_LE(Seen(line, camera, 1).fill(), kFramedPart + 1e-9) << word;
        const std::vector<glm::dvec3> point = {{0, 0, 0}};
        EXPECT_NO_THROW(cameraBasis(framingCamera(point, vantageOf(side, {0, 1, 0}), 1, 1))) << word;
    }
}

TEST(Framing, SidesAreNamedAsSomeoneInFrontOfTheModelNamesThem) {
    const auto from = [](ViewSide side, const glm::dvec3& up) { return vantageOf(side, up).from; };
    EXPECT_EQ(from(ViewSide::Front, {0, 1, 0}), glm::dvec3(0, 0, 1));
    EXPECT_EQ(from(ViewSide::Right, {0, 1, 0}), glm::dvec3(1, 0, 0));
    EXPECT_EQ(from(ViewSide::Front, {0, 0, 1}), glm::dvec3(0, -1, 0));
    EXPECT_EQ(from(ViewSide::Left, {0, 0, 1}), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(vantageOf(ViewSide::Top, {0, 0, 1}).up, glm::dvec3(0, 1, 0)) << "as a map";
    for (const glm::dvec3& up : kAxes) {
        EXPECT_EQ(from(ViewSide::Top, up), up);
        EXPECT_EQ(from(ViewSide::Bottom, up), -up);
        EXPECT_EQ(from(ViewSide::Back, up), -from(ViewSide::Front, up));
        EXPECT_EQ(from(ViewSide::Right, up), -from(ViewSide::Left, up));
        EXPECT_NEAR(glm::dot(from(ViewSide::Iso, up), up), std::sqrt(1.0 / 3), 1e-12);
        // What is seen of a box by itself is lit: front, right and top.
        const glm::dvec3 view = vantageOf({}, up).from;
        for (const glm::dvec3& axis : kAxes)
            EXPECT_EQ(glm::dot(view, axis) > 0, glm::dot(usualLight(up), axis) > 0);
    }
    EXPECT_EQ(usualLight({0, 1, 0}), glm::dvec3(0.4, 1, 0.3));
}

// Against all triangles at full detail: what a coarse cut tells of the outline is near enough.
TEST(Outline, FramesTheModelAtFullDetail) {
    for (const char* kind : {"statue", "plant"}) {
        const MadeModel model(made(kind, 20000));
        std::vector<glm::dvec3> all;
        for (const auto& triangle : model.triangles())
            all.insert(all.end(), triangle.begin(), triangle.end());
        const std::vector<glm::dvec3> outline = outlineOf(model.file());
        EXPECT_LT(outline.size(), all.size() / 4) << kind;
        for (const double aspect : {0.4, 1.0, 3.0})
            for (const auto& [side, word] : kViewSides) {
                const Camera camera = framingCamera(outline, vantageOf(side, {0, 1, 0}), aspect, 1);
                const Seen seen(all, camera, aspect);
                EXPECT_TRUE(seen.fill() > 0.86 && seen.fill() < 0.89)
                    << kind << " from " << word << ": " << seen.fill();
                EXPECT_LT(seen.offMiddle(), 0.01) << kind << " from " << word;
            }
    }
}

/// Writes a square pyramid of 2 n^2 triangles, and `strays` small triangles around a point on the x axis.
auto pyramidWithStrays(int n, int strays, double x) {
    return [=](const std::string& path) {
        std::ofstream out(path);
        const int side = n + 1;
        out << "ply\nformat ascii 1.0\nelement vertex " << side * side + 3 * strays
            << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << 2 * n * n + strays
            << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (int i = 0; i < side * side; ++i)
            out << i % side << ' ' << std::min({i % side, i / side, n - i % side, n - i / side}) << ' ' << i / side
                << '\n';
        for (int i = 0; i < 3 * strays; ++i)
            out << x + i % 3 << ' ' << i % 2 << ' ' << i << '\n';
        for (int i = 0; i < n * n; ++i) {
            const int a = i / n * side + i % n;
            out << "3 " << a << ' ' << a + side << ' ' << a + 1 << "\n3 " << a + 1 << ' ' << a + side << ' '
                << a + side + 1 << '\n';
        }
        for (int i = side * side; i < side * side + 3 * strays; i += 3)
            out << "3 " << i << ' ' << i + 1 << ' ' << i + 2 << '\n';
    };
}

TEST(Outline, LeavesOutStrays) {
    const auto boxOf = [](const std::vector<glm::dvec3>& points) {
        Box box;
        for (const glm::dvec3& point : points)
            box.add(point);
        return box;
    };
    const MadeModel plain(pyramidWithStrays(50, 0, 0));
    const MadeModel strayed(pyramidWithStrays(50, 5, 4000));
    EXPECT_GT(strayed.file().summary().bounds.max.x, 4000) << "they are in the model";
    const Box expected = boxOf(outlineOf(plain.file()));
    const Box found = boxOf(outlineOf(strayed.file()));
    EXPECT_LT(glm::length(found.min - expected.min) + glm::length(found.max - expected.max), 0.5);
    const MadeModel many(pyramidWithStrays(50, 20, 4000));
    EXPECT_GT(boxOf(outlineOf(many.file())).max.x, 4000) << "more than a thousandth are a part of the model";
}

TEST(Outline, SweptStaysInThePictureThroughAWholeTurn) {
    Random random(5);
    std::vector<glm::dvec3> points;
    points.reserve(40);
    for (int i = 0; i < 40; ++i)
        points.emplace_back(random.uniform(-9, 9), random.uniform(-1, 1), random.uniform(-2, 2));
    Box box;
    for (const glm::dvec3& point : points)
        box.add(point);
    const glm::dvec3 up(0, 1, 0);
    const Camera camera = framingCamera(sweptOutline(points, box.center(), up), vantageOf({}, up), 1.5, 1);
    double largest = 0;
    for (int turn = 0; turn < 100; ++turn) {
        const Seen seen(points, turnedAround(camera, up, 2 * kPi * turn / 100), 1.5);
        const glm::dvec2 furthest = glm::max(glm::abs(seen.min), glm::abs(seen.max));
        largest = std::max({largest, furthest.x, furthest.y});
    }
    EXPECT_GT(largest, 0.85);
    EXPECT_LT(largest, 0.9);
}

} // namespace
} // namespace gnomon::path
