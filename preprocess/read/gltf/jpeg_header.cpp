#include "preprocess/read/gltf/jpeg_header.h"

#include <algorithm>
#include <string_view>

namespace gnomon::read {

namespace {

constexpr unsigned kBlockSide = 8;
constexpr std::uint64_t kBlockBytes = 128; // one block has 64 coefficients of 16 bits

constexpr unsigned kStartOfScan = 0xDA;
constexpr unsigned kEndOfImage = 0xD9;
constexpr unsigned kAdobe = 0xEE; // marker of application segment 14, which Adobe's programs write

bool isFrame(unsigned marker) {
    return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Returns true if the frame marker `frame` means a progressive JPEG, in which several scans refine the coefficients.
bool isProgressive(unsigned frame) {
    return frame % 4 == 2;
}

/// Returns true if no segment follows this JPEG marker. Such markers are stuffed bytes, restarts, and the start of the
/// image.
bool isAlone(unsigned marker) {
    return marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD8);
}

/// A range of bytes of a JPEG image, with access to its big-endian numbers.
class JpegBytes {
public:
    explicit JpegBytes(std::span<const std::byte> bytes) : bytes_(bytes) {}

    std::size_t size() const { return bytes_.size(); }

    unsigned at(std::size_t index) const { return std::to_integer<unsigned>(bytes_[index]); }

    unsigned word(std::size_t index) const { return at(index) << 8U | at(index + 1); }

    JpegBytes part(std::size_t first, std::size_t count) const { return JpegBytes(bytes_.subspan(first, count)); }

    bool beginsWith(std::string_view text) const {
        return text.size() <= size() && std::equal(text.begin(), text.end(), bytes_.begin(), [](char a, std::byte b) {
                   return static_cast<std::byte>(a) == b;
               });
    }

private:
    std::span<const std::byte> bytes_;
};

/// Reads a JPEG frame segment, which contains the image size, into `header`. Returns false if the segment is too short.
bool takeFrame(const JpegBytes& segment, JpegHeader& header) {
    constexpr std::size_t kStart = 6;
    constexpr std::size_t kComponent = 3;
    if (segment.size() < kStart || segment.size() < kStart + kComponent * segment.at(5)) return false;
    header.height = segment.word(1);
    header.width = segment.word(3);
    header.components = static_cast<int>(segment.at(5));
    const auto samplings = [&](std::size_t i) { return segment.at(kStart + kComponent * i + 1); };
    const auto count = static_cast<std::size_t>(header.components);
    std::uint64_t maxAcross = 1;
    std::uint64_t maxDown = 1;
    for (std::size_t i = 0; i < count; ++i) {
        maxAcross = std::max<std::uint64_t>(maxAcross, samplings(i) >> 4U);
        maxDown = std::max<std::uint64_t>(maxDown, samplings(i) & 15U);
    }
    // A JPEG image is padded to whole units of `maxAcross` by `maxDown` blocks. In each unit, a component has as many
    // blocks as its sampling factors say.
    const auto unitsOf = [](std::uint64_t size, std::uint64_t maxSampling) {
        return (size + maxSampling * kBlockSide - 1) / (maxSampling * kBlockSide);
    };
    const std::uint64_t units = unitsOf(header.width, maxAcross) * unitsOf(header.height, maxDown);
    for (std::size_t i = 0; i < count; ++i)
        header.coefficientBytes += units * (samplings(i) >> 4U) * (samplings(i) & 15U) * kBlockBytes;
    return true;
}

/// Collects the properties of a JPEG image from its segments, one segment after the other.
class JpegSegments {
public:
    /// Reads one segment of the JPEG image. Returns false if the segment is an invalid frame.
    bool take(unsigned marker, const JpegBytes& segment) {
        if (isFrame(marker) && header_.components == 0) {
            needsAll_ = isProgressive(marker);
            return takeFrame(segment, header_);
        }
        if (marker == kAdobe && segment.beginsWith("Adobe"))
            header_.isAdobe = true;
        else if (marker == kStartOfScan && segment.size() > 0 && ++header_.scans == 1)
            needsAll_ |= static_cast<int>(segment.at(0)) < header_.components;
        return true;
    }

    std::optional<JpegHeader> header() const {
        if (header_.components == 0) return std::nullopt;
        JpegHeader header = header_;
        if (!needsAll_) header.coefficientBytes = 0;
        return header;
    }

private:
    JpegHeader header_;
    bool needsAll_ = false; // whether the decoder needs the coefficients of the whole image in memory
};

} // namespace

std::optional<JpegHeader> jpegHeaderOf(std::span<const std::byte> encoded) {
    const JpegBytes bytes(encoded);
    JpegSegments segments;
    for (std::size_t at = 0; at + 1 < bytes.size();) {
        const unsigned marker = bytes.at(at + 1);
        if (bytes.at(at) != 0xFF || marker == 0xFF || isAlone(marker)) {
            ++at;
            continue;
        }
        if (marker == kEndOfImage || at + 4 > bytes.size()) break;
        const std::size_t length = bytes.word(at + 2);
        if (length < 2 || length > bytes.size() - at - 2) break;
        if (!segments.take(marker, bytes.part(at + 4, length - 2))) return std::nullopt;
        at += 2 + length;
    }
    return segments.header();
}

} // namespace gnomon::read
