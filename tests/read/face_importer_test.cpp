// What OpenMesh's readers hand over becomes faces as they came, with a twin for each further normal of a vertex.
#include "core/error.h"
#include "preprocess/read/face_importer.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::read {
namespace {

using OpenMesh::Vec3d;
using OpenMesh::Vec3f;
using OpenMesh::VertexHandle;

class Faces : public testing::Test {
protected:
    Faces() {
        for (int i = 0; i < 4; ++i)
            importer.add_vertex(Vec3f(static_cast<float>(i), 0, 0));
    }

    void addFace(const std::vector<int>& corners) {
        importer.add_face(std::vector<VertexHandle>(corners.begin(), corners.end()));
    }

    FaceImporter importer{[] { return std::string("a.obj:7"); }};
};

TEST_F(Faces, AreKeptAsTheyCameWhateverTheirTopology) {
    addFace({0, 1, 2});
    addFace({0, 1, 2}); // a half-edge mesh would refuse this one
    addFace({3, 2, 1, 0});
    addFace({1, 1});
    EXPECT_EQ(importer.n_vertices(), 4U);
    EXPECT_EQ(importer.n_faces(), 4U);
    const MemoryMesh mesh = importer.take();
    EXPECT_EQ(mesh.faceSizes, (std::vector<std::uint32_t>{3, 3, 4, 2}));
    EXPECT_EQ(mesh.corners, (std::vector<std::uint64_t>{0, 1, 2, 0, 1, 2, 3, 2, 1, 0, 1, 1}));
    EXPECT_EQ(mesh.positions[3], glm::dvec3(3, 0, 0));
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.colors.empty());
    EXPECT_EQ(importer.n_vertices(), 0U) << "it is empty afterwards";
}

TEST_F(Faces, GiveAVertexATwinForEachOtherNormal) {
    const auto face = [&](const Vec3f& normal) {
        importer.set_normal(VertexHandle(1), normal);
        addFace({0, 1, 2});
    };
    face({0, 1, 0});
    face({0, 0, 1});
    face({0, 1, 0});
    face({0, 0, 1});
    face({1, 0, 0});
    addFace({0, 1, 2}); // whose corners were given none: as the vertex had it first
    const MemoryMesh mesh = importer.take();
    ASSERT_EQ(mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.positions[4], mesh.positions[1]);
    EXPECT_EQ(mesh.positions[5], mesh.positions[1]);
    std::vector<std::uint64_t> second;
    for (std::size_t i = 1; i < mesh.corners.size(); i += 3)
        second.push_back(mesh.corners[i]);
    EXPECT_EQ(second, (std::vector<std::uint64_t>{1, 4, 1, 4, 5, 1}));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.normals[4], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[5], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.normals[0], glm::vec3(0)) << "it has none";
}

TEST_F(Faces, RefuseWhatIsNoVertexAndNoNumberWithItsPlace) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(importer.add_vertex(Vec3f(0, nan, 0)), Error);
    EXPECT_THROW(importer.add_vertex(Vec3d(0, 0, std::numeric_limits<double>::infinity())), Error);
    for (const int index : {-1, 4})
        try {
            addFace({0, index, 1});
            ADD_FAILURE() << index;
        } catch (const Error& error) {
            EXPECT_EQ(
                std::string(error.what()),
                "a.obj:7: vertex index out of range: expected one of 4 vertices, found index " + std::to_string(index) +
                    " counted from 0");
        }
    importer.set_normal(VertexHandle(0), Vec3f(nan, 0, 0));
    EXPECT_EQ(importer.take().normals.at(0), glm::vec3(0)) << "that normal is none";
}

} // namespace
} // namespace gnomon::read
