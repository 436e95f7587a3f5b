// Stands in for libFuzzer where there is none: runs a harness over every file of the folders that are named.
// usage: NAME_replay FOLDER...
#include "harness.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

/// How many files the folder has, each of which the harness is run over.
std::size_t replay(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& path : files) {
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    return files.size();
}

} // namespace

int main(int count, char** words) {
    try {
        std::size_t inputs = 0;
        for (int i = 1; i < count; ++i)
            inputs += replay(words[i]);
        std::printf("%zu inputs\n", inputs);
        return inputs > 0 ? 0 : 1;
    } catch (const std::exception& error) {
        static_cast<void>(std::fprintf(stderr, "replay: %s\n", error.what()));
        return 1;
    }
}
