// SPDX-License-Identifier: LGPL-2.1-or-later
// Disjoint sets of 0..n-1, each led by its lowest member.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace tetra {

struct Groups {
    explicit Groups(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }

    int root(int a) {
        while (parent[static_cast<std::size_t>(a)] != a) {
            int& p = parent[static_cast<std::size_t>(a)];
            a = p = parent[static_cast<std::size_t>(p)];
        }
        return a;
    }

    void join(int a, int b) {
        a = root(a);
        b = root(b);
        if (a != b) parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

    int count() const {
        int n = 0;
        for (std::size_t i = 0; i < parent.size(); ++i) n += parent[i] == static_cast<int>(i);
        return n;
    }

    // The group of each member, numbered by first member.
    std::vector<int> numbers() {
        std::vector<int> number(parent.size());
        int next = 0;
        for (std::size_t i = 0; i < parent.size(); ++i) {
            const int r = root(static_cast<int>(i));
            number[i] = r == static_cast<int>(i) ? next++ : number[static_cast<std::size_t>(r)];
        }
        return number;
    }

    std::vector<int> parent;
};

}  // namespace tetra
