// The values of an accessor of glTF: any component type, interleaved, normalised, sparse.
#pragma once

#include "preprocess/read/gltf/gltf_file.h"

#include <cstdint>
#include <vector>

namespace gnomon::read {

/// Elements of `components` numbers each, one element after the other. Throws Error that names the accessor if it has
/// another number of components, or elements that lie outside of the bytes that are there. Takes its memory from the
/// file's room. glTF 2.0, sections 3.6.2.2 to 3.6.2.4 and 3.11.
std::vector<float> numbersOf(GltfFile& file, int accessor, std::size_t components);

/// The same for colours, of three or four components: four each, the fourth 1 where it is not there.
std::vector<float> colorsOf(GltfFile& file, int accessor);

/// Unsigned integers of any width.
std::vector<std::uint32_t> indicesOf(GltfFile& file, int accessor);

/// How many elements accessor `accessor` says it has. Throws Error if there is no such accessor.
std::uint64_t countOf(const GltfFile& file, int accessor);

} // namespace gnomon::read
