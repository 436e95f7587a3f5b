// glTF: documents with data in them, and .glb.
#include "harness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static gnomon::fuzz::InputFile file(".gltf"); // a .glb is known by its first bytes
    gnomon::fuzz::readMesh(file.with({data, size}));
    return 0;
}
