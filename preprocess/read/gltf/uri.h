// The uri of a buffer or an image of glTF: bytes in the text itself, or the name of a file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::read {

/// Whether the uri holds its bytes itself (RFC 2397).
bool isDataUri(std::string_view uri);

/// Returns the bytes of a uri that holds them in base64. Throws Error, placed by `place`, for another encoding and for
/// characters that are not base64.
std::vector<std::byte> bytesOfDataUri(std::string_view uri, const std::string& place);

/// Returns the file name of a uri: each percent sign and its two hexadecimal digits become one byte (RFC 3986). A
/// percent sign without two digits stays. Throws Error, placed by `place`, for a byte of 0, which no file name has.
std::string fileNameOf(std::string_view uri, const std::string& place);

/// Throws Error, placed by `place`, if the uri has a percent sign without two digits and no file has that name.
void requirePercentDigits(std::string_view uri, bool hasFile, const std::string& place);

} // namespace gnomon::read
