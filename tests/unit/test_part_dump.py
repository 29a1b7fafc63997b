# SPDX-License-Identifier: LGPL-2.1-or-later
"""Locations in OpenCascade's dump: order, powers, cancellation, names that stand for chains.

The rest of the dump is read in tests/in_freecad, where there is one.
"""

from __future__ import annotations

import pytest

from freecad_tetra.brep import part_dump
from freecad_tetra.brep.part_dump import inverse, product
from freecad_tetra.errors import TetraError

# As in Page_046 of the corpus, where an edge is reached through two faces.
LOCATIONS = """ -------
    1 :
Elementary location
(               0               1               0               0  )
(               1               0               0               5  )
(               0               0               1               0  )
    2 :
Elementary location
(               1               0               0               7  )
(               0               1               0               0  )
(               0               0               1               0  )
    3 :
Complex : L2 * L1
(               0               1               0               7  )
(               1               0               0               5  )
(               0               0               1               0  )
    4 :
Complex : L3^-1
    5 :
Complex : L1^-1 * L2^2
"""


def test_chains_are_listed_from_the_inside() -> None:
    places = part_dump._locations(LOCATIONS)
    assert places[1] == ((1, 1),)
    assert places[3] == product(places[1], places[2]) == ((2, 1), (1, 1))
    assert places[4] == inverse(places[3]) == ((1, -1), (2, -1))
    assert places[5] == ((1, -1), (2, 2))


def test_neighbours_cancel() -> None:
    places = part_dump._locations(LOCATIONS)
    assert product(places[3], places[4]) == product(places[4], places[3]) == ()
    assert product(inverse(places[1]), places[3]) == places[2]
    assert product(places[2], places[2]) == ((2, 2),)
    assert product(places[1], places[2]) != product(places[2], places[1])


@pytest.mark.parametrize("text", ["", "Dump of 1 TShapes\n", "Shape : 1\nDump of 0 Locations\n"])
def test_what_is_no_dump_is_refused(text: str) -> None:
    with pytest.raises(TetraError, match="report the version"):
        part_dump.read(text)
