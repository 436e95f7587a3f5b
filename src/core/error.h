// The one exception of the project: a bad world (file, GL, budget), told in one line.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace gnomon {

/// What went wrong, where, what was expected and what was found. Caught once, in `main`.
class Error : public std::runtime_error {
public:
    /// `what` alone, for errors that have no place.
    explicit Error(const std::string& what);

    /// "WHERE: what" where `where` is a path, an option or an object.
    Error(const std::string& where, const std::string& what);

    /// "WHERE: what: expected E, found F".
    Error(const std::string& where, const std::string& what, const std::string& expected, const std::string& found);
};

/// "PATH: byte N", the place of an error inside a binary file.
std::string atByte(const std::string& path, std::uint64_t offset);

/// "PATH:N", the place of an error inside a text file; lines count from 1.
std::string atLine(const std::string& path, std::uint64_t line);

} // namespace gnomon
