#include "preprocess/read/gltf/gltf_accessor.h"

#include "core/error.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace gnomon::read {

namespace {

const tinygltf::Accessor& accessorAt(const GltfFile& file, int index) {
    return file.elementOf(file.model().accessors, index, "accessor");
}

std::string placeOf(const GltfFile& file, int accessor) {
    return file.where("accessor", static_cast<std::uint64_t>(accessor));
}

std::size_t componentBytes(int type) {
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

std::size_t componentsOf(const tinygltf::Accessor& accessor) {
    const int count = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

template <class T>
T loaded(std::span<const std::byte> bytes) {
    T value{};
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
}

/// A number of an accessor as stored, and the value that means 1 if the accessor is normalised.
struct Stored {
    double value = 0;
    double one = 1;
};

template <class T>
Stored storedAs(std::span<const std::byte> bytes) {
    return {static_cast<double>(loaded<T>(bytes)), static_cast<double>(std::numeric_limits<T>::max())};
}

Stored stored(int type, std::span<const std::byte> bytes) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return storedAs<std::int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return storedAs<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return storedAs<std::int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return storedAs<std::uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return storedAs<std::uint32_t>(bytes);
    default:
        return {static_cast<double>(loaded<float>(bytes)), 1};
    }
}

/// The elements of a glTF accessor in a buffer view. Each element is completely inside the bytes of the view.
struct Elements {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;
    int type = 0;

    std::span<const std::byte> at(std::uint64_t element, std::size_t component) const {
        return bytes.subspan(element * stride + component * componentBytes(type));
    }
};

/// Returns the elements of the glTF accessor `layout`. Each element has `bytesEach` bytes. If `isPacked` is true, the
/// stride of the buffer view is ignored. Throws Error if an element is outside the buffer view.
Elements elementsIn(
    GltfFile& file, const std::string& place, const tinygltf::Accessor& layout, std::size_t bytesEach, bool isPacked) {
    const std::span<const std::byte> all = file.bufferView(layout.bufferView);
    const std::size_t step = file.model().bufferViews[static_cast<std::size_t>(layout.bufferView)].byteStride;
    const std::size_t stride = isPacked || step == 0 ? bytesEach : step;
    const std::uint64_t count = layout.count;
    // Each element has at least one byte. `count <= all.size()` therefore prevents an overflow of the multiplication
    // below.
    const bool isIn = layout.byteOffset <= all.size() && count <= all.size() &&
                      (count == 0 || (count - 1) * stride + bytesEach <= all.size() - layout.byteOffset);
    if (!isIn)
        throw Error(
            place,
            "the range is outside its buffer view",
            "within " + std::to_string(all.size()) + " bytes",
            std::to_string(count) + " elements of " + std::to_string(bytesEach) + " bytes from " +
                std::to_string(layout.byteOffset) + " on");
    return {all.subspan(layout.byteOffset), stride, layout.componentType};
}

/// Calls take(element, elements, index in `elements`) for each element of a glTF accessor, and then for each element
/// that the sparse part of the accessor replaces.
template <class Take>
void visit(GltfFile& file, int index, Take take) {
    const tinygltf::Accessor& accessor = accessorAt(file, index);
    const std::string place = placeOf(file, index);
    const std::size_t bytesEach = componentBytes(accessor.componentType) * componentsOf(accessor);
    if (accessor.bufferView >= 0) {
        const Elements elements = elementsIn(file, place, accessor, bytesEach, false);
        for (std::uint64_t i = 0; i < accessor.count; ++i)
            take(i, elements, i);
    }
    if (!accessor.sparse.isSparse) {
        if (accessor.bufferView < 0) throw Error(place, "the accessor has neither a buffer view nor a sparse part");
        return;
    }
    if (accessor.sparse.count < 0) throw Error(place, "the sparse part has a negative count");
    tinygltf::Accessor layout = accessor;
    layout.count = static_cast<std::size_t>(accessor.sparse.count);
    layout.bufferView = accessor.sparse.values.bufferView;
    layout.byteOffset = static_cast<std::size_t>(std::max(0, accessor.sparse.values.byteOffset));
    const Elements values = elementsIn(file, place, layout, bytesEach, true);
    layout.bufferView = accessor.sparse.indices.bufferView;
    layout.byteOffset = static_cast<std::size_t>(std::max(0, accessor.sparse.indices.byteOffset));
    layout.componentType = accessor.sparse.indices.componentType;
    const std::size_t indexBytes = componentBytes(layout.componentType);
    if (indexBytes == 0) throw Error(place, "the sparse indices have an unknown type");
    const Elements places = elementsIn(file, place, layout, indexBytes, true);
    for (std::uint64_t i = 0; i < layout.count; ++i) {
        const double at = stored(places.type, places.at(i, 0)).value;
        if (!(at >= 0 && at < static_cast<double>(accessor.count)))
            throw Error(
                place, "a sparse index is out of range", "below " + std::to_string(accessor.count), std::to_string(at));
        take(static_cast<std::uint64_t>(at), values, i);
    }
}

/// Copies the first `taken` components of each element to `values`, which has `width` floats per element. The other
/// floats do not change.
void takeNumbers(GltfFile& file, int index, std::size_t taken, std::size_t width, std::vector<float>& values) {
    const tinygltf::Accessor& accessor = accessorAt(file, index);
    visit(file, index, [&](std::uint64_t element, const Elements& elements, std::uint64_t place) {
        for (std::size_t c = 0; c < taken; ++c) {
            const Stored number = stored(elements.type, elements.at(place, c));
            const double value = accessor.normalized ? std::max(number.value / number.one, -1.0) : number.value;
            values[element * width + c] = static_cast<float>(value);
        }
    });
}

/// Returns an array for all elements of a glTF accessor, filled with `value`. Reserves its memory in the memory budget
/// first. Throws Error if the component type does not exist in glTF.
template <class T>
std::vector<T> valuesFor(GltfFile& file, int index, std::size_t components, T value) {
    const tinygltf::Accessor& accessor = accessorAt(file, index);
    if (componentBytes(accessor.componentType) == 0 || accessor.componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE ||
        accessor.componentType == TINYGLTF_COMPONENT_TYPE_INT)
        throw Error(placeOf(file, index), "unknown component type");
    file.room().take(accessor.count, components * sizeof(T));
    return std::vector<T>(accessor.count * components, value);
}

void requireComponents(const GltfFile& file, int index, std::size_t expected) {
    const std::size_t found = componentsOf(accessorAt(file, index));
    if (found != expected)
        throw Error(
            placeOf(file, index),
            "wrong number of components",
            std::to_string(expected) + " components",
            std::to_string(found));
}

} // namespace

std::uint64_t countOf(const GltfFile& file, int accessor) {
    return accessorAt(file, accessor).count;
}

std::vector<float> numbersOf(GltfFile& file, int accessor, std::size_t components) {
    requireComponents(file, accessor, components);
    std::vector<float> values = valuesFor(file, accessor, components, 0.0F);
    takeNumbers(file, accessor, components, components, values);
    return values;
}

std::vector<float> colorsOf(GltfFile& file, int accessor) {
    const std::size_t components = componentsOf(accessorAt(file, accessor));
    if (components != 3) requireComponents(file, accessor, 4);
    std::vector<float> values = valuesFor(file, accessor, 4, 1.0F);
    takeNumbers(file, accessor, components, 4, values);
    return values;
}

std::vector<std::uint32_t> indicesOf(GltfFile& file, int accessor) {
    requireComponents(file, accessor, 1);
    const int type = accessorAt(file, accessor).componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        throw Error(placeOf(file, accessor), "the indices are not unsigned integers");
    std::vector<std::uint32_t> values = valuesFor<std::uint32_t>(file, accessor, 1, 0);
    visit(file, accessor, [&](std::uint64_t element, const Elements& elements, std::uint64_t place) {
        values[element] = static_cast<std::uint32_t>(stored(elements.type, elements.at(place, 0)).value);
    });
    return values;
}

} // namespace gnomon::read
