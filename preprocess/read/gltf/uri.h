// Parses the URI of a glTF buffer or image. A URI contains embedded bytes or the name of a file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::read {

/// Returns true if the URI contains embedded bytes instead of a file name (RFC 2397).
bool isDataUri(std::string_view uri);

/// Decodes the base64 bytes that a URI contains. Throws Error, which names `place`, for another encoding and for
/// characters that are not base64.
std::vector<std::byte> bytesOfDataUri(std::string_view uri, const std::string& place);

/// Returns the file name that a URI encodes: each percent sign with two hexadecimal digits becomes one byte (RFC 3986).
/// A percent sign without two digits is preserved. Throws Error, which names `place`, for a zero byte, which no file
/// name has.
std::string fileNameOf(std::string_view uri, const std::string& place);

/// Throws Error, which names `place`, if the URI has a percent sign without two hexadecimal digits and `hasFile` is
/// false.
void requirePercentDigits(std::string_view uri, bool hasFile, const std::string& place);

} // namespace gnomon::read
