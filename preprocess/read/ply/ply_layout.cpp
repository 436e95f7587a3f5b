#include "preprocess/read/ply/ply_layout.h"

#include <algorithm>
#include <array>

namespace gnomon::read {

int indexListOf(const PlyElement& element) {
    const int list = element.indexOf("vertex_indices", "vertex_index");
    return list >= 0 && element.properties[static_cast<std::size_t>(list)].isList ? list : -1;
}

Role roleOf(const PlyElement& element) {
    if (element.name == "vertex") return Role::Vertices;
    if (element.name == "face" && indexListOf(element) >= 0) return Role::Faces;
    if (element.name == "tristrips" && indexListOf(element) >= 0) return Role::Strips;
    return Role::Other;
}

VertexLayout vertexLayoutOf(const PlyElement& element) {
    constexpr std::array<std::array<const char*, 2>, kVertexSlots> kNames = {
        {{"x", ""},
         {"y", ""},
         {"z", ""},
         {"nx", ""},
         {"ny", ""},
         {"nz", ""},
         {"red", "diffuse_red"},
         {"green", "diffuse_green"},
         {"blue", "diffuse_blue"},
         {"alpha", "diffuse_alpha"}}};
    VertexLayout layout;
    for (std::size_t slot = 0; slot < kVertexSlots; ++slot) {
        int found = element.indexOf(kNames[slot][0], kNames[slot][1]);
        if (found >= 0 && element.properties[static_cast<std::size_t>(found)].isList) found = -1;
        layout.property[slot] = found;
        const PlyType type = found >= 0 ? element.properties[static_cast<std::size_t>(found)].type : PlyType::Float32;
        if (slot < kNormal)
            layout.isDouble |= type == PlyType::Float64 || type == PlyType::Int32 || type == PlyType::Uint32;
    }
    layout.hasNormals = layout.has(kNormal, 3);
    layout.hasColors = layout.has(kColor, 3);
    return layout;
}

std::string droppedName(const PlyElement& element, Role role, const std::string& property) {
    constexpr std::array kKept = {"x", "y", "z", "nx", "ny", "nz", "vertex_indices", "vertex_index"};
    constexpr std::array kColors = {"red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue"};
    constexpr std::array kTexture = {"s", "t", "u", "v", "texture_u", "texture_v", "texcoord", "texnumber"};
    const auto isOneOf = [&](const auto& names) {
        return std::find(names.begin(), names.end(), property) != names.end();
    };
    if (role == Role::Other) return "element " + element.name;
    if (isOneOf(kKept)) return {};
    if (isOneOf(kTexture)) return "texture coordinates";
    if (property == "alpha" || property == "diffuse_alpha") return "alpha";
    if (isOneOf(kColors)) return role == Role::Vertices ? "" : kFaceColors;
    return element.name + " " + property;
}

std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout) {
    std::vector<std::size_t> fields;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const auto slot = std::ranges::find(layout.property, static_cast<int>(i));
        const bool isKept = slot != layout.property.end() &&
                            (slot < layout.property.begin() + kNormal ||
                             (slot < layout.property.begin() + kColor ? layout.hasNormals : layout.hasColors));
        if (!element.properties[i].isList && !isKept) fields.push_back(i);
    }
    return fields;
}

std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields) {
    std::string list = fields.empty() ? "none, since vertices have no other numbers" : "one of ";
    for (std::size_t i = 0; i < fields.size(); ++i)
        list += (i > 0 ? ", " : "") + element.properties[fields[i]].name;
    return list;
}

} // namespace gnomon::read
