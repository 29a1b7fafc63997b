// SPDX-License-Identifier: LGPL-2.1-or-later
// Evaluates the exact layer line by line, so that Python's integers can judge it.
//
// Each input line is an operation and its operands, whitespace apart; integers are hexadecimal
// with a leading minus where negative, doubles are C hex floats. Each gives one output line.
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "tetra/exact/hpoint.h"

namespace {

using namespace tetra;

template <int Limbs>
WideInt<Limbs> parse(const std::string& text) {
    WideInt<Limbs> r;
    const bool minus = text[0] == '-';
    for (std::size_t i = minus; i < text.size(); ++i) {
        const char c = text[i];
        r = r * WideInt<Limbs>(16) + WideInt<Limbs>(c <= '9' ? c - '0' : c - 'a' + 10);
    }
    return minus ? -r : r;
}

template <int Limbs>
std::string format(const WideInt<Limbs>& v) {
    // The most negative value has no positive counterpart but prints right as unsigned.
    const WideInt<Limbs> m = v.negative() ? -v : v;
    std::string digits;
    for (const std::uint64_t limb : m.limb) {
        char part[17];
        std::snprintf(part, sizeof part, "%016llx", static_cast<unsigned long long>(limb));
        digits = part + digits;
    }
    const std::size_t first = digits.find_first_not_of('0');
    digits = first == std::string::npos ? "0" : digits.substr(first);
    return (v.negative() ? "-" : "") + digits;
}

Int128 low128(const WideInt<4>& v) {
    return static_cast<Int128>((static_cast<UInt128>(v.limb[1]) << 64) | v.limb[0]);
}

struct Line {
    std::istringstream in;
    std::ostringstream out;

    template <int Limbs = 4>
    WideInt<Limbs> wide() {
        std::string text;
        in >> text;
        return parse<Limbs>(text);
    }
    std::int64_t integer() { return static_cast<std::int64_t>(wide<1>().limb[0]); }
    Int128 integer128() { return low128(wide<4>()); }
    Vec3i point() {
        const std::int64_t x = integer(), y = integer(), z = integer();
        return {x, y, z};
    }
    double real() {
        std::string text;
        in >> text;
        return std::stod(text);
    }
    Vec3d point_d() {
        const double x = real(), y = real(), z = real();
        return {x, y, z};
    }
    Plane plane() {
        const Vec3i p = point(), q = point(), r = point();
        return plane_through(p, q, r);
    }
    HPoint meeting() {
        const Plane p = plane(), q = plane(), r = plane();
        return meet(p, q, r);
    }
    template <int Limbs>
    void put(const WideInt<Limbs>& v) {
        out << format(v) << ' ';
    }
    void put(Int128 v) { put(Int256(v)); }
    void put(int v) { put(Int256(v)); }
    void put(std::uint64_t v) { put(Int256(static_cast<Int128>(v))); }
    void put(double v) {
        char text[40];
        std::snprintf(text, sizeof text, "%a ", v);
        out << text;
    }
    void put(const Plane& p) {
        put(Int256(p.a));
        put(Int256(p.b));
        put(Int256(p.c));
        put(p.d);
    }
    void put(const HPoint& p) {
        put(p.x);
        put(p.y);
        put(p.z);
        put(p.w);
    }
};

int order(const Int256& a, const Int256& b) { return a < b ? -1 : (b < a ? 1 : 0); }

using Operation = std::function<void(Line&)>;

std::map<std::string, Operation> wide_operations() {
    std::map<std::string, Operation> all;
    const auto binary = [&](const char* name, auto f) {
        all[name] = [f](Line& l) {
            const Int256 a = l.wide(), b = l.wide();
            l.put(f(a, b));
        };
    };
    binary("add", [](auto& a, auto& b) { return a + b; });
    binary("sub", [](auto& a, auto& b) { return a - b; });
    binary("mul", [](auto& a, auto& b) { return a * b; });
    binary("mul8", [](auto& a, auto& b) { return multiply<8>(a, b); });
    binary("order", [](auto& a, auto& b) { return order(a, b); });
    binary("equal", [](auto& a, auto& b) { return static_cast<int>(a == b); });
    binary("mul_mixed", [](auto& a, auto& b) { return multiply<4>(WideInt<2>(a), WideInt<1>(b)); });
    all["neg"] = [](Line& l) { l.put(-l.wide()); };
    all["sign"] = [](Line& l) { l.put(l.wide().sign()); };
    all["mod"] = [](Line& l) {
        const Int256 a = l.wide();
        l.put(a.mod(l.wide<1>().limb[0]));
    };
    all["to_double"] = [](Line& l) { l.put(l.wide().to_double()); };
    all["to_double8"] = [](Line& l) { l.put(l.wide<8>().to_double()); };
    all["narrow"] = [](Line& l) { l.put(Int256(l.wide<8>())); };
    all["widen"] = [](Line& l) { l.put(Int512(l.wide())); };
    all["from128"] = [](Line& l) { l.put(Int512(l.integer128())); };
    all["from64"] = [](Line& l) { l.put(Int512(l.integer())); };
    return all;
}

std::map<std::string, Operation> geometric_operations() {
    std::map<std::string, Operation> all;
    const auto of_four = [](auto f) {
        return [f](Line& l) {
            const Vec3i a = l.point(), b = l.point(), c = l.point(), d = l.point();
            l.put(f(a, b, c, d));
        };
    };
    all["orient3d"] = of_four(orient3d);
    all["det3"] = of_four(det3_of_points);
    all["orient2d"] = [](Line& l) {
        const Vec3i a = l.point(), b = l.point(), c = l.point();
        for (int k = 0; k < 3; ++k) l.put(orient2d(a, b, c, k, (k + 1) % 3));
        l.put(static_cast<int>(collinear(a, b, c)));
    };
    all["plane"] = [](Line& l) { l.put(l.plane()); };
    all["opposite"] = [](Line& l) { l.put(opposite(l.plane())); };
    all["plane_value"] = [](Line& l) {
        const Plane p = l.plane();
        l.put(plane_value(p, l.point()));
    };
    all["intern"] = [](Line& l) {
        PlaneTable table;
        for (std::int64_t count = l.integer(); count > 0; --count) {
            const Plane plane = l.plane();
            const PlaneKey key = table.intern(plane);
            l.put(key.id);
            l.put(key.side);
            const Plane stored = key.side > 0 ? table[key.id] : opposite(table[key.id]);
            l.put(static_cast<int>(stored == plane));
        }
        l.put(table.size());
    };
    all["gcd"] = [](Line& l) {
        const Int128 a = l.integer128(), b = l.integer128();
        l.put(static_cast<Int128>(gcd(static_cast<UInt128>(a), static_cast<UInt128>(b))));
    };
    all["meet_edge"] = [](Line& l) {
        const Plane p = l.plane();
        const Vec3i u = l.point(), v = l.point();
        l.put(meet(u, v, plane_value(p, u), plane_value(p, v)));
    };
    all["meet"] = [](Line& l) { l.put(l.meeting()); };
    all["det_normals"] = [](Line& l) {
        const Plane p = l.plane(), q = l.plane(), r = l.plane();
        l.put(det_normals(p, q, r));
    };
    all["side"] = [](Line& l) {
        const HPoint h = l.meeting();
        l.put(side_of_plane(l.plane(), h));
    };
    all["side_edge"] = [](Line& l) {
        const Plane p = l.plane();
        const Vec3i u = l.point(), v = l.point();
        const HPoint h = meet(u, v, plane_value(p, u), plane_value(p, v));
        l.put(side_of_plane(l.plane(), h));
        l.put(side_of_plane(p, h));
    };
    all["side_point"] = [](Line& l) {
        const HPoint h = hpoint(l.point());
        l.put(side_of_plane(l.plane(), h));
    };
    all["same"] = [](Line& l) {
        const HPoint p = l.meeting(), q = l.meeting();
        l.put(static_cast<int>(same_point(p, q)));
    };
    all["residues"] = [](Line& l) {
        for (const std::uint64_t r : residues(l.meeting())) l.put(r);
    };
    all["doubles"] = [](Line& l) {
        for (const double c : to_doubles(l.meeting())) l.put(c);
    };
    all["multiply_mod"] = [](Line& l) {
        const std::uint64_t a = l.wide<1>().limb[0], b = l.wide<1>().limb[0];
        l.put(multiply_mod(a, b));
        l.put(inverse_mod(a));
    };
    return all;
}

// grid BITS COUNT points...: step, origin, then per point its snap and the unsnapped place.
void grid_operation(Line& l) {
    const auto bits = static_cast<int>(l.integer());
    std::vector<Vec3d> points(static_cast<std::size_t>(l.integer()));
    for (Vec3d& p : points) p = l.point_d();
    const Grid grid = grid_for(points, bits);
    l.put(grid.step);
    for (const double c : grid.origin) l.put(c);
    for (const Vec3d& p : points) {
        const Vec3i s = snap(grid, p);
        for (const std::int64_t c : s) l.put(Int256(c));
        for (const double c : unsnap(grid, {double(s[0]), double(s[1]), double(s[2])})) l.put(c);
    }
}

}  // namespace

int main() {
    std::map<std::string, Operation> operations = wide_operations();
    operations.merge(geometric_operations());
    operations["grid"] = grid_operation;
    std::ios::sync_with_stdio(false);
    std::string text;
    while (std::getline(std::cin, text)) {
        Line line;
        line.in.str(text);
        std::string name;
        line.in >> name;
        const auto found = operations.find(name);
        if (found == operations.end()) {
            std::cerr << "unknown operation " << name << '\n';
            return 2;
        }
        found->second(line);
        std::cout << line.out.str() << '\n';
    }
    return 0;
}
