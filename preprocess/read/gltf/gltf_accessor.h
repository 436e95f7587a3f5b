// Reads the values of glTF accessors. Accessors can have any component type and be interleaved, normalised or sparse.
#pragma once

#include "preprocess/read/gltf/gltf_file.h"

#include <cstdint>
#include <vector>

namespace gnomon::read {

/// Returns the elements of `accessor` one after the other. Each element has `components` numbers. Reserves the memory
/// in the memory room of the file. Throws Error, which names the accessor, if the accessor has another number of
/// components, or if elements are outside its buffer view. Source: glTF 2.0, sections 3.6.2.2 to 3.6.2.4 and 3.11.
std::vector<float> numbersOf(GltfFile& file, int accessor, std::size_t components);

/// Returns colours of three or four components as four components per colour. A missing fourth component is 1. Throws
/// Error like numbersOf.
std::vector<float> colorsOf(GltfFile& file, int accessor);

/// Returns the unsigned integers of `accessor`, of any width. Throws Error like numbersOf.
std::vector<std::uint32_t> indicesOf(GltfFile& file, int accessor);

/// Returns the number of elements that `accessor` declares. Throws Error if there is no such accessor.
std::uint64_t countOf(const GltfFile& file, int accessor);

} // namespace gnomon::read
