#include "executor/light/picture_sum.h"

#include "core/check.h"
#include "executor/light/light_model.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace gnomon::executor {

namespace {

constexpr std::uint32_t kFull = 65535;
constexpr std::size_t kGrain = 16384;

std::uint32_t linearOf(double level) {
    return static_cast<std::uint32_t>(std::lround(linearFromDisplay(static_cast<float>(level / 255)) * kFull));
}

/// The light of each byte, and the byte nearest to each light, as a screen's levels count.
struct Transfer {
    std::array<std::uint32_t, 256> linear{};
    std::array<std::uint8_t, kFull + 1> display{};

    Transfer() {
        for (std::size_t byte = 0; byte < linear.size(); ++byte)
            linear[byte] = linearOf(static_cast<double>(byte));
        std::uint32_t light = 0;
        for (std::size_t byte = 0; byte < linear.size(); ++byte) {
            const std::uint32_t end = byte == 255 ? kFull + 1 : linearOf(static_cast<double>(byte) + 0.5);
            for (; light < end; ++light)
                display[light] = static_cast<std::uint8_t>(byte);
        }
    }
};

const Transfer& transfer() {
    static const Transfer all;
    return all;
}

template <class Work>
void forAll(std::size_t pixels, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            work(i);
    });
}

} // namespace

void PictureSum::reset() {
    count_ = 0;
}

void PictureSum::add(const Picture& picture, const std::optional<Coverage>& coverage) {
    GNOMON_CHECK(count_ < kMost);
    if (count_ == 0) {
        sums_ = Raster<Sums>(picture.width, picture.height);
        covered_ = coverage ? Raster<std::uint16_t>(picture.width, picture.height) : Raster<std::uint16_t>();
    }
    GNOMON_CHECK(picture.pixels.size() == sums_.pixels.size() && coverage.has_value() == !covered_.pixels.empty());
    const auto& linear = transfer().linear;
    forAll(picture.pixels.size(), [&](std::size_t i) {
        if (coverage) {
            if (coverage->pixels[i] == 0) return;
            ++covered_.pixels[i];
        }
        for (std::size_t c = 0; c < 3; ++c)
            sums_.pixels[i][c] += linear[picture.pixels[i][c]];
    });
    ++count_;
}

Picture PictureSum::mean() const {
    GNOMON_CHECK(count_ > 0);
    const auto& display = transfer().display;
    Picture mean(sums_.width, sums_.height);
    forAll(mean.pixels.size(), [&](std::size_t i) {
        const std::uint32_t count = covered_.pixels.empty() ? static_cast<std::uint32_t>(count_) : covered_.pixels[i];
        if (count == 0) return;
        for (std::size_t c = 0; c < 3; ++c)
            mean.pixels[i][c] = display[(sums_.pixels[i][c] + count / 2) / count];
    });
    return mean;
}

std::optional<Coverage> PictureSum::coverage() const {
    if (covered_.pixels.empty()) return std::nullopt;
    const auto count = static_cast<std::uint32_t>(count_);
    Coverage coverage(covered_.width, covered_.height);
    forAll(coverage.pixels.size(), [&](std::size_t i) {
        coverage.pixels[i] = static_cast<std::uint8_t>((255 * std::uint32_t{covered_.pixels[i]} + count / 2) / count);
    });
    return coverage;
}

} // namespace gnomon::executor
