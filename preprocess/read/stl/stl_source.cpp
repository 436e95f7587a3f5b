#include "preprocess/read/stl/stl_source.h"

#include "core/error.h"
#include "preprocess/read/color_range.h"
#include "preprocess/read/face_color_splitter.h"
#include "preprocess/read/stl/stl_facets.h"
#include "preprocess/read/stl/stl_text.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon::read {

namespace {

constexpr std::uint64_t kHeaderBytes = 80;
constexpr std::uint64_t kFacetsAt = 84;
constexpr std::uint64_t kFacetBytes = 50;

std::uint32_t numberAt(const std::byte* bytes, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
    return value;
}

float realAt(const std::byte* bytes) {
    return std::bit_cast<float>(numberAt(bytes, 4));
}

glm::dvec3 vectorAt(const std::byte* bytes) {
    return {realAt(bytes), realAt(bytes + 4), realAt(bytes + 8)};
}

/// Converts a colour with three channels of 5 bits, red in the lowest bits, to RGBA8.
std::uint32_t colorOfBits(std::uint32_t bits) {
    std::uint32_t color = 0xFF000000U;
    for (std::uint32_t channel = 0; channel < 3; ++channel)
        color |= ((bits >> (5 * channel) & 31U) * 255 + 15) / 31 << (8 * channel);
    return color;
}

/// Returns the colour `bits`, three channels of 5 bits, with red and blue exchanged.
std::uint32_t reversed(std::uint32_t bits) {
    return (bits & 0x83E0U) | (bits & 31U) << 10U | (bits >> 10U & 31U);
}

class StlBytes {
public:
    StlBytes(const InputFile& file, std::uint64_t facets) : file_(file), count_(facets), stream_(file, 0) {}

    MemoryMesh read(Bytes memoryLimit) {
        readHeader();
        for (std::uint64_t i = 0; i < count_; ++i)
            readFacet();
        MemoryMesh mesh = facets_.take();
        const bool hasOwnColors = std::any_of(attributes_.begin(), attributes_.end(), [this](std::uint16_t bits) {
            return partColor_ ? bits != 0
                              // Files of the program Magics: if the attributes of all triangles are 0, they have the
                              // colour in the header.
                              : (bits & 0x8000U) != 0;
        });
        if (!hasOwnColors && !partColor_) {
            const auto used =
                std::count_if(attributes_.begin(), attributes_.end(), [](auto bits) { return bits != 0; });
            if (used > 0) mesh.attributesDropped[kAttributes] = static_cast<std::uint64_t>(used);
            return mesh;
        }
        std::vector<std::uint32_t> colors;
        colors.reserve(attributes_.size());
        for (const std::uint16_t bits : attributes_) {
            colors.push_back(hasOwnColors ? colorOf(bits) : *partColor_);
            if (!partColor_ && bits != 0 && (bits & 0x8000U) == 0) ++mesh.attributesDropped[kAttributes];
        }
        if (hasMaterial_) mesh.attributesDropped["MATERIAL= of the header"] = 1;
        mesh.remarks.push_back(
            file_.path() + ": colours of facets in the manner of " +
            (partColor_ ? "Magics, as COLOR= in the header says" : "VisCAM, as bit 15 of some facets says"));
        return withFaceColors(std::move(mesh), colors, file_.path(), memoryLimit);
    }

private:
    void readHeader() {
        stream_.fill(kFacetsAt);
        const std::string_view header(reinterpret_cast<const char*>(stream_.data()), kHeaderBytes);
        constexpr std::string_view kColor = "COLOR=";
        const std::size_t at = header.find(kColor);
        if (at != std::string_view::npos && at + kColor.size() + 4 <= header.size())
            partColor_ = numberAt(stream_.data() + at + kColor.size(), 3) | 0xFF000000U;
        hasMaterial_ = partColor_ && header.find("MATERIAL=") != std::string_view::npos;
        stream_.consume(kFacetsAt);
    }

    void readFacet() {
        stream_.fill(kFacetBytes);
        const std::byte* const bytes = stream_.data();
        std::array<glm::dvec3, 3> corners{};
        for (std::size_t i = 0; i < 9; ++i) {
            const std::size_t at = 12 + 4 * i;
            const float value = realAt(bytes + at);
            if (!std::isfinite(value))
                throw Error(atByte(file_.path(), stream_.offset() + at), "a coordinate is not finite");
            corners[i / 3][static_cast<int>(i % 3)] = value;
        }
        const glm::dvec3 normal = vectorAt(bytes);
        if (facets_.add(corners, isFinite(normal) ? normal : glm::dvec3(0)))
            attributes_.push_back(static_cast<std::uint16_t>(numberAt(bytes + 48, 2)));
        stream_.consume(kFacetBytes);
    }

    std::uint32_t colorOf(std::uint32_t bits) const {
        const bool isHigh = (bits & 0x8000U) != 0;
        if (partColor_) return isHigh ? *partColor_ : colorOfBits(bits);
        return isHigh ? colorOfBits(reversed(bits)) : kNoColor;
    }

    static constexpr const char* kAttributes = "attribute bytes that are no colour";

    const InputFile& file_;
    std::uint64_t count_;
    ByteStream stream_;
    StlFacets facets_;
    std::vector<std::uint16_t> attributes_;  ///< attribute bits per triangle with three different corners
    std::optional<std::uint32_t> partColor_; ///< colour of the whole mesh, from the header
    bool hasMaterial_ = false;
};

/// Returns true if `file` begins with "solid", as an ASCII STL file does.
bool beginsWithSolid(const InputFile& file) {
    std::string head(std::min<std::uint64_t>(file.size(), 1024), '\0');
    head.resize(file.readSomeAt(0, std::as_writable_bytes(std::span(head.data(), head.size()))));
    const std::size_t begin = head.find_first_not_of(" \t\r\n\v\f", markBytesOf(file));
    return begin != std::string::npos && lowered(head.substr(begin, 5)) == "solid";
}

/// Returns the number of triangles if `file` has exactly the size of a binary STL file. Returns nullopt for an ASCII
/// STL file. Throws Error for any other file.
std::optional<std::uint64_t> binaryFacets(const InputFile& file) {
    if (file.size() < kFacetsAt) return std::nullopt;
    std::array<std::byte, kFacetsAt> header{};
    file.readAt(0, header);
    const std::uint64_t count = numberAt(header.data() + kHeaderBytes, 4);
    if (file.size() == kFacetsAt + kFacetBytes * count) return count;
    if (beginsWithSolid(file)) return std::nullopt;
    requireUtf8(file);
    throw Error(
        atByte(file.path(), file.size()),
        "neither ascii nor binary STL",
        std::to_string(kFacetsAt + kFacetBytes * count) + " bytes for " + std::to_string(count) + " facets",
        std::to_string(file.size()));
}

} // namespace

std::unique_ptr<MeshSource> readStl(const std::string& path, Bytes memoryLimit) {
    const InputFile file(path);
    requireRoomForWhole(path, file.size(), memoryLimit);
    constexpr std::uint64_t kMinVertexBytes = 12;
    if (file.size() / kMinVertexBytes >= std::numeric_limits<std::uint32_t>::max())
        throw Error(
            path, "too large for an STL; convert the file to PLY", "less than 51 GB", readableBytes({file.size()}));
    const std::optional<std::uint64_t> facets = binaryFacets(file);
    MemoryMesh mesh = facets ? StlBytes(file, *facets).read(memoryLimit) : readStlText(file);
    file.requireUnchanged();
    return memorySource(path, file.size(), std::move(mesh));
}

} // namespace gnomon::read
