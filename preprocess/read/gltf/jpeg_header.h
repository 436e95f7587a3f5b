// The markers of a JPEG: facts that say what decoding it costs, which its decoder does not tell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gnomon::read {

struct JpegHeader {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
    int components = 0;
    bool isAdobe = false; ///< it has the marker of Adobe's programs, which store CMYK inverted
    std::uint64_t coefficientBytes =
        0; ///< memory for coefficients of the whole image; 0 if a decoder needs no more than rows
    std::uint64_t scans = 0;
};

/// Returns the header of the JPEG in `encoded` (ITU-T T.81, annex B); nothing if it has no frame.
std::optional<JpegHeader> jpegHeaderOf(std::span<const std::byte> encoded);

} // namespace gnomon::read
