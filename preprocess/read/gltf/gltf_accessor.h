// Reads the values of glTF accessors with any component type, also if they are interleaved, normalised or sparse.
#pragma once

#include "preprocess/read/gltf/gltf_file.h"

#include <cstdint>
#include <vector>

namespace gnomon::read {

/// Returns the elements of the glTF accessor `accessor` one after the other, with `components` numbers each. Reserves
/// the memory in the file's memory budget. Throws Error, which names the accessor, if the accessor has another number
/// of components, or if elements are outside its buffer view. Source: glTF 2.0, sections 3.6.2.2 to 3.6.2.4 and 3.11.
std::vector<float> numbersOf(GltfFile& file, int accessor, std::size_t components);

/// Returns the colours of the glTF accessor `accessor` with four components each. If the file has only three
/// components, the fourth is 1. Throws Error like numbersOf.
std::vector<float> colorsOf(GltfFile& file, int accessor);

/// Returns the unsigned integers, such as vertex indices, of the glTF accessor `accessor`. They can have any width.
/// Throws Error like numbersOf.
std::vector<std::uint32_t> indicesOf(GltfFile& file, int accessor);

/// Returns the number of elements that the glTF accessor `accessor` declares. Throws Error if the accessor does not
/// exist.
std::uint64_t countOf(const GltfFile& file, int accessor);

} // namespace gnomon::read
