#include "preprocess/read/gltf/gltf_nodes.h"

#include "core/error.h"
#include "preprocess/read/gltf/gltf_accessor.h"

#include <glm/gtc/quaternion.hpp>

#include <limits>

namespace gnomon::read {

namespace {

/// Moved, turned and scaled, scaled first; the quaternion as x, y, z, w.
glm::dmat4 placed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
    const glm::dquat turn(rotation.w, rotation.x, rotation.y, rotation.z);
    glm::dmat4 matrix = glm::mat4_cast(turn);
    for (int i = 0; i < 3; ++i)
        matrix[i] *= scale[i];
    matrix[3] = glm::dvec4(translation, 1);
    return matrix;
}

glm::dmat4 toParent(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::dmat4 matrix{};
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    const auto& t = node.translation;
    const auto& r = node.rotation;
    const auto& s = node.scale;
    return placed(
        t.size() == 3 ? glm::dvec3(t[0], t[1], t[2]) : glm::dvec3(0),
        r.size() == 4 ? glm::dvec4(r[0], r[1], r[2], r[3]) : glm::dvec4(0, 0, 0, 1),
        s.size() == 3 ? glm::dvec3(s[0], s[1], s[2]) : glm::dvec3(1));
}

/// The accessor that a number of an extension names, which the library leaves as it is in the file; -1, which is none,
/// for what no int can be.
int accessorOf(const tinygltf::Value& number) {
    const double value = number.GetNumberAsDouble();
    return value >= 0 && value <= std::numeric_limits<int>::max() ? static_cast<int>(value) : -1;
}

/// An attribute of EXT_mesh_gpu_instancing, one value an instance; empty where it is not given.
std::vector<float> instanceValues(
    GltfFile& file, const tinygltf::Value& attributes, const char* name, std::size_t components, std::uint64_t& count) {
    if (!attributes.IsObject() || !attributes.Has(name) || !attributes.Get(name).IsNumber()) return {};
    std::vector<float> values = numbersOf(file, accessorOf(attributes.Get(name)), components);
    const std::uint64_t found = values.size() / components;
    if (count > 0 && found != count)
        throw Error(
            file.path(),
            "instances with values missing",
            std::to_string(count) + " of each kind",
            std::to_string(found));
    count = found;
    return values;
}

/// Where instances of a mesh stand, in the space of its node.
std::vector<glm::dmat4> instancesOf(GltfFile& file, const tinygltf::Node& node) {
    const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
    if (found == node.extensions.end() || !found->second.IsObject()) return {glm::dmat4(1)};
    const tinygltf::Value& attributes = found->second.Get("attributes");
    std::uint64_t count = 0;
    const std::vector<float> t = instanceValues(file, attributes, "TRANSLATION", 3, count);
    const std::vector<float> r = instanceValues(file, attributes, "ROTATION", 4, count);
    const std::vector<float> s = instanceValues(file, attributes, "SCALE", 3, count);
    if (count == 0)
        throw Error(
            file.path(),
            "instances without places",
            "TRANSLATION, ROTATION or SCALE of EXT_mesh_gpu_instancing",
            "none");
    file.room().take(count, sizeof(glm::dmat4) + sizeof(PlacedMesh));
    std::vector<glm::dmat4> instances;
    instances.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        instances.push_back(placed(
            t.empty() ? glm::dvec3(0) : glm::dvec3(t[3 * i], t[3 * i + 1], t[3 * i + 2]),
            r.empty() ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]),
            s.empty() ? glm::dvec3(1) : glm::dvec3(s[3 * i], s[3 * i + 1], s[3 * i + 2])));
    return instances;
}

std::vector<int> rootsOf(const GltfFile& file) {
    const tinygltf::Model& model = file.model();
    if (!model.scenes.empty()) {
        const int scene = model.defaultScene < 0 ? 0 : model.defaultScene;
        return file.elementOf(model.scenes, scene, "scene").nodes;
    }
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
        for (const int child : node.children)
            if (child >= 0 && child < static_cast<int>(isChild.size())) isChild[static_cast<std::size_t>(child)] = true;
    std::vector<int> roots;
    for (std::size_t i = 0; i < isChild.size(); ++i)
        if (!isChild[i]) roots.push_back(static_cast<int>(i));
    return roots;
}

} // namespace

std::vector<PlacedMesh> placedMeshes(GltfFile& file) {
    struct Visit {
        int node;
        glm::dmat4 toWorld; // of its parent
    };

    std::vector<Visit> open;
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& toWorld) {
        for (std::size_t i = nodes.size(); i-- > 0;)
            open.push_back({nodes[i], toWorld});
    };
    push(rootsOf(file), glm::dmat4(1));
    std::vector<bool> isMet(file.model().nodes.size(), false);
    std::vector<PlacedMesh> placedOnes;
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const tinygltf::Node& node = file.elementOf(file.model().nodes, visit.node, "node");
        if (isMet[static_cast<std::size_t>(visit.node)])
            throw Error(
                file.where("node", static_cast<std::uint64_t>(visit.node)),
                "nodes that are no tree",
                "one way to each node",
                "a cycle, or a second parent");
        isMet[static_cast<std::size_t>(visit.node)] = true;
        const glm::dmat4 toWorld = visit.toWorld * toParent(node);
        if (node.mesh >= 0) {
            file.elementOf(file.model().meshes, node.mesh, "mesh");
            for (const glm::dmat4& instance : instancesOf(file, node))
                placedOnes.push_back({node.mesh, toWorld * instance});
        }
        push(node.children, toWorld);
    }
    return placedOnes;
}

} // namespace gnomon::read
