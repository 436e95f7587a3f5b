// Images of glTF: kinds of PNG and JPEG against their pixels, and images that ask for more memory or work than they
// may.
#include "core/random.h"
#include "preprocess/read/gltf/decoded_image.h"
#include "preprocess/read/gltf/jpeg_header.h"
#include "tests/read/collect.h"

#include <gtest/gtest.h>

#include <png.h>
#include <sys/resource.h>
#include <turbojpeg.h>

namespace gnomon::read {
namespace {

constexpr int kSide = 24;

/// What to write as a PNG: rows of samples in the layout of the type.
struct PngKind {
    int type = PNG_COLOR_TYPE_RGB;
    int bits = 8;
    int interlace = PNG_INTERLACE_NONE;
};

std::size_t samplesOf(int type) {
    switch (type) {
    case PNG_COLOR_TYPE_GRAY_ALPHA:
        return 2;
    case PNG_COLOR_TYPE_RGB:
        return 3;
    case PNG_COLOR_TYPE_RGB_ALPHA:
        return 4;
    default:
        return 1;
    }
}

constexpr std::size_t kPalette = 16;

/// Red, green and blue of entry `i`.
png_color paletteColor(std::size_t i) {
    return {static_cast<png_byte>(7 * i), static_cast<png_byte>(255 - 9 * i), static_cast<png_byte>(i * i)};
}

/// Writes kSide rows, with a gamma that glTF ignores, and `text` as a compressed comment.
std::vector<std::byte> pngOf(const PngKind& kind, std::vector<std::vector<png_byte>> rows, std::string text = "") {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    std::vector<std::byte> bytes;
    const auto write = [](png_structp from, png_bytep data, png_size_t count) {
        auto* out = static_cast<std::vector<std::byte>*>(png_get_io_ptr(from));
        const auto* begin = reinterpret_cast<const std::byte*>(data);
        out->insert(out->end(), begin, begin + count);
    };
    png_set_write_fn(png, &bytes, write, nullptr);
    png_set_IHDR(png, info, kSide, kSide, kind.bits, kind.type, kind.interlace, 0, 0);
    png_set_gAMA(png, info, 1.0);
    if (kind.type == PNG_COLOR_TYPE_PALETTE) {
        std::array<png_color, kPalette> palette{};
        std::array<png_byte, kPalette> alphas{};
        for (std::size_t i = 0; i < kPalette; ++i) {
            palette[i] = paletteColor(i);
            alphas[i] = static_cast<png_byte>(255 - i);
        }
        png_set_PLTE(png, info, palette.data(), kPalette);
        png_set_tRNS(png, info, alphas.data(), kPalette, nullptr);
    }
    std::string key = "Comment";
    png_text comment{};
    comment.compression = PNG_TEXT_COMPRESSION_zTXt;
    comment.key = key.data();
    comment.text = text.data();
    comment.text_length = text.size();
    if (!text.empty()) png_set_text(png, info, &comment, 1);
    std::vector<png_bytep> pointers;
    pointers.reserve(rows.size());
    for (auto& row : rows)
        pointers.push_back(row.data());
    png_set_rows(png, info, pointers.data());
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

/// The RGBA of one pixel of 8-bit samples (16 bits are rounded by the caller).
std::array<int, 4> colorOf(int type, const std::vector<int>& samples) {
    if (type == PNG_COLOR_TYPE_PALETTE) {
        const png_color color = paletteColor(static_cast<std::size_t>(samples[0]));
        return {color.red, color.green, color.blue, 255 - samples[0]};
    }
    if (type == PNG_COLOR_TYPE_GRAY) return {samples[0], samples[0], samples[0], 255};
    if (type == PNG_COLOR_TYPE_GRAY_ALPHA) return {samples[0], samples[0], samples[0], samples[1]};
    return {samples[0], samples[1], samples[2], type == PNG_COLOR_TYPE_RGB ? 255 : samples[3]};
}

std::vector<PngKind> pngKinds() {
    std::vector<PngKind> kinds;
    for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
        kinds.push_back({PNG_COLOR_TYPE_PALETTE, 4, interlace});
        kinds.push_back({PNG_COLOR_TYPE_PALETTE, 8, interlace});
        for (const int bits : {1, 2, 4})
            kinds.push_back({PNG_COLOR_TYPE_GRAY, bits, interlace});
        for (const int bits : {8, 16})
            for (const int type :
                 {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA})
                kinds.push_back({type, bits, interlace});
    }
    return kinds;
}

/// Stores sample `at` of a row.
void putSample(std::vector<png_byte>& row, const PngKind& kind, std::size_t at, unsigned value) {
    if (kind.bits == 16) {
        row[2 * at] = static_cast<png_byte>(value >> 8U);
        row[2 * at + 1] = static_cast<png_byte>(value & 255U);
        return;
    }
    const std::size_t bit = at * static_cast<std::size_t>(kind.bits);
    row[bit / 8] = static_cast<png_byte>(row[bit / 8] | value << (8 - kind.bits - bit % 8));
}

/// Fills a row with random pixels and appends their colours to `expected`.
void fillRow(
    std::vector<png_byte>& row, const PngKind& kind, Random& random, std::vector<std::array<int, 4>>& expected) {
    const std::size_t samples = samplesOf(kind.type);
    const bool isPalette = kind.type == PNG_COLOR_TYPE_PALETTE;
    const double full = (1U << kind.bits) - 1;
    for (std::size_t x = 0; x < kSide; ++x) {
        std::vector<int> pixel;
        for (std::size_t c = 0; c < samples; ++c) {
            const auto value = static_cast<unsigned>(random.below(isPalette ? kPalette : 1U << kind.bits));
            putSample(row, kind, x * samples + c, value);
            pixel.push_back(isPalette ? static_cast<int>(value) : static_cast<int>(std::lround(value * 255 / full)));
        }
        expected.push_back(colorOf(kind.type, pixel));
    }
}

TEST(GltfImages, PngsOfAllKindsHaveTheirPixels) {
    Random random(41);
    MemoryRoom room("m", mebibytes(16));
    for (const PngKind& kind : pngKinds()) {
        SCOPED_TRACE(testing::Message() << kind.type << " " << kind.bits << " " << kind.interlace);
        std::vector<std::vector<png_byte>> rows(kSide, std::vector<png_byte>(kSide * samplesOf(kind.type) * 2, 0));
        std::vector<std::array<int, 4>> expected;
        for (auto& row : rows)
            fillRow(row, kind, random, expected);
        const DecodedImage image = decodedImage(pngOf(kind, rows), room, "x");
        ASSERT_EQ(image.pixels.size(), expected.size() * 4);
        for (std::size_t i = 0; i < expected.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                ASSERT_EQ(image.pixels[4 * i + c], expected[i][c]) << i << " " << c;
    }
}

std::uint64_t peakKibibytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss);
}

TEST(GltfImages, TextsOfAPngAreNotUnpacked) {
    constexpr std::size_t kTextBytes = 4'000'000;
    constexpr int kTexts = 50;
    const std::vector<std::vector<png_byte>> rows(kSide, std::vector<png_byte>(std::size_t{kSide} * 3, 90));
    std::vector<std::byte> png = pngOf({}, rows, std::string(kTextBytes, 'a'));
    const std::array<std::byte, 4> type = {std::byte{'z'}, std::byte{'T'}, std::byte{'X'}, std::byte{'t'}};
    const auto found = std::search(png.begin(), png.end(), type.begin(), type.end());
    ASSERT_NE(found, png.end());
    const auto length = std::to_integer<std::ptrdiff_t>(found[-2]) * 256 + std::to_integer<std::ptrdiff_t>(found[-1]);
    const std::vector<std::byte> chunk(found - 4, found + 8 + length);
    for (int i = 1; i < kTexts; ++i)
        png.insert(png.begin() + 33, chunk.begin(), chunk.end()); // after the header
    MemoryRoom room("m", mebibytes(1));
    const std::uint64_t before = peakKibibytes();
    EXPECT_EQ(decodedImage(png, room, "x").pixels[0], 90);
    EXPECT_LT(peakKibibytes(), before + kTexts * kTextBytes / 1024 / 4);
    EXPECT_EQ(room.taken().count, kSide * kSide * 4U);
}

std::vector<std::byte> jpegOf(
    const std::vector<std::uint8_t>& pixels, int side, int format, int subsampling, int flags = 0) {
    unsigned char* encoded = nullptr;
    unsigned long size = 0;
    void* const writer = tjInitCompress();
    EXPECT_EQ(tjCompress2(writer, pixels.data(), side, 0, side, format, &encoded, &size, subsampling, 95, flags), 0);
    const auto* const begin = reinterpret_cast<const std::byte*>(encoded);
    std::vector<std::byte> bytes(begin, begin + size);
    tjFree(encoded);
    tjDestroy(writer);
    return bytes;
}

std::vector<std::uint8_t> smoothPixels(int side) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (const int value : {4 * x, 4 * y, 128, 255})
                pixels.push_back(static_cast<std::uint8_t>(value));
    return pixels;
}

/// The place of the frame's height and width in a JPEG.
std::size_t sizeInFrame(const std::vector<std::byte>& jpeg) {
    for (std::size_t i = 0; i + 1 < jpeg.size(); ++i)
        if (jpeg[i] == std::byte{0xFF} && (jpeg[i + 1] == std::byte{0xC0} || jpeg[i + 1] == std::byte{0xC2}))
            return i + 5;
    return 0;
}

void setSize(std::vector<std::byte>& jpeg, unsigned height, unsigned width) {
    const std::size_t at = sizeInFrame(jpeg);
    jpeg[at] = static_cast<std::byte>(height >> 8U);
    jpeg[at + 1] = static_cast<std::byte>(height & 255U);
    jpeg[at + 2] = static_cast<std::byte>(width >> 8U);
    jpeg[at + 3] = static_cast<std::byte>(width & 255U);
}

TEST(GltfImages, CoefficientsOfAProgressiveJpegCountAsMemory) {
    struct Sampling {
        int name;
        unsigned across;
        unsigned down;
    };

    for (const auto& [name, across, down] :
         {Sampling{TJSAMP_444, 1, 1},
          Sampling{TJSAMP_422, 2, 1},
          Sampling{TJSAMP_420, 2, 2},
          Sampling{TJSAMP_GRAY, 1, 1}}) {
        std::vector<std::byte> jpeg = jpegOf(smoothPixels(64), 64, TJPF_RGBA, name, TJFLAG_PROGRESSIVE);
        const std::vector<std::byte> plain = jpegOf(smoothPixels(64), 64, TJPF_RGBA, name);
        EXPECT_EQ(jpegHeaderOf(plain)->coefficientBytes, 0U);
        MemoryRoom sufficient("m", mebibytes(1));
        EXPECT_EQ(decodedImage(jpeg, sufficient, "x").pixels, decodedImage(plain, sufficient, "x").pixels);
        for (const auto& [height, width] : {std::pair(64U, 64U), std::pair(10'000U, 9'001U), std::pair(1U, 65'500U)}) {
            setSize(jpeg, height, width);
            // One unit after the other: blocks of brightness, and a block of each colour.
            std::uint64_t blocks = 0;
            for (unsigned y = 0; y < height; y += 8 * down)
                for (unsigned x = 0; x < width; x += 8 * across)
                    blocks += name == TJSAMP_GRAY ? 1 : across * down + 2;
            const std::uint64_t coefficients = blocks * 128;
            EXPECT_EQ(jpegHeaderOf(jpeg)->coefficientBytes, coefficients) << name << " " << height;
            const std::uint64_t pixels = std::uint64_t{height} * width * 4;
            MemoryRoom small("m", {pixels + coefficients - 1});
            const std::string message = errorAbout("x", [&] { decodedImage(jpeg, small, "x"); });
            EXPECT_NE(message.find("the image is too large"), std::string::npos) << message;
            EXPECT_EQ(small.taken().count, 0U);
        }
    }
}

TEST(GltfImages, AJpegOfManyScansIsRefused) {
    std::vector<std::byte> jpeg = jpegOf(smoothPixels(64), 64, TJPF_RGBA, TJSAMP_444, TJFLAG_PROGRESSIVE);
    EXPECT_LT(jpegHeaderOf(jpeg)->scans, 20U);
    const auto isScan = [&](std::size_t at) {
        return at + 1 < jpeg.size() && jpeg[at] == std::byte{0xFF} && jpeg[at + 1] == std::byte{0xDA};
    };
    std::size_t last = jpeg.size() - 2;
    while (!isScan(last))
        --last;
    const std::vector<std::byte> scan(jpeg.begin() + static_cast<std::ptrdiff_t>(last), jpeg.end() - 2);
    for (int i = 0; i < 200; ++i)
        jpeg.insert(jpeg.end() - 2, scan.begin(), scan.end());
    MemoryRoom room("m", mebibytes(1));
    const std::string message = errorAbout("x", [&] { decodedImage(jpeg, room, "x"); });
    EXPECT_NE(message.find(": the JPEG has too many scans: expected 100 at most, found 2"), std::string::npos)
        << message;
}

TEST(GltfImages, InksOfACmykJpegBecomeLight) {
    struct Case {
        std::array<std::uint8_t, 4> inverted; // as Adobe stores it: 255 is no ink
        std::array<int, 3> light;
    };

    for (const auto& [inverted, light] :
         {Case{{255, 255, 255, 255}, {255, 255, 255}},
          Case{{255, 0, 0, 255}, {255, 0, 0}},
          Case{{0, 255, 255, 255}, {0, 255, 255}},
          Case{{255, 255, 255, 0}, {0, 0, 0}},
          Case{{200, 100, 50, 128}, {100, 50, 25}}}) {
        std::vector<std::uint8_t> pixels;
        for (int i = 0; i < 256; ++i)
            pixels.insert(pixels.end(), inverted.begin(), inverted.end());
        MemoryRoom room("m", mebibytes(1));
        const std::vector<std::byte> jpeg = jpegOf(pixels, 16, TJPF_CMYK, TJSAMP_444);
        EXPECT_TRUE(jpegHeaderOf(jpeg)->isAdobe);
        const DecodedImage image = decodedImage(jpeg, room, "x");
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            EXPECT_NEAR(image.pixels[i], i % 4 == 3 ? 255 : light[i % 4], 3) << i;
    }
    EXPECT_FALSE(jpegHeaderOf(jpegOf(smoothPixels(16), 16, TJPF_RGBA, TJSAMP_444))->isAdobe);
}

TEST(GltfImages, CutJpegsHaveNoFrameOrTheSame) {
    const std::vector<std::byte> jpeg = jpegOf(smoothPixels(64), 64, TJPF_RGBA, TJSAMP_420, TJFLAG_PROGRESSIVE);
    for (std::size_t length = 0; length < jpeg.size(); ++length) {
        const auto header = jpegHeaderOf(std::span(jpeg).first(length));
        if (!header) continue;
        EXPECT_EQ(header->width, 64U);
        EXPECT_LE(header->scans, jpegHeaderOf(jpeg)->scans);
    }
}

TEST(GltfImages, OtherFormatsAreNamed) {
    MemoryRoom room("m", mebibytes(1));
    for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{
             {"RIFF1234WEBPVP8 ", "WebP"},
             {"\xABKTX 20\xBB\r\n", "KTX2"},
             {"DDS |   ", "DDS"},
             {"?", "another format"}}) {
        const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
        const std::string message = errorAbout("x", [&] { decodedImage(bytes, room, "x"); });
        EXPECT_NE(message.find("a PNG or a JPEG, found " + name), std::string::npos) << message;
    }
}

} // namespace
} // namespace gnomon::read
