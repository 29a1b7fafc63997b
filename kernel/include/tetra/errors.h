// SPDX-License-Identifier: LGPL-2.1-or-later
// Typed failures of the kernel, carrying the vertices and triangles at fault.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tetra {

// One thing wrong with a solid; ids are those of the caller's arrays, base 0.
struct Defect {
    std::string kind;
    std::vector<int> vertices;
    std::vector<int> triangles;
    std::string message;
};

struct InvalidSolid : std::runtime_error {
    explicit InvalidSolid(std::vector<Defect> list)
        : std::runtime_error(list.empty() ? "invalid solid" : list.front().message),
          defects(std::move(list)) {}
    std::vector<Defect> defects;
};

// The result of a stage did not pass the kernel's own check; nothing may be handed out.
struct VerificationFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace tetra
