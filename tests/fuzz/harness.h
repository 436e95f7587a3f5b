// Conversion of a fuzzer's input to a file, because readers open paths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace gnomon::fuzz {

/// A file in the temporary folder that each input overwrites. It is removed at the end of the process.
class InputFile {
public:
    explicit InputFile(const std::string& suffix);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    InputFile(InputFile&&) = delete;
    InputFile& operator=(InputFile&&) = delete;

    /// Writes `bytes` to the file and returns its path.
    const std::string& with(std::span<const std::uint8_t> bytes);

private:
    std::string path_;
};

/// Reads a mesh as a build does, including polygons, with a small `memory`. Invalid input must throw gnomon::Error. Any
/// other failure is a finding.
void readMesh(const std::string& path);

} // namespace gnomon::fuzz

// What libFuzzer calls, and replay.cpp. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
