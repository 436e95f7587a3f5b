// Windows over a file: bytes in big blocks, and blocks of vertices and triangles.
#include "core/error.h"
#include "core/random.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/byte_stream.h"
#include "preprocess/read/memory_source.h"
#include "tests/read/scratch_input.h"

#include <gtest/gtest.h>

#include <cstring>

namespace gnomon::read {
namespace {

class Streams : public ScratchInput {};

std::string randomText(std::size_t size) {
    Random random(size);
    std::string text(size, ' ');
    for (char& letter : text)
        letter = static_cast<char>('a' + random.below(26));
    return text;
}

TEST_F(Streams, AByteStreamIsAWindowThatMovesOverTheWholeFile) {
    const std::string text = randomText(3 * ByteStream::kBufferBytes + 12345);
    ByteStream stream(fileOf(text), 0);
    Random random(1);
    std::uint64_t place = 0;
    while (stream.remaining() > 0) {
        ASSERT_EQ(stream.offset(), place);
        ASSERT_EQ(stream.remaining(), text.size() - place);
        const std::size_t wanted = std::min<std::uint64_t>(1 + random.below(700000), stream.remaining());
        if (random.below(3) == 0) {
            stream.skip(wanted);
        } else {
            ASSERT_TRUE(stream.fill(wanted));
            ASSERT_GE(stream.available(), wanted);
            ASSERT_EQ(std::memcmp(stream.data(), text.data() + place, wanted), 0) << place;
            stream.consume(wanted);
        }
        place += wanted;
    }
    EXPECT_FALSE(stream.fill(1));
    EXPECT_TRUE(stream.fill(0));
    stream.rewind();
    EXPECT_TRUE(stream.fill(10));
    EXPECT_EQ(stream.offset(), 0U);
    EXPECT_EQ(std::memcmp(stream.data(), text.data(), 10), 0);
}

TEST_F(Streams, AByteStreamBeginsAnywhereAndKnowsWhatIsNotThere) {
    const InputFile& file = fileOf("0123456789");
    ByteStream stream(file, 4);
    EXPECT_EQ(stream.remaining(), 6U);
    EXPECT_FALSE(stream.fill(7));
    ASSERT_TRUE(stream.fill(6));
    EXPECT_EQ(static_cast<char>(*stream.data()), '4');
    EXPECT_FALSE(ByteStream(file, 10).fill(1));
}

TEST(BlockBuffers, VerticesComeInFullBlocksInOrder) {
    std::vector<std::size_t> sizes;
    std::size_t next = 0;
    const VertexSink sink = [&](const VertexBlock& block) {
        EXPECT_EQ(block.firstVertex, next);
        EXPECT_TRUE(block.normals.empty());
        ASSERT_EQ(block.colors.size(), block.positions.size());
        for (std::size_t i = 0; i < block.positions.size(); ++i) {
            EXPECT_EQ(block.positions[i].x, static_cast<double>(next + i));
            EXPECT_EQ(block.colors[i], next + i);
        }
        next += block.positions.size();
        sizes.push_back(block.positions.size());
    };
    VertexBuffer buffer(sink, {.hasColors = true});
    std::size_t made = 0;
    while (made < 2 * kBlockRows + 5) {
        const std::size_t count = std::min({buffer.room(), std::size_t{1000}, 2 * kBlockRows + 5 - made});
        const VertexBuffer::Rows rows = buffer.append(count);
        EXPECT_TRUE(rows.normals.empty());
        for (std::size_t i = 0; i < count; ++i, ++made) {
            rows.positions[i] = glm::dvec3(static_cast<double>(made), 0, 0);
            rows.colors[i] = static_cast<std::uint32_t>(made);
        }
        buffer.flushIfFull();
    }
    buffer.flush();
    buffer.flush(); // of nothing is no block
    EXPECT_EQ(sizes, (std::vector<std::size_t>{kBlockRows, kBlockRows, 5}));
}

TEST(BlockBuffers, APolygonNeverStraddlesTwoBlocks) {
    Random random(2);
    std::vector<std::uint32_t> sizes;
    MemoryMesh mesh;
    mesh.positions.resize(10);
    for (int i = 0; i < 9000; ++i) {
        const auto size = static_cast<std::uint32_t>(random.below(500) == 0 ? random.below(40000) : random.below(9));
        mesh.faceSizes.push_back(size);
        for (std::uint32_t c = 0; c < size; ++c)
            mesh.corners.push_back(random.below(10));
    }
    mesh.notAPolygon = 3;
    const std::vector<std::uint32_t> faceSizes = mesh.faceSizes;
    const std::vector<std::uint64_t> corners = mesh.corners;
    const auto source = memorySource("mesh", 17, std::move(mesh));
    const CollectedMesh collected = collect(*source);
    std::size_t triangle = 0;
    std::size_t corner = 0;
    std::size_t run = 0;
    std::uint64_t none = 3;
    for (const std::uint32_t size : faceSizes) {
        if (size < 3) ++none;
        if (size > 3) {
            ASSERT_EQ(collected.polygons[run].first, triangle);
            ASSERT_EQ(collected.polygons[run].count, size - 2);
            ++run;
        }
        for (std::uint32_t i = 2; i < size; ++i) {
            const TriangleCorners fan{corners[corner], corners[corner + i - 1], corners[corner + i]};
            ASSERT_EQ(collected.triangles[triangle++], fan);
        }
        corner += size;
    }
    EXPECT_EQ(triangle, collected.triangles.size());
    EXPECT_EQ(collected.notAPolygon, none);
    std::uint64_t faces = 0;
    source->readTriangles([&](const TriangleBlock& block) { faces += block.faceCount(); });
    EXPECT_EQ(faces, faceSizes.size() + 3);
}

TEST(MemorySource, SaysWhatItHoldsAndRefusesPointClouds) {
    MemoryMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}};
    mesh.faceSizes = {3, 2, 5};
    mesh.corners = {0, 1, 2, 0, 1, 0, 1, 2, 0, 1};
    mesh.colors = {1, 2, 3};
    const auto source = memorySource("mesh", 17, mesh);
    EXPECT_EQ(source->summary().path, "mesh");
    EXPECT_EQ(source->summary().fileBytes, 17U);
    EXPECT_EQ(source->summary().vertexCount, 3U);
    EXPECT_EQ(source->summary().faceCount, 3U);
    EXPECT_EQ(source->summary().likelyTriangles, 4U);
    EXPECT_TRUE(source->summary().hasColors);
    EXPECT_FALSE(source->summary().hasNormals);
    EXPECT_FALSE(source->summary().isDouble);
    EXPECT_GE(source->summary().heldBytes, 3 * 24 + 3 * 4 + 10 * 8 + 3 * 4U);
    mesh.positions[0].x = 0.1;
    EXPECT_TRUE(memorySource("mesh", 17, mesh)->summary().isDouble) << "a float does not hold it";
    mesh.faceSizes = {};
    mesh.corners = {};
    EXPECT_THROW(memorySource("mesh", 17, mesh), Error);
    mesh.faceSizes = {2};
    mesh.corners = {0, 1};
    EXPECT_THROW(collect(*memorySource("mesh", 17, mesh)), Error) << "faces, but no triangles";
}

} // namespace
} // namespace gnomon::read
