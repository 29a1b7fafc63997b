// SPDX-License-Identifier: LGPL-2.1-or-later
// Conversions and files for the tests of validation.
#include "solid_support.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "tetra/exact/predicates.h"

namespace tetra::testing {

Surface surface_of(const TestSolid& solid) {
    Surface s;
    for (const Vec3i& p : solid.points)
        s.vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    s.triangles = solid.triangles;
    return s;
}

std::vector<std::string> corpus_files(const std::string& folder) {
    const std::filesystem::path path = std::filesystem::path(TETRA_SHARED_DIR) / "corpus" / folder;
    std::vector<std::string> files;
    if (!std::filesystem::exists(path)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(path))
        if (entry.path().extension() == ".off") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

Surface read_off(const std::string& path) {
    std::ifstream in(path);
    std::string word;
    std::size_t n = 0, m = 0, edges = 0;
    in >> word >> n >> m >> edges;
    Surface s;
    s.vertices.resize(n);
    s.triangles.resize(m);
    for (Vec3d& p : s.vertices) in >> p[0] >> p[1] >> p[2];
    for (Triangle& t : s.triangles) {
        int corners = 0;
        in >> corners >> t[0] >> t[1] >> t[2];
    }
    return s;
}

Validation validated(const Surface& surface, const std::vector<int>& solid) {
    Progress progress;
    return validate(surface.vertices, surface.triangles, solid, {}, progress);
}

std::string kinds(const std::vector<Defect>& defects) {
    std::set<std::string> names;
    for (const Defect& d : defects) names.insert(d.kind);
    std::string text;
    for (const std::string& n : names) text += (text.empty() ? "" : ",") + n;
    return text;
}

Int256 volume6(const GridSolid& solid) {
    Int256 sum = 0;
    for (const Triangle& t : solid.triangles)
        sum += Int256(det3_of_points({0, 0, 0}, solid.points[static_cast<std::size_t>(t[0])],
                                     solid.points[static_cast<std::size_t>(t[1])],
                                     solid.points[static_cast<std::size_t>(t[2])]));
    return sum;
}

}  // namespace tetra::testing
