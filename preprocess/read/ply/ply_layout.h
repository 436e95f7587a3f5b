// Finds the roles of the elements and properties of a PLY header.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <optional>
#include <set>

namespace gnomon::read {

enum class Role { Other, Vertices, Faces, Strips };

constexpr const char* kFaceColors = "face colours";

/// Returns the index of the property that lists the corners of a face or strip. Returns -1 if there is none.
int indexListOf(const PlyElement& element);

/// Returns the role of `element`. Its name and its list of corners determine the role.
Role roleOf(const PlyElement& element);

/// Returns which properties contain the positions, normals and colours of vertices.
VertexLayout vertexLayoutOf(const PlyElement& element);

/// The indices of the properties red, green, blue and alpha of a vertex or face; -1 for a missing alpha.
using ColorLayout = std::array<int, 4>;

/// Returns the colour properties of `element`. The function tries the names red, diffuse_red, r and color_red in this
/// order, in upper or lower case. It uses the first name for which red, green and blue exist. Returns nullopt if there
/// are no colours.
std::optional<ColorLayout> colorLayoutOf(const PlyElement& element);

/// Returns true if the range of the colours depends on their max values, because a channel has more than one byte.
bool needsMaxima(const PlyElement& element, const ColorLayout& colors);

/// The range of the numbers of a colour.
struct ColorRule {
    std::array<double, 4> full{255, 255, 255, 255}; ///< value of full intensity per channel
    std::string remark; ///< note on the range for the user; empty for 8-bit properties called red, green and blue
};

/// Returns the range of colours whose channels have the max values `maxima`. For real numbers, full intensity is 1, or
/// 255 if a number exceeds 1. For integers, full intensity is 255, or 65535 if a number exceeds 255, or the max value
/// of the type if a number exceeds 65535.
ColorRule colorRuleOf(const PlyElement& element, const ColorLayout& colors, const std::array<double, 4>& maxima);

/// Returns names for the data of `element` that are not read. `fields` are vertex properties that are read in addition.
std::set<std::string> droppedNames(const PlyElement& element, Role role, const std::vector<std::string>& fields);

/// Returns the indices of the vertex properties that can be fields: numbers that do not belong to positions, normals or
/// colours.
std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout);

/// Returns the names of the properties `fields`, as the list of expected values in an error message.
std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields);

} // namespace gnomon::read
