// SPDX-License-Identifier: LGPL-2.1-or-later
// Decomposes the solid of an OFF file by CGAL's convex_decomposition_3, counted and timed.
//
// Usage: cgal_cells FILE.off
// Prints one JSON object: pieces, volume, and processor seconds for reading, making the Nef
// polyhedron, decomposing it, and getting the pieces out. Exit status 1 when CGAL cannot take the
// file.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/IO/Polyhedron_iostream.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/convex_decomposition_3.h>

#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

struct Pieces {
    int count = 0;
    double volume = 0.0;
};

double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The marked volumes; the first volume of a Nef polyhedron is the outer one.
Pieces extract_pieces(Nef& nef) {
    Pieces pieces;
    auto volume = ++nef.volumes_begin();
    for (; volume != nef.volumes_end(); ++volume) {
        if (!volume->mark()) continue;
        Polyhedron piece;
        nef.convert_inner_shell_to_polyhedron(volume->shells_begin(), piece);
        CGAL::Polygon_mesh_processing::triangulate_faces(piece);
        pieces.count += 1;
        pieces.volume += CGAL::to_double(CGAL::Polygon_mesh_processing::volume(piece));
    }
    return pieces;
}

int run(const char* name) {
    const auto start = std::clock();
    std::ifstream file(name);
    Polyhedron polyhedron;
    file >> polyhedron;
    if (!file || polyhedron.empty() || !polyhedron.is_closed()) {
        std::cerr << name << ": not a closed manifold polyhedron\n";
        return 1;
    }
    const double read = seconds_since(start);
    const auto start_nef = std::clock();
    Nef nef(polyhedron);
    const double build = seconds_since(start_nef);
    const auto start_cut = std::clock();
    CGAL::convex_decomposition_3(nef);
    const double decompose = seconds_since(start_cut);
    const auto start_extract = std::clock();
    const Pieces pieces = extract_pieces(nef);
    const double extract = seconds_since(start_extract);
    std::cout.precision(17);
    std::cout << "{\"pieces\": " << pieces.count << ", \"volume\": " << pieces.volume
              << ", \"read\": " << read << ", \"nef\": " << build
              << ", \"decompose\": " << decompose << ", \"extract\": " << extract << "}\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: cgal_cells FILE.off\n";
        return 2;
    }
    try {
        return run(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << argv[1] << ": " << error.what() << '\n';
        return 1;
    }
}
