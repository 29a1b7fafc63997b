# SPDX-License-Identifier: LGPL-2.1-or-later
"""WideInt against Python's integers, at signs and limb boundaries first."""

from __future__ import annotations

import itertools
import random
from fractions import Fraction

import pytest
from exact_probe import evaluate

PRIME = 2**61 - 1


def wrap(value: int, bits: int) -> int:
    """The two's-complement value of so many bits."""
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value


def boundary_values(bits: int) -> list[int]:
    near = {0, 1, 2, 3, 5, 10}
    for power in (31, 32, 52, 53, 54, 61, 63, 64, 65, 127, 128, 129, 191, 192, 193, 254, 255):
        if power < bits:
            near |= {2**power - 1, 2**power, 2**power + 1, 3 * 2**power}
    values = {wrap(sign * v, bits) for v in near for sign in (1, -1)}
    return sorted(values | {-(2 ** (bits - 1)), 2 ** (bits - 1) - 1})


def random_value(rng: random.Random, bits: int) -> int:
    """Any size up to `bits` with signs, and runs of zeros or ones as carries need them."""
    value = rng.getrandbits(rng.randint(1, bits - 1))
    if rng.random() < 0.3:
        low = rng.randint(0, bits - 2)
        value = (value >> low << low) if rng.random() < 0.5 else value | ((1 << low) - 1)
    return wrap(value if rng.random() < 0.5 else -value, bits)


def pairs() -> list[tuple[int, int]]:
    rng = random.Random(1)
    some = [(random_value(rng, 256), random_value(rng, 256)) for _ in range(3000)]
    return list(itertools.product(boundary_values(256), repeat=2)) + some


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("add", lambda a, b: wrap(a + b, 256)),
        ("sub", lambda a, b: wrap(a - b, 256)),
        ("mul", lambda a, b: wrap(a * b, 256)),
        ("mul8", lambda a, b: a * b),
        ("order", lambda a, b: (a > b) - (a < b)),
        ("equal", lambda a, b: int(a == b)),
        ("mul_mixed", lambda a, b: wrap(wrap(a, 128) * wrap(b, 64), 256)),
    ],
)
def test_binary_operations(name, expected):
    cases = pairs()
    for (a, b), (result,) in zip(cases, evaluate(name, cases)):
        assert result == expected(a, b), (hex(a), hex(b))


@pytest.mark.parametrize(
    ("name", "bits", "expected"),
    [
        ("neg", 256, lambda a: wrap(-a, 256)),
        ("sign", 256, lambda a: (a > 0) - (a < 0)),
        ("widen", 256, lambda a: a),
        ("narrow", 512, lambda a: wrap(a, 256)),
        ("from128", 128, lambda a: a),
        ("from64", 64, lambda a: a),
    ],
)
def test_unary_operations(name, bits, expected):
    rng = random.Random(2)
    values = boundary_values(bits) + [random_value(rng, bits) for _ in range(1000)]
    for a, (result,) in zip(values, evaluate(name, [(v,) for v in values])):
        assert result == expected(a), hex(a)


def test_mod():
    rng = random.Random(3)
    values = boundary_values(256) + [random_value(rng, 256) for _ in range(1000)]
    values += [PRIME * random_value(rng, 190) for _ in range(50)]
    cases = [(v, m) for v in values for m in (PRIME, 1, 2, 3, 2**32, 2**63 - 25)]
    for (a, m), (result,) in zip(cases, evaluate("mod", cases)):
        assert result == a % m, (hex(a), m)


@pytest.mark.parametrize(("name", "bits"), [("to_double", 256), ("to_double8", 512)])
def test_to_double(name, bits):
    rng = random.Random(4)
    values = boundary_values(bits) + [random_value(rng, bits) for _ in range(3000)]
    for a, (result,) in zip(values, evaluate(name, [(v,) for v in values])):
        if abs(a) < 2**53:
            assert result == a
        else:
            assert abs(Fraction(result) - a) <= abs(Fraction(a)) * Fraction(1, 2**52), hex(a)


def test_gcd():
    import math

    rng = random.Random(5)
    cases = [(a, b) for a in (0, 1, 2, 2**63, 2**64, 2**126) for b in (0, 1, 6, 2**64, 3 * 2**90)]
    for _ in range(2000):
        g = rng.getrandbits(rng.randint(1, 60))
        cases.append((g * rng.getrandbits(60), g * rng.getrandbits(60)))
    for (a, b), (result,) in zip(cases, evaluate("gcd", cases)):
        assert result == math.gcd(a, b)


def test_modular_arithmetic():
    rng = random.Random(6)
    values = [0, 1, 2, PRIME - 1, PRIME - 2, 2**60] + [rng.randrange(PRIME) for _ in range(300)]
    cases = [(a, rng.choice(values)) for a in values] + [(PRIME - 1, PRIME - 1)]
    for (a, b), (product, inverse) in zip(cases, evaluate("multiply_mod", cases)):
        assert product == a * b % PRIME
        assert inverse == (pow(a, -1, PRIME) if a else 0)
