// SPDX-License-Identifier: LGPL-2.1-or-later
// Development tool: fences OFF files along the three axes, checks exactly and prints the counts.
//
// Usage: fence_driver [--bits B] [--no-keep] [--no-check] [--axis x|y|z] FILE...
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numeric>
#include <sstream>

#include "fence_check.h"
#include "tetra/errors.h"
#include "tetra/solid/snap.h"

namespace {

struct Options {
    int bits = 20;
    bool keep = true, check = true;
    std::string axes = "xyz";
    std::vector<std::string> files;
};

struct Surface {
    std::vector<tetra::Vec3d> vertices;
    std::vector<tetra::Triangle> triangles;
};

Surface read_off(const std::string& path) {
    std::ifstream file(path);
    std::string text, line;
    while (std::getline(file, line)) text += line.substr(0, line.find('#')) + "\n";
    std::istringstream in(text);
    std::string magic;
    int n = 0, m = 0, e = 0;
    in >> magic >> n >> m >> e;
    Surface s;
    s.vertices.resize(static_cast<std::size_t>(n));
    for (auto& v : s.vertices) in >> v[0] >> v[1] >> v[2];
    for (int i = 0; i < m; ++i) {
        int k = 0;
        tetra::Triangle t{};
        in >> k >> t[0] >> t[1] >> t[2];
        s.triangles.push_back(t);
        std::getline(in, line);
    }
    return s;
}

void run(const std::string& path, const Options& options) {
    const Surface surface = read_off(path);
    const tetra::SurfaceView view{surface.vertices, surface.triangles, {}, {}};
    const tetra::GridSolid solid = tetra::build_grid_solid(view, options.bits);
    const std::string name = path.substr(path.rfind('/') + 1);
    for (const char axis : options.axes) {
        tetra::FenceInput input;
        const auto shift = static_cast<std::size_t>(axis - 'x' + 1);
        for (const tetra::Vec3i& p : solid.points)
            input.points.push_back({p[shift % 3], p[(shift + 1) % 3], p[(shift + 2) % 3]});
        input.triangles = solid.triangles;
        if (!options.keep) input.keep.assign(solid.points.size(), 0);
        tetra::Progress progress;
        const auto start = std::chrono::steady_clock::now();
        try {
            const tetra::FenceResult r = tetra::fence_off(input, progress);
            const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
            const std::string fault =
                options.check ? tetra::testing::fence_fault(input, r) : std::string();
            std::printf(
                "%s %c tri %zu cells %d base %d tets %zu steiner %d cyclic %d propagated %d "
                "walls %d seconds %.3f %s\n",
                name.c_str(), axis, solid.triangles.size(), r.counts.cells, r.counts.base_triangles,
                r.mesh.tets.size(), r.counts.steiner_points, r.counts.cyclic_columns,
                r.counts.propagated, r.counts.wall_sides, seconds.count(),
                options.check ? (fault.empty() ? "OK" : fault.c_str()) : "-");
        } catch (const tetra::InvalidSolid& error) {
            std::printf("%s %c INVALID %s (%zu triangles, first %d)\n", name.c_str(), axis,
                        error.what(), error.defects.front().triangles.size(),
                        error.defects.front().triangles.empty()
                            ? -1
                            : error.defects.front().triangles.front());
        } catch (const std::exception& error) {
            std::printf("%s %c ERROR %s\n", name.c_str(), axis, error.what());
        }
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string arg = argv[i];
        if (arg == "--bits" && i + 1 < argc)
            options.bits = std::stoi(argv[++i]);
        else if (arg == "--axis" && i + 1 < argc)
            options.axes = argv[++i];
        else if (arg == "--no-keep")
            options.keep = false;
        else if (arg == "--no-check")
            options.check = false;
        else
            options.files.push_back(arg);
    }
    for (const std::string& file : options.files) run(file, options);
}
