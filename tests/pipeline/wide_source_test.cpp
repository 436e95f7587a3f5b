// Sources of more vertices than 32 bits number come to the bytes that they have without the vertices that nobody uses.
#include "hierarchy/model_file.h"
#include "preprocess/pipeline/build_model.h"
#include "tests/pipeline/test_folder.h"
#include "tests/read/spread_mesh.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

/// Of all pages: the number of the source's vertices, which a model tells, is another.
std::vector<std::uint64_t> pagesOf(const read::SpreadMesh::Shape& shape, std::uint32_t chunkTriangles) {
    const TestFolder folder;
    read::SpreadMesh source(read::bumpySheet(60), shape);
    BuildOptions options;
    options.output = folder.file("m.gnm");
    options.memory = gibibytes(64); // of which nearly nothing is taken
    options.chunkTriangles = chunkTriangles;
    NoProgress progress;
    EXPECT_EQ(buildModel(source, options, progress).summary.sourceVertices, 3721 + shape.gap);
    std::vector<std::uint64_t> checksums;
    const hierarchy::ModelFile file(options.output);
    for (const hierarchy::PageInfo& page : file.pages())
        checksums.push_back(page.checksum);
    return checksums;
}

TEST(WideSource, IsBuiltToTheBytesOfANarrowOne) {
    for (const bool isQuads : {false, true})
        for (const bool hasNormals : {false, true})
            for (const std::uint32_t chunkTriangles : {500U, 100'000U}) {
                const std::vector<std::uint64_t> expected = pagesOf({0, 0, isQuads, hasNormals}, chunkTriangles);
                // The last narrow number, the first wide ones, and numbers that differ above 32 bits alone.
                for (const std::uint64_t gap : {0xFFFFFFFFU - 3721ULL, 0x100000000ULL - 3721, 0x100000000ULL - 2000})
                    EXPECT_EQ(pagesOf({2000, gap, isQuads, hasNormals}, chunkTriangles), expected)
                        << gap << (isQuads ? " quads" : "") << (hasNormals ? " normals" : "");
            }
}

} // namespace
} // namespace gnomon::pipeline
