// What the elements and properties of a PLY header are to the reader.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

namespace gnomon::read {

enum class Role { Other, Vertices, Faces, Strips };

constexpr const char* kFaceColors = "face colours";

/// The property with the corners of a face or strip, -1 for none.
int indexListOf(const PlyElement& element);

Role roleOf(const PlyElement& element);

VertexLayout vertexLayoutOf(const PlyElement& element);

/// What is not kept of an element's property, in words; empty if it is kept.
std::string droppedName(const PlyElement& element, Role role, const std::string& property);

/// The properties of vertices that can be fields: numbers that nothing else is made of.
std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout);

/// Their names, for a message.
std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields);

} // namespace gnomon::read
