// SPDX-License-Identifier: LGPL-2.1-or-later
// What the tests of validation share: solids as a caller's doubles, and files of the corpus.
#pragma once

#include <string>
#include <vector>

#include "random_solids.h"
#include "tetra/solid/validate.h"

namespace tetra::testing {

struct Surface {
    std::vector<Vec3d> vertices;
    std::vector<Triangle> triangles;
};

Surface surface_of(const TestSolid& solid);

// All .off files of a folder of the shared corpus, sorted; empty when it is not there.
std::vector<std::string> corpus_files(const std::string& folder);

Surface read_off(const std::string& path);

Validation validated(const Surface& surface, const std::vector<int>& solid = {});

// The kinds of the defects, each once, sorted, with commas.
std::string kinds(const std::vector<Defect>& defects);

// Six times the volume of a surface on its grid.
Int256 volume6(const GridSolid& solid);

}  // namespace tetra::testing
