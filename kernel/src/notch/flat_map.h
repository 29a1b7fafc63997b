// SPDX-License-Identifier: LGPL-2.1-or-later
// A small open-addressing map from 64-bit keys to ints.
#pragma once

#include <cstdint>
#include <vector>

namespace tetra::notch {

// Keys must not be ~0. References stay valid until the next insert.
class FlatMap {
  public:
    FlatMap() : keys_(64, kEmpty), values_(64) {}

    // The value of a key, -1 when it is not there.
    int find(std::uint64_t key) const {
        for (std::size_t i = mix(key);; ++i) {
            i &= keys_.size() - 1;
            if (keys_[i] == key) return values_[i];
            if (keys_[i] == kEmpty) return -1;
        }
    }
    void insert(std::uint64_t key, int value) {
        if (2 * (count_ + 1) > keys_.size()) grow();
        for (std::size_t i = mix(key);; ++i) {
            i &= keys_.size() - 1;
            if (keys_[i] == kEmpty) {
                keys_[i] = key;
                ++count_;
            }
            if (keys_[i] == key) {
                values_[i] = value;
                return;
            }
        }
    }

  private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    static std::size_t mix(std::uint64_t k) {
        k ^= k >> 33;
        k *= 0xff51afd7ed558ccdu;
        k ^= k >> 29;
        return static_cast<std::size_t>(k);
    }
    void grow() {
        std::vector<std::uint64_t> keys(keys_.size() * 2, kEmpty);
        std::vector<int> values(keys.size());
        keys.swap(keys_);
        values.swap(values_);
        count_ = 0;
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (keys[i] != kEmpty) insert(keys[i], values[i]);
    }
    std::vector<std::uint64_t> keys_;
    std::vector<int> values_;
    std::size_t count_ = 0;
};

inline std::uint64_t pair_key(int a, int b) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 |
           static_cast<std::uint32_t>(b);
}

}  // namespace tetra::notch
