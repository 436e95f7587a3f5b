// An OBJ in streams against a plain reading, which holds the file: the same triangles of the same corners, and the same
// files are refused.
#include "core/random.h"
#include "preprocess/read/block_buffers.h"
#include "preprocess/read/obj/obj_lines.h"
#include "preprocess/read/obj/obj_source.h"
#include "tests/read/collect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>
#include <sstream>
#include <tuple>

#include <unistd.h>

namespace gnomon::read {
namespace {

constexpr Bytes kObjRoom = mebibytes(256);

/// All that a corner has.
using Corner = std::tuple<double, double, double, float, float, float, std::uint32_t>;

/// A mesh as its corners, and which of them share a vertex, by its first appearance.
struct PlainMesh {
    std::vector<Corner> corners;
    std::vector<std::size_t> sharing;
    std::uint64_t notAPolygon = 0;
};

/// Where a comment begins in `line`; not in "1.#IND".
std::size_t commentIn(const std::string& line) {
    std::size_t at = line.find('#');
    while (at != std::string::npos && at > 0 && line[at - 1] == '.')
        at = line.find('#', at + 1);
    return at;
}

std::vector<std::string> objWordsOf(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
        words.push_back(word);
    return words;
}

/// The slow, obviously right reading: everything is held, and faces are looked up when all lines are known.
class PlainObj {
public:
    explicit PlainObj(std::map<std::string, std::uint32_t> materials) : materials_(std::move(materials)) {}

    /// Nothing where the file has to be refused.
    std::optional<PlainMesh> read(const std::string& text) {
        std::istringstream stream(text);
        std::string whole;
        bool isContinued = false;
        for (std::string line; std::getline(stream, line);) {
            whole += line.substr(0, commentIn(line));
            const std::size_t last = whole.find_last_not_of(" \t\r\v\f");
            isContinued = last != std::string::npos && whole[last] == '\\' && commentIn(line) == std::string::npos;
            if (isContinued) {
                whole.resize(last);
                whole += ' ';
                continue;
            }
            if (!take(objWordsOf(std::exchange(whole, {})))) return std::nullopt;
        }
        if (isContinued || !resolve()) return std::nullopt;
        return mesh_;
    }

private:
    struct Vertex {
        glm::dvec3 position{0};
        std::optional<glm::dvec3> color;
        std::optional<glm::vec3> normal; // the one that it was given first
    };

    struct Face {
        std::vector<std::array<std::int64_t, 2>> corners; // vertices and normals, counted from 0
        std::uint32_t color = 0xFFFFFFFF;
    };

    static std::optional<double> number(const std::string& word) {
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (word.empty() || *end != '\0' || word.find_first_of("xXpP") != std::string::npos) return std::nullopt;
        return value;
    }

    static std::optional<std::int64_t> index(const std::string& word, std::size_t count) {
        char* end = nullptr;
        const long long value = std::strtoll(word.c_str(), &end, 10);
        const bool isGood = !word.empty() && *end == '\0' && std::isspace(static_cast<unsigned char>(word[0])) == 0;
        if (!isGood || value == 0 || std::abs(value) > 0x7FFFFFFF || word.starts_with("+-")) return std::nullopt;
        return value > 0 ? value - 1 : static_cast<std::int64_t>(count) + value;
    }

    bool take(const std::vector<std::string>& words) {
        if (words.empty()) return true;
        if (words[0] == "v" || words[0] == "vn") return takeVector(words);
        if (words[0] == "f") return takeFace(words);
        if (words[0] == "usemtl")
            color_ =
                words.size() > 1 && hasLibrary_ && materials_.contains(words[1]) ? materials_[words[1]] : 0xFFFFFFFF;
        hasUsedColor_ = hasUsedColor_ || color_ != 0xFFFFFFFF;
        hasLibrary_ = hasLibrary_ || (words[0] == "mtllib" && words.size() > 1 && words[1] == "a.mtl");
        return true;
    }

    bool takeVector(const std::vector<std::string>& words) {
        glm::dvec3 vector(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::optional<double> value = i + 1 < words.size() ? number(words[i + 1]) : std::nullopt;
            if (!value ||
                (words[0] == "v" && std::isinf(*value) && words[i + 1].find_first_of("iI") == std::string::npos))
                return false;
            vector[static_cast<int>(i)] = *value;
        }
        if (words[0] == "vn") {
            normals_.push_back(finiteOrZero(vector));
            return true;
        }
        vertices_.push_back({vector, std::nullopt, std::nullopt});
        glm::dvec3 color(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::optional<double> value = i + 4 < words.size() ? number(words[i + 4]) : std::nullopt;
            if (!value || !std::isfinite(*value)) return true;
            color[static_cast<int>(i)] = *value;
        }
        vertices_.back().color = color;
        return true;
    }

    bool takeFace(const std::vector<std::string>& words) {
        Face face;
        face.color = color_;
        for (std::size_t i = 1; i < words.size(); ++i) {
            std::vector<std::string> parts;
            std::istringstream stream(words[i]);
            for (std::string part; std::getline(stream, part, '/');)
                parts.push_back(part);
            const auto slashes = std::count(words[i].begin(), words[i].end(), '/');
            parts.resize(static_cast<std::size_t>(slashes) + 1);
            const auto vertex = index(parts[0], vertices_.size());
            if (!vertex || parts.size() > 3) return false;
            if (parts.size() > 1 && !parts[1].empty() && !index(parts[1], 0)) return false;
            std::optional<std::int64_t> normal = -1;
            if (parts.size() > 2 && !parts[2].empty()) normal = index(parts[2], normals_.size());
            if (!normal) return false;
            face.corners.push_back({*vertex, *normal});
        }
        faces_.push_back(std::move(face));
        return true;
    }

    bool hasNormal(const std::array<std::int64_t, 2>& corner) const {
        return corner[1] >= 0 && corner[1] < static_cast<std::int64_t>(normals_.size());
    }

    bool isThere(std::int64_t vertex, bool hasToBeFinite) const {
        if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices_.size())) return false;
        return !hasToBeFinite || isFinite(vertices_[static_cast<std::size_t>(vertex)].position);
    }

    /// The largest channel of the colours of vertices; nothing if none has a colour.
    std::optional<double> largestChannel() const {
        std::optional<double> largest;
        for (const Vertex& vertex : vertices_)
            if (const auto& c = vertex.color) largest = std::max({largest.value_or(0), c->x, c->y, c->z});
        return largest;
    }

    bool areCornersThere(const Face& face, bool isPolygon) const {
        return std::ranges::all_of(face.corners, [&](const auto& corner) {
            return (!isPolygon && !hasNormal(corner)) || isThere(corner[0], isPolygon);
        });
    }

    /// Gives the normals of a face to its vertices; those that differ from the first one of their vertex go to
    /// `others`.
    void takeNormals(const Face& face, std::map<std::int64_t, glm::vec3>& others) {
        for (const auto& corner : face.corners) {
            if (!hasNormal(corner)) continue;
            const glm::vec3 normal = normals_[static_cast<std::size_t>(corner[1])];
            std::optional<glm::vec3>& own = vertices_[static_cast<std::size_t>(corner[0])].normal;
            if (!own) own = normal;
            others.erase(corner[0]);
            if (*own != normal) others[corner[0]] = normal;
        }
    }

    static bool isPolygonOf(const Face& face) {
        std::set<std::int64_t> different;
        for (const auto& corner : face.corners)
            different.insert(corner[0]);
        return different.size() > 2;
    }

    bool resolve() {
        const std::optional<double> max = largestChannel();
        const bool isColored = max.has_value();
        const bool hasFaceColors = !isColored && hasUsedColor_;
        std::map<std::int64_t, glm::vec3> others; // normals of vertices besides the first ones, until the next polygon
        for (const Face& face : faces_) {
            const bool isPolygon = isPolygonOf(face);
            if (!areCornersThere(face, isPolygon)) return false;
            takeNormals(face, others);
            if (!isPolygon) {
                ++mesh_.notAPolygon;
                continue;
            }
            for (std::size_t i = 2; i < face.corners.size(); ++i)
                for (const std::size_t k : {std::size_t{0}, i - 1, i})
                    add(face.corners[k][0], others, hasFaceColors ? face.color : 0xFFFFFFFF, max > 1.0 ? 255 : 1);
            others.clear();
        }
        finish(isColored || hasFaceColors);
        return !mesh_.corners.empty();
    }

    void add(std::int64_t number, const std::map<std::int64_t, glm::vec3>& others, std::uint32_t color, double full) {
        const Vertex& vertex = vertices_[static_cast<std::size_t>(number)];
        if (vertex.color) {
            color = 0xFF000000U;
            for (int i = 0; i < 3; ++i)
                color |=
                    static_cast<std::uint32_t>(std::lround(std::clamp((*vertex.color)[i] * (255 / full), 0.0, 255.0)))
                    << (8 * i);
        }
        const auto other = others.find(number);
        const glm::vec3 normal = other == others.end() ? glm::vec3(0) : other->second;
        const auto key = std::tuple(number, other != others.end(), normal.x, normal.y, normal.z, color);
        mesh_.sharing.push_back(names_.try_emplace(key, names_.size() + 1).first->second);
        const glm::dvec3& p = vertex.position;
        mesh_.corners.emplace_back(p.x, p.y, p.z, normal.x, normal.y, normal.z, color);
        owners_.push_back(other == others.end() ? number : -1);
    }

    /// Corners without another normal have the first one of their vertex, which a later face may give.
    void finish(bool hasColors) {
        for (std::size_t i = 0; i < owners_.size(); ++i) {
            auto& [x, y, z, nx, ny, nz, color] = mesh_.corners[i];
            if (!hasColors) color = 0;
            if (owners_[i] < 0) continue;
            const glm::vec3 own = vertices_[static_cast<std::size_t>(owners_[i])].normal.value_or(glm::vec3(0));
            std::tie(nx, ny, nz) = std::tie(own.x, own.y, own.z);
        }
    }

    std::map<std::string, std::uint32_t> materials_;
    std::vector<Vertex> vertices_;
    std::vector<glm::vec3> normals_;
    std::vector<Face> faces_;
    std::uint32_t color_ = 0xFFFFFFFF;
    bool hasLibrary_ = false;
    bool hasUsedColor_ = false; // whether a face follows or not
    PlainMesh mesh_;
    std::map<std::tuple<std::int64_t, bool, float, float, float, std::uint32_t>, std::size_t> names_;
    std::vector<std::int64_t> owners_;
};

class StreamedObj : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder); }

    void TearDown() override { std::filesystem::remove_all(folder); }

    void expectAlike(const std::string& text);

    std::string errorOf(const std::string& text) {
        writeScratch(path, text);
        return errorAbout(path, [&] { collect(*openObj(path, kObjRoom)); });
    }

    const std::string folder = testing::TempDir() + "gnomon_obj_stream_" +
                               testing::UnitTest::GetInstance()->current_test_info()->name() +
                               std::to_string(::getpid());
    const std::string path = folder + "/a.obj";
    std::map<std::string, std::uint32_t> materials; // of the library a.mtl
};

std::vector<Corner> cornersOf(const CollectedMesh& mesh) {
    std::vector<Corner> corners;
    for (const TriangleCorners& triangle : mesh.triangles)
        for (const std::uint64_t v : triangle) {
            const glm::dvec3& p = mesh.positions[v];
            const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0) : mesh.normals[v];
            corners.emplace_back(p.x, p.y, p.z, n.x, n.y, n.z, mesh.colors.empty() ? 0 : mesh.colors[v]);
        }
    return corners;
}

std::vector<std::size_t> sharingOf(const CollectedMesh& mesh) {
    std::vector<std::size_t> names(mesh.positions.size(), 0);
    std::vector<std::size_t> sharing;
    std::size_t next = 0;
    for (const TriangleCorners& triangle : mesh.triangles)
        for (const std::uint64_t v : triangle) {
            if (names[v] == 0) names[v] = ++next;
            sharing.push_back(names[v]);
        }
    return sharing;
}

void StreamedObj::expectAlike(const std::string& text) {
    const std::optional<PlainMesh> plain = PlainObj(materials).read(text);
    const std::string message = errorOf(text);
    ASSERT_EQ(message == "no error", plain.has_value()) << text << message;
    if (!plain) return;
    const auto streamed = openObj(path, kObjRoom);
    const CollectedMesh mesh = collect(*streamed);
    ASSERT_EQ(cornersOf(mesh), plain->corners) << text;
    ASSERT_EQ(sharingOf(mesh), plain->sharing) << text;
    EXPECT_EQ(mesh.notAPolygon, plain->notAPolygon) << text;
    EXPECT_EQ(streamed->summary().likelyTriangles, mesh.triangles.size()) << text;
    EXPECT_EQ(streamed->summary().hasNormals, !mesh.normals.empty()) << text;
    EXPECT_EQ(streamed->summary().hasColors, !mesh.colors.empty()) << text;
    EXPECT_EQ(collect(*streamed), mesh) << "passes repeat";
    for (std::uint64_t vertex = 0; vertex < std::min<std::size_t>(mesh.positions.size(), 3); ++vertex)
        EXPECT_TRUE(streamed->whereIs(vertex).starts_with(path + ":")) << text;
}

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n";

TEST_F(StreamedObj, IsTheMeshOfAPlainFile) {
    expectAlike(kCorners + "f 1 2 3 4\nf -5 -4 -1\nf 1/2 2/ 3/1/ 5\n");
    expectAlike("# a\r\n\r\n  v +0 0 0\r\nv\t1 0 0 1\r\nv 0 1 0 # here\r\nf 1 2 \\\r\n 3\r\nvt 0 0\nl 1 2\np 1\ng a\n");
    expectAlike("f 1 2 3\nv 0 0 0\nv 1 0 0\nf 1 2 -1\nv 0 1 0\nf -1 -2 -3");
    expectAlike(kCorners + "f 1 2\nf 1 1 2\nf\nf 1 2 3\nf 1 2 3 2 1\nf 1 99\n");
}

TEST_F(StreamedObj, HasTheNormalsOfItsCorners) {
    const std::string normals = "vn 0 0 1\nvn 1 0 0\nvn 0 0 1\nvn 0 1 0\nvn 1 1 1\n";
    expectAlike(kCorners + normals + "f 1//1 2//2 3//3\nf 3//3 4//4 5//5\nf 1 2 3\n");
    expectAlike(
        kCorners + normals + "f 1//1 2//1 3//1\nf 1//2 4//2 3//2\nf 1//3 2//1 5//2\nf 1//2 2//2 3//2\nf 1 2 3\n");
    expectAlike(kCorners + normals + "f 1//9 2//-9 3//1\nf 1//1 2//-1 1//2\n");
    expectAlike(kCorners + normals + "f 1//1 2//2\nf 1//2 1//3 1//2\nf 1 2 3\nf 1//4 1//2 2 3\n");
    expectAlike(kCorners + "f 1//1 2//1 3//1\n");
    expectAlike(kCorners + "vn 3e38 3e38 0\nvn 0 1 0\nf 1//1 2//2 3//1\n");
    expectAlike(kCorners + "f 1//1 2//2 3//3\nvn 0 0 1\nvn 1 0 0\n");
}

/// Faces of very many corners that have other normals than their vertices had before: a look at all of them for each
/// corner takes minutes. So do faces that are none, whose normals count until the next one.
TEST_F(StreamedObj, HasTheNormalsOfVeryManyCorners) {
    constexpr int kCornerCount = 60000;
    std::ostringstream own; // triangles that give each vertex its own normal
    std::ostringstream others;
    std::ostringstream none;
    std::ostringstream large; // one face
    for (int i = 1; i <= kCornerCount; ++i)
        own << "v " << i << ' ' << i % 2 << " 0\nvn 0 " << i << " 1\n";
    own << "vn 1 0 0\n";
    large << 'f';
    for (int i = 1; i <= kCornerCount; ++i) {
        const std::string other = std::to_string(i) + "//" + std::to_string(kCornerCount + 1);
        const char* const begin = i % 3 == 1 ? "f " : " ";
        const char* const end = i % 3 == 0 ? "\n" : "";
        own << begin << i << "//" << i << end;
        others << begin << other << end;
        none << "f " << other << ' ' << other << ' ' << other << '\n';
        large << ' ' << other;
    }
    expectAlike(own.str() + others.str() + none.str() + "f 1//1 2//2 3//3 4 5//5\n");
    writeScratch(path, own.str() + large.str() + "\nf 1 2 3\n");
    EXPECT_EQ(openObj(path, kObjRoom)->summary().vertexCount, 2U * kCornerCount);
}

TEST_F(StreamedObj, HasTheColoursOfVerticesAndMaterials) {
    writeScratch(folder + "/a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd a.png\n");
    materials = {{"red", 0xFF0000FF}, {"blue", 0xFFFF0000}};
    const std::string vivid = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0.25 2 -1\nv 0 1 0 1 1 1\n";
    expectAlike(vivid + "f 1 2 3\n");
    const std::string library = "mtllib a.mtl\n";
    expectAlike(library + vivid + "usemtl red\nf 1 2 3\n");
    expectAlike(library + kCorners + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\nusemtl none\nf 1 2 5\nf 3 4 1\n");
    expectAlike(
        library + kCorners +
        "vn 0 0 1\nvn 1 0 0\nusemtl red\nf 1//1 2//1 3//1\nusemtl blue\nf 1//2 3//1 4//2\nf 1 2 3\n");
    expectAlike(
        library + kCorners +
        "vn 0 0 1\nvn 1 0 0\nvn 0 1 0\nusemtl red\nf 1//1 2//2 3//3\nusemtl blue\nf 3//3 2//2 4\n");
    expectAlike("mtllib gone.mtl\n" + kCorners + "usemtl red\nf 1 2 3\n");
    expectAlike("v 0 0 0 255 0 0\nv 1 0 0 0 128 0\nv 1 1 0\nf 1 2 3\n"); // some vertices, and a range to 255
    writeScratch(path, kCorners + "vc 1 0 0\nvc 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(
        collect(*openObj(path, kObjRoom)).colors,
        (std::vector<std::uint32_t>{0xFF0000FF, 0xFF00FF00, 0xFFFFFFFF, 0xFFFFFFFF, 0xFFFFFFFF}));
}

TEST_F(StreamedObj, RefusesWhatIsWrong) {
    for (const char* const text :
         {"v 0 0 0\nv 1 x 0\n",
          "v 0 0 0\nv 1 0\n",
          "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
          "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
          "v 0 0 0\nf 1 2 4\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n",
          "v 0 0 0\nvn 0 0 1\nf //1 //1 //1\n",
          "v 0 0 0\nf 0 1 1\n",
          "v 0 0 0\nf 1 1 99999999999\n",
          "v 0 0 0\nv 1 0 0\n",
          "g a\n",
          "v 0 0 0\nf 1 2 \\\n",
          "v 0 0 0\nf 1 1 1\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\nf 1 2 9\nf 1 2 8\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1 2 3\nf 1 9//1\n",
          "v 0 0 0\nv 1 0 0\nv +-0 1 0\nf 1 2 3\n"}) {
        EXPECT_NE(errorOf(text), "no error") << text;
        expectAlike(text);
    }
    for (const char* const good :
         {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 9//1\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//2 3\nf 1 9//-7\n",
          "v 0 0 inf\nv 1 0 0\nv 0 1 0\nv 1 1 -inf\nv 1 1 1\nf 2 3 5\n",
          "v 1e-46 -2.5e-320 0\nv 1e300 0 0\nv 0 1e-400 0\nf 1 2 3\n",
          "v 0 0 0 0 1 0x\nv 1 0 0 0 1 0x\nv 0 1 0 0 1 0x\nf 1 2 3\n",
          "v 0 0 0 0 1 inf\nv 1 0 0 0 1 inf\nv 0 1 0 0 1 inf\nf 1 2 3\n"}) {
        EXPECT_EQ(errorOf(good), "no error") << good;
        expectAlike(good);
    }
}

TEST_F(StreamedObj, ErrorsNameTheLine) {
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 x 0\n"), R"(:2: not a number: expected a number, found "x")");
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 0\n"), ":2: too few numbers: expected 3, found 2");
    EXPECT_EQ(
        errorOf("v 0 0 1e999\n"),
        R"(:1: the number is too large: expected at most 1.79e308, the maximum of a double, found "1e999")");
    EXPECT_EQ(errorOf("v 1 0 0\nv 0 0 nan\nv 0 1 0\nf 1 2 3\n"), ":2: a coordinate of vertex 1 is not finite");
    EXPECT_EQ(
        errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
        ":4: vertex index out of range: expected one of 3 vertices, found index 3 counted from 0");
    EXPECT_NE(errorOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n").find(":4: vertex index"), std::string::npos);
    EXPECT_NE(errorOf("v 0 0 0\nvn 0 0 1\nf //1 //1 //1\n").find(":3: bad corner"), std::string::npos);
    EXPECT_NE(errorOf("v 0 0 0\nf 0 1 1\n").find(":2: bad corner"), std::string::npos);
    EXPECT_NE(errorOf("v 0 0 0\nf 1 1 99999999999\n").find(":2: bad corner"), std::string::npos);
    EXPECT_EQ(errorOf("v 0 0 0\nv 1 0 0\n"), ": no faces: this is a point cloud; make a mesh of it first");
    EXPECT_EQ(errorOf(""), ": empty: it has no vertices and no faces");
    EXPECT_EQ(errorOf("\xFF\xFEv"), ": the text is in UTF-16; convert to UTF-8");
}

TEST_F(StreamedObj, NormalsThatAreNotFiniteAreDroppedAndCounted) {
    writeScratch(path, kCorners + "vn 0 0 1\nvn nan nan nan\nvn 1.#QNAN 0 0\nvn 1e400 0 0\nf 1//1 2//2 3//3\n");
    const auto source = openObj(path, kObjRoom);
    EXPECT_EQ(source->summary().attributesDropped.at("normals that are not finite"), 3U);
    const CollectedMesh mesh = collect(*source);
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0));
}

TEST_F(StreamedObj, NamesEachKindThatIsNotKept) {
    writeScratch(
        folder + "/a.mtl",
        "newmtl red\nKd 1 0 0\nKa 0 0 0\nKs 1 1 1\nmap_Kd a.png\nbump b.png\nnewmtl blue\nKd xyz 1 1 1\nKs 0 0 0\n"
        "newmtl unused\nNs 5\n");
    writeScratch(
        path,
        "mtllib a.mtl gone.mtl\no thing\ng part\ns 1\ns off\nv 0 0 0 2\nv 1 0 0 1\nv 1 1 0\nvt 0 0\nvt 1 1\nvp 1\n"
        "vn inf 0 0\nusemtl red\nf 1//1 2 3\nusemtl blue\nf 3 2 1\nusemtl lost\nl 1 2\np 1\ncall x.obj\nf 1 2\n");
    const std::map<std::string, std::uint64_t> expected = {
        {"free-form surfaces", 1},
        {"lines", 1},
        {"material Ka", 1},
        {"material Kd xyz", 1},
        {"material Ks", 2},
        {"material bump", 1},
        {"material libraries that are not there", 1},
        {"materials that no library has", 1},
        {"names of groups", 1},
        {"names of objects", 1},
        {"normals that are not finite", 1},
        {"lines of the unknown keyword call", 1},
        {"points", 1},
        {"smoothing groups", 1},
        {"texture coordinates", 2},
        {"textures", 1},
        {"weights of vertices", 1}};
    EXPECT_EQ(openObj(path, kObjRoom)->summary().attributesDropped, expected);
}

TEST_F(StreamedObj, ReadsTheOldKeywordOfFacesAndNamesUnknownKeywords) {
    writeScratch(path, kCorners + "fo 1 2 3\nfo 1//1 2 3\nvn 0 0 1\nf 3 2 1\n");
    EXPECT_EQ(collect(*openObj(path, kObjRoom)).triangles.size(), 3U);
    writeScratch(path, "V 0 0 0\n" + kCorners + "F 1 2 3\nF 1 2 3\nb\x01 1\n");
    EXPECT_EQ(
        errorAbout(path, [&] { openObj(path, kObjRoom); }),
        ": no faces: expected lines of the keyword f, found lines of unknown keywords: F V");
    writeScratch(path, kCorners + "F 1 2 3\nF 1 2 3\nb\x01 1\nf 1 2 3\n");
    EXPECT_EQ(
        openObj(path, kObjRoom)->summary().attributesDropped,
        (std::map<std::string, std::uint64_t>{{"lines of the unknown keyword F", 2}, {"other lines", 1}}));
    std::string many = kCorners + "f 1 2 3\n";
    for (int i = 0; i < 1000; ++i)
        many += "k" + std::to_string(i) + "\n";
    writeScratch(path, many);
    EXPECT_EQ(openObj(path, kObjRoom)->summary().attributesDropped.at("other lines"), 936U);
}

TEST_F(StreamedObj, SaysThatAWordIsTooLong) {
    const std::string digits(1000, '3');
    for (const std::string& line : {"v 1." + digits + " 0 0\n", "f 1 2 3" + digits + "\n"})
        for (const char* const end : {"", "\\\n\n"}) { // of a line that is in the window as it is, and of another
            writeScratch(path, kCorners + line + end + "f 1 2 3\n");
            const std::string message = errorAbout(path, [&] { openObj(path, kObjRoom); });
            EXPECT_NE(message.find(": a word is longer than 1000 characters"), std::string::npos) << message;
        }
    writeScratch(path, kCorners + "v 1." + digits.substr(2) + " 0 0\nf 1 2 4\n");
    EXPECT_EQ(collect(*openObj(path, kObjRoom)).positions.size(), 6U);
}

TEST_F(StreamedObj, IsRefusedWhereWhatIsHeldIsTooMuch) {
    std::string text = kCorners + "vn 0 0 1\n";
    for (int i = 0; i < 1000; ++i)
        text += "v 0 0 0\n";
    writeScratch(path, text + "f 1//1 2//1 3//1\n");
    EXPECT_NE(errorAbout(path, [&] { openObj(path, {1000}); }), "no error");
    writeScratch(path, text + "f 1 2 3\n");
    EXPECT_EQ(errorAbout(path, [&] { openObj(path, {1000}); }), "no error") << "of faces alone nothing is held";
}

std::string numberBelow(Random& random, std::uint64_t max) {
    return std::to_string(random.below(max));
}

std::string randomOther(Random& random) {
    constexpr std::array kOthers = {
        "usemtl red\n", "usemtl blue\n", "usemtl none\n", "vt 0 1\n", "# x\n", "\n", "g a b\n"};
    return kOthers.at(random.below(kOthers.size()));
}

/// A face of two to five corners, some counted from the end, some with normals.
std::string randomFace(Random& random, std::uint64_t vertices, std::uint64_t normals, bool isAligned) {
    std::string text = "f";
    for (std::uint64_t corners = 2 + random.below(4); corners > 0; --corners) {
        const std::uint64_t vertex = 1 + random.below(vertices);
        text += " " + (random.below(3) == 0 ? "-" + std::to_string(vertices + 1 - vertex) : std::to_string(vertex));
        if (isAligned && random.below(4) > 0) text += "//" + std::to_string(vertex);
        if (!isAligned && random.below(2) == 0) text += "/1/" + std::to_string(1 + random.below(normals + 2));
    }
    return text + (random.below(8) == 0 ? " \\\n\n" : "\n");
}

/// A file of random lines, most of them good.
std::string randomObj(Random& random) {
    std::string text = random.below(2) == 0 ? "mtllib a.mtl\n" : "";
    const bool isVivid = random.below(4) == 0;
    const bool isAligned = random.below(3) == 0;
    std::uint64_t vertices = 0;
    std::uint64_t normals = 0;
    for (int line = 0; line < 60; ++line) {
        const std::uint64_t kind = random.below(10);
        if (vertices < 3 || kind < 2) {
            text += "v " + numberBelow(random, 9) + " " + numberBelow(random, 9) + ".5 -" + numberBelow(random, 3) +
                    (isVivid ? " 0.5 0 1" : "") + "\n";
            ++vertices;
        } else if (kind < 4) {
            text += "vn " + numberBelow(random, 2) + " " + numberBelow(random, 2) + " " + numberBelow(random, 2) + "\n";
            ++normals;
        } else {
            text += kind == 4 ? randomOther(random) : randomFace(random, vertices, normals, isAligned);
        }
    }
    return text;
}

TEST_F(StreamedObj, RandomFilesAreTheSameMesh) {
    writeScratch(folder + "/a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    materials = {{"red", 0xFF0000FF}, {"blue", 0xFFFF0000}};
    for (std::uint64_t seed = 0; seed < 1500 && !HasFatalFailure(); ++seed) {
        Random random(seed);
        expectAlike(randomObj(random));
    }
}

TEST_F(StreamedObj, MutatedFilesAreTheSameMeshOrRefused) {
    for (std::uint64_t seed = 0; seed < 1500 && !HasFatalFailure(); ++seed) {
        Random random(seed);
        std::string text = kCorners + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3/1/2\nf 1 2 3 4\nf -1 -2 -3\n";
        if (random.below(4) == 0) text.resize(random.below(text.size()));
        for (std::uint64_t n = 1 + random.below(3); n > 0 && !text.empty(); --n)
            text[random.below(text.size())] = "/ -0.9\n#1\\f"[random.below(11)];
        expectAlike(text);
    }
}

TEST_F(StreamedObj, LongFilesAreReadInStretchesThatArePassedOver) {
    std::string text;
    for (int i = 0; i < 120'000; ++i)
        text += "v " + std::to_string(i) + " " + std::to_string(i % 7) + " 0\n";
    for (int i = 0; i < 60'000; ++i)
        text += "vn 0 " + std::to_string(i % 3) + " 1\n";
    for (int i = 1; i < 120'000; ++i)
        text += "f " + std::to_string(i) + "//" + std::to_string(1 + i / 2) + " -3 " + std::to_string(i + 1) + "\n";
    text += "v 5 5 5\n" + std::string(5 << 20, ' ') + "f 1 2 -1\n"; // a line that no buffer holds
    expectAlike(text);
    const InputFile file(path);
    ObjMaterials none(path, "");
    ObjSurvey survey;
    ObjLine line;
    for (ObjLines lines(file, none, survey); lines.next(line);) {
    }
    ASSERT_GT(survey.stretches.size(), 4U);
    EXPECT_EQ(survey.stretches.front().kinds, kindBit(ObjKind::Vertex));
    std::uint64_t faces = 0;
    for (ObjLines lines(file, none, survey, kindBit(ObjKind::Face)); lines.next(line); ++faces)
        ASSERT_EQ(line.kind, ObjKind::Face);
    EXPECT_EQ(faces, 120'000U);
    EXPECT_LT(openObj(path, kObjRoom)->summary().heldBytes, text.size() / 4);
}

TEST(ObjFiles, RealOnesAreThoseOfAPlainReading) {
    const char* given = std::getenv("GNOMON_MODELS");
    const std::string files =
        (given != nullptr ? given : GNOMON_SOURCE_DIR "/../shared/models") + std::string("/formats/obj/");
    if (!std::filesystem::exists(files)) GTEST_SKIP() << "no files in " << files << " (set GNOMON_MODELS)";
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(files)) {
        if (entry.path().extension() != ".obj") continue;
        const std::string file = entry.path().string();
        std::ifstream stream(file);
        const std::optional<PlainMesh> plain =
            PlainObj({}).read({std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
        ASSERT_TRUE(plain) << file;
        const CollectedMesh mesh = collect(*openObj(file, kObjRoom));
        ASSERT_EQ(mesh.triangles.size() * 3, plain->corners.size()) << file;
        for (std::size_t i = 0; i < plain->corners.size(); ++i) {
            const glm::dvec3& p = mesh.positions[mesh.triangles[i / 3][i % 3]];
            ASSERT_EQ(
                p,
                glm::dvec3(
                    std::get<0>(plain->corners[i]), std::get<1>(plain->corners[i]), std::get<2>(plain->corners[i])))
                << file;
        }
        EXPECT_EQ(mesh.notAPolygon, plain->notAPolygon) << file;
        ++count;
    }
    EXPECT_EQ(count, 6);
}

} // namespace
} // namespace gnomon::read
