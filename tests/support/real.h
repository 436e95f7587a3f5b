// A 200-bit floating-point number for the reference versions of the closed forms, correctly rounded by MPFR.
#pragma once

#include <mpfr.h>

namespace gnomon::theory {

class Real {
public:
    static constexpr mpfr_prec_t kBits = 200;

    Real() : Real(0.0) {}

    Real(double value) { // NOLINT(google-explicit-constructor): constants of formulas
        mpfr_init2(value_, kBits);
        mpfr_set_d(value_, value, MPFR_RNDN);
    }

    Real(const Real& other) {
        mpfr_init2(value_, kBits);
        mpfr_set(value_, other.value_, MPFR_RNDN);
    }

    Real(Real&& other) noexcept {
        mpfr_init2(value_, kBits);
        mpfr_swap(value_, other.value_);
    }

    Real& operator=(const Real& other) {
        mpfr_set(value_, other.value_, MPFR_RNDN);
        return *this;
    }

    Real& operator=(Real&& other) noexcept {
        mpfr_swap(value_, other.value_);
        return *this;
    }

    ~Real() { mpfr_clear(value_); }

    /// Returns the nearest double.
    double rounded() const { return mpfr_get_d(value_, MPFR_RNDN); }

    bool isFinite() const { return mpfr_number_p(value_) != 0; }

    Real& operator+=(const Real& b) { return *this = *this + b; }

    Real& operator-=(const Real& b) { return *this = *this - b; }

    friend Real operator+(const Real& a, const Real& b) { return of(mpfr_add, a, b); }

    friend Real operator-(const Real& a, const Real& b) { return of(mpfr_sub, a, b); }

    friend Real operator*(const Real& a, const Real& b) { return of(mpfr_mul, a, b); }

    friend Real operator/(const Real& a, const Real& b) { return of(mpfr_div, a, b); }

    friend Real operator-(const Real& a) { return Real(0.0) - a; }

    friend bool operator<(const Real& a, const Real& b) { return mpfr_less_p(a.value_, b.value_) != 0; }

    friend bool operator>(const Real& a, const Real& b) { return b < a; }

    friend bool operator<=(const Real& a, const Real& b) { return mpfr_lessequal_p(a.value_, b.value_) != 0; }

    friend bool operator>=(const Real& a, const Real& b) { return b <= a; }

    friend bool operator==(const Real& a, const Real& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }

    friend Real power(const Real& a, const Real& b) { return of(mpfr_pow, a, b); }

    friend Real root(const Real& a) { return of(mpfr_sqrt, a); }

    friend Real tangent(const Real& a) { return of(mpfr_tan, a); }

    friend Real logarithm(const Real& a) { return of(mpfr_log, a); }

    friend Real exponential(const Real& a) { return of(mpfr_exp, a); }

    friend Real magnitude(const Real& a) { return of(mpfr_abs, a); }

private:
    template <class Function>
    static Real of(Function function, const Real& a, const Real& b) {
        Real result;
        function(result.value_, a.value_, b.value_, MPFR_RNDN);
        return result;
    }

    template <class Function>
    static Real of(Function function, const Real& a) {
        Real result;
        function(result.value_, a.value_, MPFR_RNDN);
        return result;
    }

    mpfr_t value_{};
};

inline const Real& lesser(const Real& a, const Real& b) {
    return b < a ? b : a;
}

inline const Real& greater(const Real& a, const Real& b) {
    return a < b ? b : a;
}

} // namespace gnomon::theory
