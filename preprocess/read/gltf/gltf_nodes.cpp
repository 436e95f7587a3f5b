#include "preprocess/read/gltf/gltf_nodes.h"

#include "core/angle.h"
#include "core/error.h"
#include "preprocess/read/gltf/gltf_accessor.h"
#include "preprocess/read/gltf/gltf_document.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace gnomon::read {

namespace {

/// Returns the rotation matrix of the quaternion (x, y, z, w), which can have any length above 0. Returns the identity
/// for length 0.
glm::dmat4 turnedBy(const glm::dvec4& rotation) {
    const glm::dvec4 sizes = glm::abs(rotation);
    const glm::dvec4 scaled = rotation * scaleToOne(std::max({sizes.x, sizes.y, sizes.z, sizes.w}));
    const double length = glm::length(scaled);
    if (length == 0) return glm::dmat4(1);
    const glm::dvec4 unit = scaled / length;
    return glm::mat4_cast(glm::dquat(unit.w, unit.x, unit.y, unit.z));
}

/// Returns the vector `axis` scaled to unit length. The result is not finite if the length of `axis` is 0.
glm::dvec3 unitOf(const glm::dvec3& axis) {
    const glm::dvec3 sizes = glm::abs(axis);
    return glm::normalize(axis * scaleToOne(std::max({sizes.x, sizes.y, sizes.z})));
}

/// Returns the matrix that first scales, then rotates, and then translates a point.
glm::dmat4 placed(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
    glm::dmat4 matrix = turnedBy(rotation);
    for (int i = 0; i < 3; ++i)
        matrix[i] *= scale[i];
    matrix[3] = glm::dvec4(translation, 1);
    return matrix;
}

/// Converts a number of a glTF extension to an accessor index. Returns -1, which means no accessor, if the number is
/// negative or too large for an int. The conversion is necessary because tinygltf does not check numbers of extensions.
int accessorOf(const tinygltf::Value& number) {
    const double value = number.GetNumberAsDouble();
    return value >= 0 && value <= std::numeric_limits<int>::max() ? static_cast<int>(value) : -1;
}

/// Returns the values of one instance attribute of the glTF extension EXT_mesh_gpu_instancing, with `components`
/// numbers per instance. Returns an empty list if the attribute is missing. `count` is the number of instances, or 0 if
/// it is not known yet. Throws Error if attributes have different numbers of instances.
std::vector<float> instanceValues(
    GltfFile& file, const tinygltf::Value& attributes, const char* name, std::size_t components, std::uint64_t& count) {
    if (!attributes.IsObject() || !attributes.Has(name) || !attributes.Get(name).IsNumber()) return {};
    std::vector<float> values = numbersOf(file, accessorOf(attributes.Get(name)), components);
    const std::uint64_t found = values.size() / components;
    if (count > 0 && found != count)
        throw Error(
            file.path(),
            "the instances have different numbers of values",
            std::to_string(count) + " of each kind",
            std::to_string(found));
    count = found;
    return values;
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

/// Returns the number in the member `key` of the JSON object `object`, or 0 if there is none.
double memberNumber(const nlohmann::json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number()) return 0;
    return object[key].get<double>();
}

/// Returns the camera that the glTF JSON object `described` defines, placed by the transform `toWorld`. Returns nullopt
/// if glTF does not define such a camera, or if an axis of the transform has zero length.
std::optional<Camera> cameraAt(const nlohmann::json& described, const glm::dmat4& toWorld) {
    Camera camera;
    const glm::dvec3 ahead = unitOf(-glm::dvec3(toWorld[2]));
    camera.eye = glm::dvec3(toWorld[3]);
    camera.up = unitOf(glm::dvec3(toWorld[1]));
    double distance = 1;
    const std::string type = textOf(described, "type");
    if (type == "perspective" && described.contains(type)) {
        camera.fovYRadians = memberNumber(described[type], "yfov");
    } else if (type == "orthographic" && described.contains(type)) {
        camera.projection = Projection::Orthographic;
        camera.fovYRadians = kPi / 3;
        // The vertical field of view is 60 degrees. The tangent of half of this angle is 1 / sqrt(3).
        distance = std::sqrt(3.0) * memberNumber(described[type], "ymag");
    } else {
        return std::nullopt;
    }
    camera.target = camera.eye + distance * ahead;
    const double turned = glm::length(glm::cross(ahead, camera.up)); // not finite if one of the axes is not finite
    const bool hasView =
        distance > 0 && turned > 1e-9 && std::isfinite(glm::length(camera.target)) && camera.target != camera.eye;
    const bool hasAngle = camera.fovYRadians > 0 && camera.fovYRadians < kPi;
    return hasView && hasAngle ? std::optional(camera) : std::nullopt;
}

class SceneReader {
public:
    explicit SceneReader(GltfFile& file) : file_(file), isVisited_(file.model().nodes.size(), false) {}

    GltfScene read() && {
        push(rootsOf(file_), glm::dmat4(1));
        while (!open_.empty()) {
            const Visit visit = open_.back();
            open_.pop_back();
            const tinygltf::Node& node = file_.elementOf(file_.model().nodes, visit.node, "node");
            visitNode(visit.node);
            const glm::dmat4 toWorld = visit.toWorld * toParent(node, visit.node);
            if (node.mesh >= 0) {
                file_.elementOf(file_.model().meshes, node.mesh, "mesh");
                for (const glm::dmat4& instance : instancesOf(node))
                    scene_.meshes.push_back({node.mesh, toWorld * instance});
            }
            if (node.camera >= 0) addCamera(node.camera, toWorld);
            push(node.children, toWorld);
        }
        takeCameras();
        count(
            "nodes of other scenes",
            static_cast<std::uint64_t>(std::count(isVisited_.begin(), isVisited_.end(), false)));
        return std::move(scene_);
    }

private:
    struct Visit {
        int node;
        glm::dmat4 toWorld; // transform from the parent's space to world space
    };

    struct NodeCamera {
        int index; // index in the glTF file's list of cameras
        Camera camera;
    };

    void push(const std::vector<int>& nodes, const glm::dmat4& toWorld) {
        for (std::size_t i = nodes.size(); i-- > 0;)
            open_.push_back({nodes[i], toWorld});
    }

    void visitNode(int node) {
        if (isVisited_[static_cast<std::size_t>(node)])
            throw Error(
                file_.where("node", static_cast<std::uint64_t>(node)),
                "the nodes are not a tree",
                "one parent per node",
                "a cycle or a second parent");
        isVisited_[static_cast<std::size_t>(node)] = true;
    }

    void count(const std::string& name, std::uint64_t number) {
        if (number > 0) scene_.rejected[name] += number;
    }

    glm::dmat4 toParent(const tinygltf::Node& node, int index) {
        if (!node.matrix.empty()) {
            requireNumbers(node.matrix, 16, "matrix", index);
            glm::dmat4 matrix{};
            for (int i = 0; i < 16; ++i)
                matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
            return matrix;
        }
        const auto& t = node.translation;
        const auto& r = node.rotation;
        const auto& s = node.scale;
        requireNumbers(t, 3, "translation", index);
        requireNumbers(r, 4, "rotation", index);
        requireNumbers(s, 3, "scale", index);
        const glm::dvec4 rotation = r.empty() ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(r[0], r[1], r[2], r[3]);
        countRotation(rotation);
        return placed(
            t.empty() ? glm::dvec3(0) : glm::dvec3(t[0], t[1], t[2]),
            rotation,
            s.empty() ? glm::dvec3(1) : glm::dvec3(s[0], s[1], s[2]));
    }

    /// Throws Error if the list `name` of node `node` exists but does not have `expected` numbers.
    void requireNumbers(const std::vector<double>& list, std::size_t expected, const char* name, int node) const {
        if (list.empty() || list.size() == expected) return;
        throw Error(
            file_.where("node", static_cast<std::uint64_t>(node)),
            std::string("its ") + name + " cannot be understood",
            std::to_string(expected) + " numbers",
            std::to_string(list.size()));
    }

    void countRotation(const glm::dvec4& rotation) {
        if (rotation == glm::dvec4(0)) count("rotations of length 0", 1);
    }

    /// Returns one transform per instance of the node's mesh, from the space of the mesh to the space of the node.
    std::vector<glm::dmat4> instancesOf(const tinygltf::Node& node) {
        const auto found = node.extensions.find("EXT_mesh_gpu_instancing");
        if (found == node.extensions.end() || !found->second.IsObject()) return {glm::dmat4(1)};
        const tinygltf::Value& attributes = found->second.Get("attributes");
        std::uint64_t instanceCount = 0;
        const std::vector<float> t = instanceValues(file_, attributes, "TRANSLATION", 3, instanceCount);
        const std::vector<float> r = instanceValues(file_, attributes, "ROTATION", 4, instanceCount);
        const std::vector<float> s = instanceValues(file_, attributes, "SCALE", 3, instanceCount);
        if (instanceCount == 0)
            throw Error(
                file_.path(),
                "the instances have no transformation",
                "TRANSLATION, ROTATION or SCALE of EXT_mesh_gpu_instancing",
                "none");
        for (const std::string& name : attributes.Keys())
            if (name != "TRANSLATION" && name != "ROTATION" && name != "SCALE") count(name, instanceCount);
        file_.room().take(instanceCount, sizeof(glm::dmat4) + sizeof(PlacedMesh));
        std::vector<glm::dmat4> instances;
        instances.reserve(instanceCount);
        for (std::size_t i = 0; i < instanceCount; ++i) {
            const glm::dvec4 rotation =
                r.empty() ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(r[4 * i], r[4 * i + 1], r[4 * i + 2], r[4 * i + 3]);
            countRotation(rotation);
            instances.push_back(placed(
                t.empty() ? glm::dvec3(0) : glm::dvec3(t[3 * i], t[3 * i + 1], t[3 * i + 2]),
                rotation,
                s.empty() ? glm::dvec3(1) : glm::dvec3(s[3 * i], s[3 * i + 1], s[3 * i + 2])));
        }
        return instances;
    }

    void addCamera(int index, const glm::dmat4& toWorld) {
        if (static_cast<std::size_t>(index) >= file_.cameras().size()) return;
        if (const auto camera = cameraAt(file_.cameras()[static_cast<std::size_t>(index)], toWorld))
            cameras_.push_back({index, *camera});
    }

    /// Sorts the cameras of the scene's nodes in the order of the glTF file's list of cameras. Counts the cameras of
    /// this list that no node of the scene uses.
    void takeCameras() {
        std::stable_sort(cameras_.begin(), cameras_.end(), [](const NodeCamera& a, const NodeCamera& b) {
            return a.index < b.index;
        });
        std::set<int> indices;
        for (const NodeCamera& found : cameras_) {
            scene_.cameras.push_back(found.camera);
            indices.insert(found.index);
        }
        count("cameras", file_.cameras().size() - indices.size());
    }

    GltfFile& file_;
    GltfScene scene_;
    std::vector<Visit> open_;
    std::vector<bool> isVisited_;
    std::vector<NodeCamera> cameras_;
};

} // namespace

GltfScene sceneOf(GltfFile& file) {
    return SceneReader(file).read();
}

} // namespace gnomon::read
