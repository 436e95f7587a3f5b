// What the elements and properties of a PLY header are to the reader.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <optional>
#include <set>

namespace gnomon::read {

enum class Role { Other, Vertices, Faces, Strips };

constexpr const char* kFaceColors = "face colours";

/// The property with the corners of a face or strip, -1 for none.
int indexListOf(const PlyElement& element);

Role roleOf(const PlyElement& element);

VertexLayout vertexLayoutOf(const PlyElement& element);

/// The properties of a vertex or a face that hold red, green, blue and alpha; -1 for an alpha that is not there.
using ColorLayout = std::array<int, 4>;

/// Returns the colours of an element under the first name that all three channels have: red, diffuse_red, r or
/// color_red, in any case. Nothing for an element without colours.
std::optional<ColorLayout> colorLayoutOf(const PlyElement& element);

/// Returns whether the range of these colours depends on their maxima.
bool needsMaxima(const PlyElement& element, const ColorLayout& colors);

/// How the numbers of a colour are understood.
struct ColorRule {
    std::array<double, 4> full{255, 255, 255, 255}; ///< the value of a full channel
    std::string remark;                             ///< the rule in words; empty for uchars called red, green and blue
};

/// Returns the rule for colours whose channels have the given maxima. Real numbers range to 1, or to 255 if one exceeds
/// 1. Integers range to 255, or to 65535 and then to the maximum of their type if one exceeds that.
ColorRule colorRuleOf(const PlyElement& element, const ColorLayout& colors, const std::array<double, 4>& maxima);

/// Returns what is not kept of an element, in words, beside the properties of vertices that are `fields`.
std::set<std::string> droppedNames(const PlyElement& element, Role role, const std::vector<std::string>& fields);

/// The properties of vertices that can be fields: numbers that nothing else is made of.
std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout);

/// Their names, for a message.
std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields);

} // namespace gnomon::read
