// Reads the markers of a JPEG that determine the cost of its decoding. libjpeg-turbo does not report this cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::read {

/// The size of a JPEG and the cost of its decoding.
struct JpegHeader {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    int components = 0;
    bool isAdobe = false; ///< it has the marker of Adobe's programs, which store CMYK inverted
    /// Memory for the coefficients of the whole image; 0 if the decoder needs only rows.
    std::uint64_t coefficientBytes = 0;
    std::uint64_t scans = 0;
};

/// Returns the header of the JPEG in `encoded` (ITU-T T.81, annex B). Returns nothing if it has no frame.
std::optional<JpegHeader> jpegHeaderOf(std::span<const std::byte> encoded);

} // namespace gnomon::read
