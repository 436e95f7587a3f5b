// A point of a search: numbers from 0 to 1 from which a case is drawn, as from a generator.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::torture {

/// Answers as gnomon::Random does, by the genes in order; a half once they are used up.
class Genes {
public:
    explicit Genes(std::span<const double> values) : values_(values) {}

    /// In [0, 1).
    double unit() { return next_ < values_.size() ? std::clamp(values_[next_++], 0.0, 0x1.fffffffffffffp-1) : 0.5; }

    double uniform(double low, double high) { return low + (high - low) * unit(); }

    std::uint64_t below(std::uint64_t count) {
        return std::min(count - 1, static_cast<std::uint64_t>(unit() * static_cast<double>(count)));
    }

    /// A seed for what is too much for genes of its own.
    std::uint64_t seed() { return static_cast<std::uint64_t>(unit() * 0x1p32); }

private:
    std::span<const double> values_;
    std::size_t next_ = 0;
};

} // namespace gnomon::torture
