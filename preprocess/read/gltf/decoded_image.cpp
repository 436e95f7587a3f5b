#include "preprocess/read/gltf/decoded_image.h"

#include "core/limit_error.h"
#include "core/printable.h"
#include "preprocess/read/gltf/jpeg_header.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include <png.h>
#include <turbojpeg.h>

namespace gnomon::read {

namespace {

bool beginsWith(std::span<const std::byte> bytes, std::span<const std::uint8_t> magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(), [](std::uint8_t a, std::byte b) {
               return std::byte{a} == b;
           });
}

/// Throws Error if `room`, the memory budget, has too little memory to decode an image. The decoder needs memory for
/// the pixels plus `besides` bytes.
void requireImageRoom(
    std::uint64_t width,
    std::uint64_t height,
    std::uint64_t besides,
    const MemoryRoom& room,
    const std::string& where) {
    const std::uint64_t pixels = width * height; // no overflow: both factors have at most 31 bits
    const std::uint64_t free = room.limit().count - room.taken().count;
    if (pixels <= free / 4 && besides <= free - pixels * 4) return;
    throw LimitError(
        Limit::Textures,
        {where,
         "the image is too large, " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
         "at most " + readableBytes(room.limit()) + " of memory",
         "a need for " + readableBytes({pixels * 4 + besides}) + " besides " + readableBytes(room.taken())});
}

void takePixels(DecodedImage& image, MemoryRoom& room) {
    const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    room.take(pixels, 4);
    image.pixels.resize(pixels * 4);
}

/// Reads a PNG image from memory. At an error, libpng leaves the calling function by longjmp. A function that calls
/// libpng must therefore not have local objects with destructors.
class PngReader {
public:
    explicit PngReader(std::span<const std::byte> encoded)
        : rest_(encoded), png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore)) {
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
    }

    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    PngReader(PngReader&&) = delete;
    PngReader& operator=(PngReader&&) = delete;

    /// Reads the PNG chunks before the pixels and selects RGBA8 as output format. Returns false if an error occurs.
    bool readHeader() {
        if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
        png_set_read_fn(png_, this, read);
        // Skip all PNG chunks except the pixels. A text chunk can unpack to any size, and glTF ignores colour spaces
        // (glTF 2.0, section 3.8.3).
        png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
        png_read_info(png_, info_);
        png_set_expand(png_);
        png_set_scale_16(png_);
        png_set_gray_to_rgb(png_);
        png_set_add_alpha(png_, 255, PNG_FILLER_AFTER);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    std::uint64_t width() const { return png_get_image_width(png_, info_); }

    std::uint64_t height() const { return png_get_image_height(png_, info_); }

    /// Reads all rows of pixels of the PNG image into the memory that `rows` points to. Returns false if an error
    /// occurs.
    bool readRows(png_bytepp rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_image(png_, rows);
        return true;
    }

    /// Returns the message of libpng's last error.
    const char* fault() const { return fault_.data(); }

private:
    [[noreturn]] static void fail(png_structp png, png_const_charp reason) {
        auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
        std::snprintf(reader->fault_.data(), reader->fault_.size(), "%s", reason);
        png_longjmp(png, 1);
    }

    static void ignore(png_structp /*png*/, png_const_charp /*warning*/) {}

    static void read(png_structp png, png_bytep out, png_size_t count) {
        auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > reader->rest_.size()) png_error(png, "the file ends too early");
        std::memcpy(out, reader->rest_.data(), count);
        reader->rest_ = reader->rest_.subspan(count);
    }

    std::span<const std::byte> rest_;
    std::array<char, 128> fault_{"no memory for its reader"};
    png_structp png_;
    png_infop info_ = nullptr;
};

DecodedImage decodedPng(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where) {
    PngReader reader(encoded);
    const auto require = [&](bool isGood) {
        if (!isGood) throw Error(where, "the PNG is damaged: " + printable(std::string_view(reader.fault())));
    };
    require(reader.readHeader());
    requireImageRoom(reader.width(), reader.height(), reader.height() * sizeof(png_bytep), room, where);
    DecodedImage image{static_cast<int>(reader.width()), static_cast<int>(reader.height()), {}};
    takePixels(image, room);
    std::vector<png_bytep> rows(reader.height());
    for (std::size_t y = 0; y < rows.size(); ++y)
        rows[y] = image.pixels.data() + 4 * reader.width() * y;
    require(reader.readRows(rows.data()));
    return image;
}

/// Converts pixels from CMYK to RGBA. If `isInverted` is true, the value 255 means no ink.
void turnInksToLight(std::vector<std::uint8_t>& pixels, bool isInverted) {
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        const auto light = [&](std::size_t c) { return isInverted ? pixels[i + c] : 255U - pixels[i + c]; };
        const unsigned black = light(3);
        for (std::size_t c = 0; c < 3; ++c)
            pixels[i + c] = static_cast<std::uint8_t>((light(c) * black + 127) / 255);
        pixels[i + 3] = 255;
    }
}

DecodedImage decodedJpeg(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where) {
    constexpr std::uint64_t kMaxScans = 100; // usual JPEG encoders write at most 20 scans
    const std::optional<JpegHeader> header = jpegHeaderOf(encoded);
    if (!header) throw Error(where, "the JPEG is damaged: it has no frame");
    if (header->coefficientBytes > 0 && header->scans > kMaxScans)
        throw Error(
            where,
            "the JPEG has too many scans",
            std::to_string(kMaxScans) + " at most",
            std::to_string(header->scans));
    requireImageRoom(header->width, header->height, header->coefficientBytes, room, where);
    const auto freed = [](void* handle) { tjDestroy(handle); };
    const std::unique_ptr<void, decltype(freed)> reader(tjInitDecompress(), freed);
    const auto require = [&](int failed) {
        if (failed != 0)
            throw Error(where, "the JPEG is damaged: " + printable(std::string_view(tjGetErrorStr2(reader.get()))));
    };
    if (!reader) throw Error(where, "out of memory for the JPEG reader");
    const auto* bytes = reinterpret_cast<const unsigned char*>(encoded.data());
    DecodedImage image;
    int subsampling = 0;
    int colors = 0;
    require(
        tjDecompressHeader3(reader.get(), bytes, encoded.size(), &image.width, &image.height, &subsampling, &colors));
    if (static_cast<std::uint64_t>(image.width) != header->width ||
        static_cast<std::uint64_t>(image.height) != header->height)
        throw Error(where, "the JPEG is damaged: it has two frames");
    takePixels(image, room);
    const bool hasInks = colors == TJCS_CMYK || colors == TJCS_YCCK;
    require(tjDecompress2(
        reader.get(),
        bytes,
        encoded.size(),
        image.pixels.data(),
        image.width,
        0,
        image.height,
        hasInks ? TJPF_CMYK : TJPF_RGBA,
        0));
    if (hasInks) turnInksToLight(image.pixels, header->isAdobe);
    return image;
}

/// Returns the name of an image format, detected by the first bytes of `encoded`. Returns "another format" if they are
/// unknown.
const char* otherFormatOf(std::span<const std::byte> encoded) {
    struct Magic {
        std::size_t offset;
        std::string_view text;
        const char* name;
    };

    constexpr std::array<Magic, 7> kMagics = {
        {{8, "WEBP", "WebP"},
         {1, "KTX 20", "KTX2"},
         {4, "ftypavif", "AVIF"},
         {0, "DDS ", "DDS"},
         {0, "BM", "BMP"},
         {0, "GIF8", "GIF"},
         {0, "II*", "TIFF"}}};
    const std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    for (const Magic& magic : kMagics)
        if (text.size() > magic.offset && text.substr(magic.offset).starts_with(magic.text)) return magic.name;
    return "another format";
}

} // namespace

DecodedImage decodedImage(std::span<const std::byte> encoded, MemoryRoom& room, const std::string& where) {
    constexpr std::array<std::uint8_t, 4> kPng = {0x89, 'P', 'N', 'G'};
    constexpr std::array<std::uint8_t, 3> kJpeg = {0xFF, 0xD8, 0xFF};
    if (beginsWith(encoded, kPng)) return decodedPng(encoded, room, where);
    if (beginsWith(encoded, kJpeg)) return decodedJpeg(encoded, room, where);
    throw LimitError(Limit::Textures, {where, "unknown image format", "a PNG or a JPEG", otherFormatOf(encoded)});
}

} // namespace gnomon::read
