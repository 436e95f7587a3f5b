// Simple 256-bit integers, wide enough for all products of the predicate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::exact {

class WideInteger {
public:
    WideInteger(std::int64_t value = 0) { // NOLINT(google-explicit-constructor): stands for a built-in integer
        const auto bits = static_cast<std::uint64_t>(value);
        limbs_.fill(value < 0 ? ~0U : 0U);
        limbs_[0] = static_cast<std::uint32_t>(bits);
        limbs_[1] = static_cast<std::uint32_t>(bits >> 32U);
    }

    friend WideInteger operator+(const WideInteger& a, const WideInteger& b) {
        WideInteger sum;
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < kLimbs; ++i) {
            carry += std::uint64_t{a.limbs_[i]} + b.limbs_[i];
            sum.limbs_[i] = static_cast<std::uint32_t>(carry);
            carry >>= 32U;
        }
        return sum;
    }

    friend WideInteger operator-(const WideInteger& a) {
        WideInteger flipped;
        for (std::size_t i = 0; i < kLimbs; ++i)
            flipped.limbs_[i] = ~a.limbs_[i];
        return flipped + WideInteger(1);
    }

    friend WideInteger operator-(const WideInteger& a, const WideInteger& b) { return a + -b; }

    friend WideInteger operator*(const WideInteger& a, const WideInteger& b) {
        WideInteger product;
        for (std::size_t i = 0; i < kLimbs; ++i) {
            std::uint64_t carry = 0;
            for (std::size_t j = 0; i + j < kLimbs; ++j) {
                carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j];
                product.limbs_[i + j] = static_cast<std::uint32_t>(carry);
                carry >>= 32U;
            }
        }
        return product;
    }

    /// Returns 1, 0 or -1.
    int sign() const {
        if ((limbs_.back() >> 31U) != 0) return -1;
        for (const std::uint32_t limb : limbs_)
            if (limb != 0) return 1;
        return 0;
    }

private:
    static constexpr std::size_t kLimbs = 8;
    std::array<std::uint32_t, kLimbs> limbs_{}; // two's complement, least significant first
};

} // namespace gnomon::exact
