// Finds out which elements and properties of a PLY file contain vertices, faces, normals and colours.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <optional>
#include <set>

namespace gnomon::read {

enum class Role { Other, Vertices, Faces, Strips };

constexpr const char* kFaceColors = "face colours";

/// Returns the index of the list property that contains the vertex indices of a face or strip. Returns -1 if the
/// element has no such property.
int indexListOf(const PlyElement& element);

/// Returns what `element` contains, for example vertices or faces. The result depends on its name and on its list of
/// vertex indices.
Role roleOf(const PlyElement& element);

/// Returns which properties of `element` contain the positions, normals and colours of vertices.
VertexLayout vertexLayoutOf(const PlyElement& element);

/// The property indices of red, green, blue and alpha of a vertex or face. The index of a missing alpha is -1.
using ColorLayout = std::array<int, 4>;

/// Returns which properties of `element` contain colours. The function tries the names red, diffuse_red, r and
/// color_red in this order, in upper or lower case. It uses the first name for which red, green and blue exist. Returns
/// nullopt if there are no colours.
std::optional<ColorLayout> colorLayoutOf(const PlyElement& element);

/// Returns true if a colour channel has more than one byte. Its max value in the file then determines its numeric
/// range.
bool needsMaxima(const PlyElement& element, const ColorLayout& colors);

/// The numeric range of a file's colour channels.
struct ColorRule {
    std::array<double, 4> full{255, 255, 255, 255}; ///< per channel: the value that means full intensity
    std::string remark; ///< note for the user on the range; empty for 8-bit properties called red, green and blue
};

/// Returns the numeric range of colours. `maxima` are the max values of the channels in the file. For real numbers,
/// full intensity is 1, or 255 if a number exceeds 1. For integers, full intensity is 255, or 65535 if a number exceeds
/// 255, or the max value of the type if a number exceeds 65535.
ColorRule colorRuleOf(const PlyElement& element, const ColorLayout& colors, const std::array<double, 4>& maxima);

/// Returns names, for the user, of the data of `element` that a build does not read. `fields` are the scalar vertex
/// properties that it reads.
std::set<std::string> droppedNames(const PlyElement& element, Role role, const std::vector<std::string>& fields);

/// Returns the indices of the scalar vertex properties that do not belong to positions, normals or colours. A build can
/// read these properties as fields.
std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout);

/// Returns the names of the properties with the indices `fields`, as a list for an error message.
std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields);

} // namespace gnomon::read
