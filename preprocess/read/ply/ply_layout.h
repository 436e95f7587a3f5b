// The roles of the elements and properties of a PLY header.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <optional>
#include <set>

namespace gnomon::read {

enum class Role { Other, Vertices, Faces, Strips };

constexpr const char* kFaceColors = "face colours";

/// Returns the index of the property with the corners of a face or strip, or -1.
int indexListOf(const PlyElement& element);

/// Returns the role of `element`, by its name and by its list of corners.
Role roleOf(const PlyElement& element);

/// Returns the properties that contain the positions, normals and colours of vertices.
VertexLayout vertexLayoutOf(const PlyElement& element);

/// The indices of the properties red, green, blue and alpha of a vertex or face; -1 for a missing alpha.
using ColorLayout = std::array<int, 4>;

/// Returns the colour properties of `element`. Tries the names red, diffuse_red, r and color_red in this order, in any
/// case, and uses the first with red, green and blue. Returns nothing if there are no colours.
std::optional<ColorLayout> colorLayoutOf(const PlyElement& element);

/// Returns whether the range of the colours depends on their maxima, because a channel has more than one byte.
bool needsMaxima(const PlyElement& element, const ColorLayout& colors);

/// The range of the numbers of a colour.
struct ColorRule {
    std::array<double, 4> full{255, 255, 255, 255}; ///< value of full intensity per channel
    std::string remark; ///< the range in words, for the user; empty for 8-bit properties called red, green and blue
};

/// Returns the range of colours whose channels have the maxima `maxima`. Real numbers range to 1, or to 255 if one
/// exceeds 1. Integers range to 255, to 65535 if one exceeds 255, and to the maximum of their type if one exceeds
/// 65535.
ColorRule colorRuleOf(const PlyElement& element, const ColorLayout& colors, const std::array<double, 4>& maxima);

/// Returns names for the data of `element` that is not read. `fields` are vertex properties that are read in addition.
std::set<std::string> droppedNames(const PlyElement& element, Role role, const std::vector<std::string>& fields);

/// Returns the indices of the vertex properties that can be fields: numbers that are not part of positions, normals or
/// colours.
std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout);

/// Returns the names of the properties `fields`, as the expected value of a message.
std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields);

} // namespace gnomon::read
