// The exception class of Gnomon. It is thrown for errors outside the program (files, OpenGL, memory limits), with a
// message of one line.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace gnomon {

/// An error of a file, of OpenGL or of the input. The message contains its place, the failure, the expected value and
/// the found value. Only `main` catches it.
class Error : public std::runtime_error {
public:
    /// Makes an error without a place.
    explicit Error(const std::string& what);

    /// Creates an error with the message "WHERE: what". `where` is a path, an option or an object.
    Error(const std::string& where, const std::string& what);

    /// Creates an error with the message "WHERE: what: expected E, found F".
    Error(const std::string& where, const std::string& what, const std::string& expected, const std::string& found);
};

/// Returns "PATH: byte N", the place of an error in a binary file.
std::string atByte(const std::string& path, std::uint64_t offset);

/// Returns "PATH:N", the place of an error in a text file. The first line has number 1.
std::string atLine(const std::string& path, std::uint64_t line);

} // namespace gnomon
