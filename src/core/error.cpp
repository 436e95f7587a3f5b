#include "core/error.h"

namespace gnomon {

Error::Error(const std::string& what) : std::runtime_error(what) {}

Error::Error(const std::string& where, const std::string& what) : std::runtime_error(where + ": " + what) {}

Error::Error(const std::string& where, const std::string& what, const std::string& expected, const std::string& found)
    : std::runtime_error(where + ": " + what + ": expected " + expected + ", found " + found) {}

std::string atByte(const std::string& path, std::uint64_t offset) {
    return path + ": byte " + std::to_string(offset);
}

std::string atLine(const std::string& path, std::uint64_t line) {
    return path + ":" + std::to_string(line);
}

} // namespace gnomon
