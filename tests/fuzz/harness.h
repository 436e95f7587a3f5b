// What a fuzzer hands over, as a file: the readers open paths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace gnomon::fuzz {

/// One file in the folder of temporary files, written anew for each input, and gone at the end of the process.
class InputFile {
public:
    explicit InputFile(const std::string& suffix);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    InputFile(InputFile&&) = delete;
    InputFile& operator=(InputFile&&) = delete;

    /// Its path, once `bytes` are all that is in it.
    const std::string& with(std::span<const std::uint8_t> bytes);

private:
    std::string path_;
};

/// Reads a mesh as a build does, polygons included, as far as a small `memory` lets it: what is refused is refused by
/// gnomon::Error, and everything else is a finding.
void readMesh(const std::string& path);

} // namespace gnomon::fuzz

// What libFuzzer calls, and replay.cpp. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
