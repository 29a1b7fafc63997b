// SPDX-License-Identifier: LGPL-2.1-or-later
// Orientation by floating-point expansions (Shewchuk 1997) and by Laplace's rule in wide integers.
#include "tetra/assemble/double_predicates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace tetra {
namespace {

// A sum of doubles of increasing magnitude that do not overlap: its sign is that of the last one.
template <int Capacity>
struct Expansion {
    std::array<double, Capacity> term;
    int size = 0;

    void push(double v) {
        if (v != 0) term[static_cast<std::size_t>(size++)] = v;
    }
    double operator[](int i) const { return term[static_cast<std::size_t>(i)]; }
    int sign() const {
        return size == 0 ? 0 : (term[static_cast<std::size_t>(size - 1)] > 0 ? 1 : -1);
    }
};

struct Sum {
    double value, error;
};

Sum two_sum(double a, double b) {
    const double s = a + b;
    const double bb = s - a;
    return {s, (a - (s - bb)) + (b - bb)};
}

Sum two_product(double a, double b) {
    const double p = a * b;
    return {p, std::fma(a, b, -p)};
}

Expansion<2> difference(double a, double b) {
    const Sum s = two_sum(a, -b);
    Expansion<2> r;
    r.push(s.error);
    r.push(s.value);
    return r;
}

// Adds one double to an expansion.
template <int C>
void grow(Expansion<C>& e, double b) {
    double carry = b;
    int n = 0;
    for (int i = 0; i < e.size; ++i) {
        const Sum s = two_sum(carry, e[i]);
        if (s.error != 0) e.term[static_cast<std::size_t>(n++)] = s.error;
        carry = s.value;
    }
    if (carry != 0) e.term[static_cast<std::size_t>(n++)] = carry;
    e.size = n;
}

template <int A, int B>
Expansion<A + B> operator+(const Expansion<A>& a, const Expansion<B>& b) {
    Expansion<A + B> r;
    std::copy_n(a.term.begin(), a.size, r.term.begin());
    r.size = a.size;
    for (int i = 0; i < b.size; ++i) grow(r, b[i]);
    return r;
}

template <int A, int B>
Expansion<2 * A * B> operator*(const Expansion<A>& a, const Expansion<B>& b) {
    Expansion<2 * A * B> r;
    for (int i = 0; i < a.size; ++i)
        for (int j = 0; j < b.size; ++j) {
            const Sum p = two_product(a[i], b[j]);
            grow(r, p.error);
            grow(r, p.value);
        }
    return r;
}

template <int A>
Expansion<A> negated(Expansion<A> a) {
    for (int i = 0; i < a.size; ++i) a.term[static_cast<std::size_t>(i)] = -a[i];
    return a;
}

int orient3d_expansions(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    std::array<std::array<Expansion<2>, 3>, 3> m;
    const Vec3d* rows[3] = {&b, &c, &d};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) m[i][k] = difference((*rows[i])[k], a[k]);
    const auto minor = [&](std::size_t u, std::size_t v) {
        return m[0][u] * m[1][v] + negated(m[0][v] * m[1][u]);
    };
    const auto det = minor(1, 2) * m[2][0] + minor(2, 0) * m[2][1] + minor(0, 1) * m[2][2];
    return det.sign();
}

int bit_length(const Int256& v) {
    const Int256 m = v.negative() ? -v : v;
    for (int i = 3; i >= 0; --i)
        if (m.limb[static_cast<std::size_t>(i)])
            return 64 * i + std::bit_width(m.limb[static_cast<std::size_t>(i)]);
    return 0;
}

// Laplace's rule over the rows (a, b) and (c, d): minors of Half limbs, products of twice that.
template <int Half>
int laplace_sign(const HPoint& a, const HPoint& b, const HPoint& c, const HPoint& d) {
    constexpr int kFull = 2 * Half;
    const Int256* row[4][4] = {{&a.x, &a.y, &a.z, &a.w},
                               {&b.x, &b.y, &b.z, &b.w},
                               {&c.x, &c.y, &c.z, &c.w},
                               {&d.x, &d.y, &d.z, &d.w}};
    const auto minor = [&](int r, int u, int v) {
        return multiply<Half>(*row[r][u], *row[r + 1][v]) -
               multiply<Half>(*row[r][v], *row[r + 1][u]);
    };
    const auto term = [&](int u, int v, int s, int t) {
        return multiply<kFull>(minor(0, u, v), minor(2, s, t));
    };
    const WideInt<kFull> det = term(0, 1, 2, 3) - term(0, 2, 1, 3) + term(0, 3, 1, 2) +
                               term(1, 2, 0, 3) - term(1, 3, 0, 2) + term(2, 3, 0, 1);
    // Rows (p, w): det[a;b;c;d] = -w_a w_b w_c w_d det(b-a, c-a, d-a).
    return -det.sign();
}

}  // namespace

double det3_of_points(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
    return (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
}

int orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
    const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
    const double det = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
    const double permanent = (std::fabs(yz) + std::fabs(zy)) * std::fabs(wx) +
                             (std::fabs(zx) + std::fabs(xz)) * std::fabs(wy) +
                             (std::fabs(xy) + std::fabs(yx)) * std::fabs(wz);
    // Three rounded differences, products and sums: below 8 half-ulps of the permanent.
    const double bound = 0x1p-49 * permanent;
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return orient3d_expansions(a, b, c, d);
}

int orient3d(const HPoint& a, const HPoint& b, const HPoint& c, const HPoint& d) {
    int xyz = 0, w = 0;
    for (const HPoint* p : {&a, &b, &c, &d}) {
        xyz = std::max({xyz, bit_length(p->x), bit_length(p->y), bit_length(p->z)});
        w = std::max(w, bit_length(p->w));
    }
    // |minor of xyz| < 2^(2 xyz + 1), |determinant| < 24 * 2^(3 xyz + w).
    if (2 * xyz + 1 < 256 && xyz + w + 1 < 256 && 3 * xyz + w + 5 < 512)
        return laplace_sign<4>(a, b, c, d);
    return laplace_sign<8>(a, b, c, d);
}

}  // namespace tetra
