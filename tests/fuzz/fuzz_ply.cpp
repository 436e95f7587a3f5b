// PLY, in every form that the streaming reader takes.
#include "harness.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static gnomon::fuzz::InputFile file(".ply");
    gnomon::fuzz::readMesh(file.with({data, size}));
    return 0;
}
