#include "render/picture.h"

#include "core/check.h"
#include "core/error.h"
#include "core/file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <span>
#include <utility>

#include <png.h>

namespace gnomon::render {

namespace {

std::string sizeText(const Picture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

} // namespace

namespace {

/// A picture in the structure that libpng requires.
class PngImage {
public:
    PngImage(const Picture& picture, const std::optional<Coverage>& coverage) : pixels_(picture.pixels.data()) {
        image_.version = PNG_IMAGE_VERSION;
        image_.width = static_cast<png_uint_32>(picture.width);
        image_.height = static_cast<png_uint_32>(picture.height);
        image_.format = coverage ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
        if (!coverage) return;
        GNOMON_CHECK_OP(coverage->pixels.size(), ==, picture.pixels.size());
        withAlpha_.reserve(picture.pixels.size());
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            const Rgb& color = picture.pixels[i];
            withAlpha_.push_back({color[0], color[1], color[2], coverage->pixels[i]});
        }
        pixels_ = withAlpha_.data();
    }

    /// Writes the picture as a PNG file to the memory `to`. If `to` is null, the function only computes the size of the
    /// file.
    void write(void* to, png_alloc_size_t& size) {
        require(png_image_write_to_memory(&image_, to, &size, 0, pixels_, 0, nullptr) != 0);
    }

    void write(std::FILE* to) { require(png_image_write_to_stdio(&image_, to, 0, pixels_, 0, nullptr) != 0); }

private:
    void require(bool isDone) const {
        if (!isDone) throw Error(std::string("a picture cannot be written as PNG: ") + image_.message);
    }

    png_image image_{};
    const void* pixels_;
    std::vector<std::array<std::uint8_t, 4>> withAlpha_;
};

/// A C stream (FILE*) that writes to an object of class File.
class FileStream {
public:
    explicit FileStream(File& file)
        : file_(&file), stream_(::fopencookie(this, "w", {nullptr, &FileStream::put, nullptr, nullptr})) {
        if (stream_ == nullptr) throw std::bad_alloc();
    }

    ~FileStream() {
        if (stream_ != nullptr) std::fclose(stream_);
    }

    FileStream(const FileStream&) = delete;
    FileStream& operator=(const FileStream&) = delete;
    FileStream(FileStream&&) = delete;
    FileStream& operator=(FileStream&&) = delete;

    std::FILE* stream() { return stream_; }

    /// Flushes and closes the stream. Throws the first error that occurred during writing.
    void close() {
        std::fclose(std::exchange(stream_, nullptr));
        rethrow();
    }

    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    static ssize_t put(void* self, const char* bytes, std::size_t size) {
        auto& stream = *static_cast<FileStream*>(self);
        try {
            stream.file_->writeAt(stream.end_, std::as_bytes(std::span(bytes, size)));
        } catch (const Error&) {
            stream.failure_ = std::current_exception();
            return 0;
        }
        stream.end_ += size;
        return static_cast<ssize_t>(size);
    }

    File* file_;
    std::uint64_t end_ = 0;
    std::exception_ptr failure_;
    std::FILE* stream_;
};

} // namespace

std::vector<std::uint8_t> pngBytes(const Picture& picture, const std::optional<Coverage>& coverage) {
    PngImage image(picture, coverage);
    png_alloc_size_t size = 0;
    image.write(nullptr, size);
    std::vector<std::uint8_t> bytes(size);
    image.write(bytes.data(), size);
    bytes.resize(size);
    return bytes;
}

void writePng(const std::string& path, const Picture& picture, const std::optional<Coverage>& coverage) {
    AtomicFile file(path);
    FileStream stream(file.file()); // the stream writes the file in parts, so that the whole file is never in memory
    try {
        PngImage(picture, coverage).write(stream.stream());
    } catch (const Error&) {
        stream.rethrow(); // the error of the file is more precise than the error of libpng
        throw;
    }
    stream.close();
    file.commit();
}

Coverage coverageOf(const FloatPicture& depth) {
    Coverage coverage(depth.width, depth.height);
    for (std::size_t i = 0; i < depth.pixels.size(); ++i)
        if (std::isfinite(depth.pixels[i])) coverage.pixels[i] = 255;
    return coverage;
}

Picture readPng(const std::string& path) {
    const std::string text = readTextFile(path);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, text.data(), text.size()) == 0)
        throw Error(path, std::string("cannot be read as PNG: ") + image.message);
    image.format = PNG_FORMAT_RGB;
    Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
    const bool done = png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) != 0;
    png_image_free(&image);
    if (!done) throw Error(path, std::string("cannot be read as PNG: ") + image.message);
    return picture;
}

void writePfm(const std::string& path, const FloatPicture& picture) {
    static_assert(std::endian::native == std::endian::little, "the header below says little-endian");
    const std::string header =
        "Pf\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
    const std::size_t rowBytes = static_cast<std::size_t>(picture.width) * sizeof(float);
    std::vector<std::byte> bytes(header.size() + rowBytes * static_cast<std::size_t>(picture.height));
    std::memcpy(bytes.data(), header.data(), header.size());
    std::byte* row = bytes.data() + header.size();
    for (int y = picture.height - 1; y >= 0; --y, row += rowBytes)
        std::memcpy(row, picture.pixels.data() + picture.index(0, y), rowBytes);
    AtomicFile file(path);
    file.file().writeAt(0, bytes);
    file.commit();
}

PictureDifference difference(const Picture& a, const Picture& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error("pictures", "they differ in size", sizeText(a), sizeText(b));
    constexpr int kVisibleLevels = 2;
    std::uint64_t sum = 0;
    int largest = 0;
    std::uint64_t changed = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        int worst = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const int apart = std::abs(int{a.pixels[i][c]} - int{b.pixels[i][c]});
            sum += static_cast<std::uint64_t>(apart);
            worst = std::max(worst, apart);
        }
        largest = std::max(largest, worst);
        changed += worst > kVisibleLevels ? 1U : 0U;
    }
    const auto count = static_cast<double>(a.pixels.size());
    return {static_cast<double>(sum) / (count * 3 * 255), largest / 255.0, static_cast<double>(changed) / count};
}

void requireAlike(const NamedPicture& reference, const Picture& picture, double threshold) {
    const double found = difference(reference.picture, picture).mean;
    if (found > threshold)
        throw Error(
            reference.path,
            "the picture differs from its reference",
            "a mean difference of at most " + std::to_string(threshold),
            std::to_string(found));
}

} // namespace gnomon::render
