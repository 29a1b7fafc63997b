// SPDX-License-Identifier: LGPL-2.1-or-later
// The compiler gives the arithmetic the kernel counts on: IEEE doubles without hidden digits.
#include <gtest/gtest.h>

#include <limits>

TEST(Platform, DoublesAreIeee) {
    EXPECT_TRUE(std::numeric_limits<double>::is_iec559);
    EXPECT_EQ(std::numeric_limits<double>::digits, 53);
}

TEST(Platform, SumsAreRoundedToDouble) {
    volatile double big = 9007199254740992.0;
    volatile double one = 1.0;
    EXPECT_EQ((big + one) - big, 0.0);
}

TEST(Platform, ProductsAreNotContracted) {
    volatile double x = 1.0 + std::numeric_limits<double>::epsilon();
    volatile double rounded = x * x;
    EXPECT_EQ(x * x - rounded, 0.0);
}
