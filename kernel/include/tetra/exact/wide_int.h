// SPDX-License-Identifier: LGPL-2.1-or-later
// Fixed-width two's-complement integers of 64-bit limbs, wrapping, without heap.
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstdint>

namespace tetra {

using Int128 = __int128;
using UInt128 = unsigned __int128;

// Value = sum limb[i] * 2^(64 i), the top limb signed. All operations wrap modulo 2^(64 Limbs):
// an intermediate may overflow as long as the final value fits.
template <int Limbs>
struct WideInt {
    std::array<std::uint64_t, Limbs> limb{};

    constexpr WideInt() = default;
    constexpr WideInt(std::int64_t v) {  // NOLINT: implicit like a built-in
        limb.fill(v < 0 ? ~std::uint64_t{0} : 0);
        limb[0] = static_cast<std::uint64_t>(v);
    }
    constexpr WideInt(int v) : WideInt(static_cast<std::int64_t>(v)) {}
    constexpr WideInt(Int128 v) {
        static_assert(Limbs >= 2);
        limb.fill(v < 0 ? ~std::uint64_t{0} : 0);
        limb[0] = static_cast<std::uint64_t>(v);
        limb[1] = static_cast<std::uint64_t>(v >> 64);
    }
    // Sign-extends or truncates.
    template <int Other>
    constexpr explicit WideInt(const WideInt<Other>& v) {
        limb.fill(v.negative() ? ~std::uint64_t{0} : 0);
        for (int i = 0; i < (Limbs < Other ? Limbs : Other); ++i) limb[i] = v.limb[i];
    }

    constexpr bool negative() const { return static_cast<std::int64_t>(limb[Limbs - 1]) < 0; }
    constexpr bool is_zero() const {
        for (std::uint64_t l : limb)
            if (l) return false;
        return true;
    }
    constexpr int sign() const { return negative() ? -1 : (is_zero() ? 0 : 1); }

    friend constexpr WideInt operator+(const WideInt& a, const WideInt& b) {
        WideInt r;
        UInt128 carry = 0;
        for (int i = 0; i < Limbs; ++i) {
            carry += static_cast<UInt128>(a.limb[i]) + b.limb[i];
            r.limb[i] = static_cast<std::uint64_t>(carry);
            carry >>= 64;
        }
        return r;
    }
    friend constexpr WideInt operator-(const WideInt& a, const WideInt& b) {
        WideInt r;
        std::uint64_t borrow = 0;
        for (int i = 0; i < Limbs; ++i) {
            const UInt128 t = static_cast<UInt128>(a.limb[i]) - b.limb[i] - borrow;
            r.limb[i] = static_cast<std::uint64_t>(t);
            borrow = static_cast<std::uint64_t>(t >> 64) ? 1 : 0;
        }
        return r;
    }
    constexpr WideInt operator-() const { return WideInt() - *this; }
    friend constexpr WideInt operator*(const WideInt& a, const WideInt& b) {
        return multiply<Limbs>(a, b);
    }
    constexpr WideInt& operator+=(const WideInt& b) { return *this = *this + b; }
    constexpr WideInt& operator-=(const WideInt& b) { return *this = *this - b; }
    friend constexpr bool operator==(const WideInt& a, const WideInt& b) = default;
    friend constexpr std::strong_ordering operator<=>(const WideInt& a, const WideInt& b) {
        if (a.negative() != b.negative())
            return a.negative() ? std::strong_ordering::less : std::strong_ordering::greater;
        for (int i = Limbs - 1; i >= 0; --i)
            if (a.limb[i] != b.limb[i]) return a.limb[i] <=> b.limb[i];
        return std::strong_ordering::equal;
    }

    // Nearest double up to a relative error of 2^-52.
    double to_double() const {
        const bool minus = negative();
        const WideInt m = minus ? -*this : *this;
        double r = 0;
        for (int i = Limbs - 1; i >= 0; --i) {
            if (r == 0 && m.limb[i] == 0) continue;
            // Two leading limbs hold at least 65 significant bits: the rest is below rounding.
            r = static_cast<double>(m.limb[i]) * 0x1p64 +
                static_cast<double>(i > 0 ? m.limb[i - 1] : 0);
            r = std::ldexp(r, 64 * (i - 1));
            break;
        }
        return minus ? -r : r;
    }

    // Residue modulo p, in 0..p-1.
    constexpr std::uint64_t mod(std::uint64_t p) const {
        const bool minus = negative();
        const WideInt m = minus ? -*this : *this;
        std::uint64_t r = 0;
        for (int i = Limbs - 1; i >= 0; --i)
            r = static_cast<std::uint64_t>(((static_cast<UInt128>(r) << 64) | m.limb[i]) % p);
        return minus && r ? p - r : r;
    }
};

// a * b modulo 2^(64 R), the factors sign-extended first; operand widths may differ.
template <int R, int A, int B>
constexpr WideInt<R> multiply(const WideInt<A>& a, const WideInt<B>& b) {
    const std::uint64_t fill_a = a.negative() ? ~std::uint64_t{0} : 0;
    const std::uint64_t fill_b = b.negative() ? ~std::uint64_t{0} : 0;
    WideInt<R> r;
    for (int i = 0; i < R; ++i) {
        const std::uint64_t x = i < A ? a.limb[i] : fill_a;
        if (x == 0) continue;
        std::uint64_t carry = 0;
        for (int j = 0; i + j < R; ++j) {
            const std::uint64_t y = j < B ? b.limb[j] : fill_b;
            const UInt128 t = static_cast<UInt128>(x) * y + r.limb[i + j] + carry;
            r.limb[i + j] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
    }
    return r;
}

using Int256 = WideInt<4>;
using Int512 = WideInt<8>;

constexpr int sign_of(Int128 v) { return (v > 0) - (v < 0); }

}  // namespace tetra
