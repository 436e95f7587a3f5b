// OBJ, STL and OFF: the first byte says which.
#include "harness.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static std::array<gnomon::fuzz::InputFile, 3> files{
        {gnomon::fuzz::InputFile(".obj"), gnomon::fuzz::InputFile(".stl"), gnomon::fuzz::InputFile(".off")}};
    if (size < 1) return 0;
    gnomon::fuzz::readMesh(files.at(data[0] % files.size()).with({data + 1, size - 1}));
    return 0;
}
