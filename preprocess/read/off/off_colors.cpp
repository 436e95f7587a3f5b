#include "preprocess/read/off/off_colors.h"

#include "preprocess/read/color_range.h"

#include <algorithm>

namespace gnomon::read {

void OffColors::add(std::uint64_t row, std::span<const double> values, bool isReal) {
    ++count_;
    isBelowZero_ = isBelowZero_ || std::any_of(values.begin(), values.end(), [](double value) { return value < 0; });
    if (!isReal) {
        packed_.resize(row + 1, 0xFFFFFFFF);
        packed_[row] = packedChannels({values[0], values[1], values[2], values.size() > 3 ? values[3] : 255.0}, 255);
        return;
    }
    maxReal_ = std::max(maxReal_, *std::max_element(values.begin(), values.end()));
    reals_.push_back({row, {values[0], values[1], values[2], values.size() > 3 ? values[3] : -1}});
}

bool OffColors::areRealsBytes() const {
    return fullOfReals(maxReal_) != 1;
}

std::vector<std::uint32_t> OffColors::take(std::uint64_t rows) {
    packed_.resize(rows, 0xFFFFFFFF);
    const double full = fullOfReals(maxReal_);
    for (const RealColor& color : reals_) {
        glm::dvec4 channels(color.channels);
        if (channels.a < 0) channels.a = full;
        packed_[color.row] = packedChannels(channels, full);
    }
    return std::move(packed_);
}

} // namespace gnomon::read
