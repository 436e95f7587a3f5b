#include "tests/make/made_mesh.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

namespace gnomon::make {

namespace {

class MemorySink final : public MeshSink {
public:
    explicit MemorySink(MadeMesh& mesh) : mesh_(mesh) {}

    void addVertices(std::span<const glm::vec3> positions) override {
        mesh_.vertices.insert(mesh_.vertices.end(), positions.begin(), positions.end());
    }

    void addTriangles(std::span<const MadeTriangle> triangles) override {
        mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
    }

private:
    MadeMesh& mesh_;
};

} // namespace

MadeMesh collect(const MadeModel& model) {
    MadeMesh mesh;
    MemorySink sink(mesh);
    for (std::size_t block = 0; block < model.blockCount(); ++block)
        model.makeBlock(block, mesh.vertices.size(), sink);
    return mesh;
}

MadeMesh welded(const MadeMesh& mesh) {
    std::map<std::tuple<float, float, float>, std::uint64_t> ids;
    MadeMesh result;
    std::vector<std::uint64_t> idOf;
    for (const glm::vec3& p : mesh.vertices) {
        const auto [entry, isNew] = ids.emplace(std::tuple(p.x, p.y, p.z), result.vertices.size());
        if (isNew) result.vertices.push_back(p);
        idOf.push_back(entry->second);
    }
    for (const MadeTriangle& t : mesh.triangles)
        result.triangles.push_back({idOf.at(t[0]), idOf.at(t[1]), idOf.at(t[2])});
    return result;
}

std::map<std::pair<std::uint64_t, std::uint64_t>, EdgeUse> edgeUses(const MadeMesh& mesh) {
    std::map<std::pair<std::uint64_t, std::uint64_t>, EdgeUse> uses;
    for (const MadeTriangle& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint64_t a = t.at(i);
            const std::uint64_t b = t.at((i + 1) % 3);
            EdgeUse& use = uses[std::minmax(a, b)];
            ++(a < b ? use.upwards : use.downwards);
        }
    return uses;
}

std::uint64_t componentCount(const MadeMesh& mesh) {
    std::vector<std::uint64_t> parent(mesh.vertices.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::uint64_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const MadeTriangle& t : mesh.triangles) {
        parent[root(t[1])] = root(t[0]);
        parent[root(t[2])] = root(t[0]);
    }
    std::set<std::uint64_t> roots;
    for (const MadeTriangle& t : mesh.triangles)
        roots.insert(root(t[0]));
    return roots.size();
}

std::uint64_t doubledCount(const MadeMesh& mesh) {
    std::set<MadeTriangle> seen;
    std::uint64_t doubled = 0;
    for (MadeTriangle t : mesh.triangles) {
        std::sort(t.begin(), t.end());
        if (!seen.insert(t).second) ++doubled;
    }
    return doubled;
}

double area(const MadeMesh& mesh, const MadeTriangle& triangle) {
    const glm::dvec3 a(mesh.vertices.at(triangle[0]));
    const glm::dvec3 b(mesh.vertices.at(triangle[1]));
    const glm::dvec3 c(mesh.vertices.at(triangle[2]));
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double meanEdge(const MadeMesh& mesh) {
    double sum = 0;
    for (const MadeTriangle& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            sum += static_cast<double>(glm::distance(mesh.vertices.at(t.at(i)), mesh.vertices.at(t.at((i + 1) % 3))));
    return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

} // namespace gnomon::make
