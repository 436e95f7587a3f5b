#include "tests/raster/scenes.h"

#include <algorithm>
#include <cmath>

namespace gnomon::raster {

void Scene::add(std::vector<std::array<std::uint32_t, 3>> positions, std::vector<Triangle> triangles) {
    const auto count = static_cast<std::uint32_t>(triangles.size());
    stored_.push_back({std::move(positions), std::move(triangles), triangleCount_});
    triangleCount_ += count;
}

std::vector<Cluster> Scene::clusters() const {
    std::vector<Cluster> clusters;
    for (const Stored& stored : stored_)
        clusters.push_back(
            {stored.positions.front().data(),
             12,
             static_cast<std::uint32_t>(stored.positions.size()),
             stored.triangles,
             stored.firstTriangleId});
    return clusters;
}

View flatView(const PixelBox& viewport) {
    View view;
    view.eyeCell = glm::ivec3(static_cast<int>(kSceneCenter));
    view.viewport = viewport;
    view.clipFromCell = glm::mat4(0);
    view.clipFromCell[0][0] = 2.0F / (static_cast<float>(viewport.width()) * static_cast<float>(kFlatPixel));
    view.clipFromCell[1][1] = 2.0F / (static_cast<float>(viewport.height()) * static_cast<float>(kFlatPixel));
    view.clipFromCell[2][2] = 0x1p-20F;
    view.clipFromCell[3] = {-1, -1, 0, 1};
    return view;
}

namespace {

constexpr int kBlock = 8; // quads along the side of a cluster

std::array<std::uint32_t, 3> sheetVertex(int column, int row, double spacing, std::uint64_t seed) {
    Random random(seed ^ mix64(static_cast<std::uint64_t>(column) << 32U | static_cast<std::uint64_t>(row)));
    const double x = (column + random.uniform(-0.3, 0.3)) * spacing;
    const double y = (row + random.uniform(-0.3, 0.3)) * spacing;
    const double depth = 0.5 + 0.2 * std::sin(0.013 * x) * std::cos(0.017 * y) + random.uniform(0, 0.001);
    const auto cells = [](double pixels) {
        return kSceneCenter + static_cast<std::uint32_t>(std::llround(pixels * kFlatPixel));
    };
    return {cells(x), cells(y), kSceneCenter + static_cast<std::uint32_t>(std::llround(depth * 0x1p20))};
}

} // namespace

Scene sheet(int columns, int rows, double spacing, std::uint64_t seed) {
    Scene scene;
    for (int row = 0; row < rows; row += kBlock)
        for (int column = 0; column < columns; column += kBlock) {
            const int width = std::min(kBlock, columns - column);
            const int height = std::min(kBlock, rows - row);
            std::vector<std::array<std::uint32_t, 3>> positions;
            for (int y = 0; y <= height; ++y)
                for (int x = 0; x <= width; ++x)
                    positions.push_back(sheetVertex(column + x, row + y, spacing, seed));
            std::vector<Triangle> triangles;
            const auto index = [width](int x, int y) { return static_cast<std::uint8_t>(y * (width + 1) + x); };
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    triangles.push_back({index(x, y), index(x + 1, y), index(x, y + 1)});
                    triangles.push_back({index(x + 1, y + 1), index(x + 1, y), index(x, y + 1)});
                }
            scene.add(std::move(positions), std::move(triangles));
        }
    return scene;
}

Scene soup(int triangles, std::uint64_t seed) {
    Random random(seed);
    Scene scene;
    constexpr int kTrianglesACluster = 40;
    while (triangles > 0) {
        std::vector<std::array<std::uint32_t, 3>> positions;
        std::vector<Triangle> indices;
        for (int i = 0; i < std::min(triangles, kTrianglesACluster); ++i) {
            const double size = kFlatPixel * std::exp2(random.uniform(-2, 11));
            const std::array<double, 3> center = {
                random.uniform(-100, 400) * kFlatPixel,
                random.uniform(-100, 400) * kFlatPixel,
                random.uniform(-0.2, 1.2) * 0x1p20};
            for (int corner = 0; corner < 3; ++corner) {
                auto& position = positions.emplace_back();
                for (std::size_t axis = 0; axis < 3; ++axis)
                    position[axis] = static_cast<std::uint32_t>(
                        static_cast<std::int64_t>(kSceneCenter) +
                        std::llround(center[axis] + random.uniform(-1, 1) * size));
            }
            const auto first = static_cast<std::uint8_t>(3 * i);
            const bool isFlat = random.below(20) == 0;
            indices.push_back(
                {first, static_cast<std::uint8_t>(first + 1), static_cast<std::uint8_t>(first + (isFlat ? 1 : 2))});
        }
        scene.add(std::move(positions), std::move(indices));
        triangles -= kTrianglesACluster;
    }
    return scene;
}

View insideView(const PixelBox& viewport, std::uint64_t seed) {
    Random random(seed + 1000);
    View view = flatView(viewport);
    view.eyeCell += glm::ivec3(
        static_cast<int>(random.uniform(0, 300) * kFlatPixel),
        static_cast<int>(random.uniform(0, 300) * kFlatPixel),
        static_cast<int>(random.uniform(0, 1) * 0x1p20));
    glm::mat3 turn(1);
    for (int i = 0; i < 3; ++i) {
        const auto angle = static_cast<float>(random.uniform(0, 6.28));
        glm::mat3 step(1);
        step[i % 3][i % 3] = step[(i + 1) % 3][(i + 1) % 3] = std::cos(angle);
        step[i % 3][(i + 1) % 3] = std::sin(angle);
        step[(i + 1) % 3][i % 3] = -std::sin(angle);
        turn = step * turn;
    }
    const auto nearCells = static_cast<float>(kFlatPixel * std::exp2(random.uniform(-3, 6)));
    const float farCells = nearCells * 4096;
    glm::mat4 clipFromView(0);
    clipFromView[0][0] = 1.1F;
    clipFromView[1][1] = 1.3F;
    clipFromView[2][2] = -nearCells / (farCells - nearCells);
    clipFromView[3][2] = farCells * nearCells / (farCells - nearCells);
    clipFromView[2][3] = 1;
    view.clipFromCell = clipFromView * glm::mat4(turn);
    return view;
}

namespace {

CellBox boxOf(const Cluster& cluster) {
    CellBox box;
    box.min.fill(0xFFFFFFFFU);
    for (std::size_t i = 0; i < cluster.vertexCount; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t at = cluster.positions[i * cluster.positionStride / 4 + axis];
            box.min[axis] = std::min(box.min[axis], at);
            box.max[axis] = std::max(box.max[axis], at);
        }
    return box;
}

} // namespace

std::vector<CellBox> boxesOf(const std::vector<Cluster>& clusters) {
    std::vector<CellBox> boxes;
    boxes.reserve(clusters.size());
    for (const Cluster& cluster : clusters)
        boxes.push_back(boxOf(cluster));
    return boxes;
}

Scene crowd(std::uint64_t seed) {
    Random random(seed);
    Scene scene;
    for (int i = 0; i < 150; ++i) {
        const bool isWall = i % 4 == 0;
        const double size = isWall ? 300 : std::exp2(random.uniform(1, 5));
        const std::array<double, 3> center = {
            random.uniform(-100, 400) * kFlatPixel,
            random.uniform(-100, 400) * kFlatPixel,
            random.uniform(0, 1) * 0x1p20};
        std::vector<std::array<std::uint32_t, 3>> positions;
        std::vector<Triangle> triangles;
        const std::uint8_t count = isWall ? 1 : 20;
        for (std::uint8_t t = 0; t < count; ++t) {
            for (int corner = 0; corner < 3; ++corner) {
                auto& position = positions.emplace_back();
                for (std::size_t axis = 0; axis < 3; ++axis)
                    position[axis] = static_cast<std::uint32_t>(
                        static_cast<std::int64_t>(kSceneCenter) +
                        std::llround(center[axis] + random.uniform(-1, 1) * size * kFlatPixel));
            }
            const auto first = static_cast<std::uint8_t>(3 * t);
            triangles.push_back({first, static_cast<std::uint8_t>(first + 1), static_cast<std::uint8_t>(first + 2)});
        }
        scene.add(std::move(positions), std::move(triangles));
    }
    return scene;
}

} // namespace gnomon::raster
