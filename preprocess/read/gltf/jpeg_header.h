// Reads the markers of a JPEG image that determine how much memory its decoding needs. libjpeg-turbo does not report
// this size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::read {

/// The size of a JPEG image and the memory and scans that its decoding needs.
struct JpegHeader {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    int components = 0;
    bool isAdobe = false; ///< whether it has Adobe's marker; Adobe's programs store inverted CMYK
    /// Bytes for the coefficients of the whole image. The value is 0 if the decoder needs only the coefficients of some
    /// rows.
    std::uint64_t coefficientBytes = 0;
    std::uint64_t scans = 0;
};

/// Returns the header of the JPEG image `encoded` (ITU-T T.81, annex B). Returns nullopt if the image has no frame
/// segment.
std::optional<JpegHeader> jpegHeaderOf(std::span<const std::byte> encoded);

} // namespace gnomon::read
