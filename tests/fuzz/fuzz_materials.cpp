// An OBJ with a library of materials: the library, a zero byte, and the OBJ that names it.
#include "harness.h"

#include <algorithm>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static gnomon::fuzz::InputFile library(".mtl");
    static gnomon::fuzz::InputFile mesh(".obj");
    const std::span<const std::uint8_t> given(data, size);
    const auto end = static_cast<std::size_t>(std::find(given.begin(), given.end(), 0) - given.begin());
    std::string named = "mtllib ";
    named += std::filesystem::path(library.with(given.first(end))).filename().string();
    named += '\n';
    std::vector<std::uint8_t> text(named.begin(), named.end());
    const auto rest = given.subspan(std::min(end + 1, given.size()));
    text.insert(text.end(), rest.begin(), rest.end());
    gnomon::fuzz::readMesh(mesh.with(text));
    return 0;
}
