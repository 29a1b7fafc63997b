// SPDX-License-Identifier: LGPL-2.1-or-later
// The attempts at one solid, from the cheapest expected result to the safest.
#include "tetrahedralize_solid.h"

#include <algorithm>
#include <exception>

#include "cell_tets.h"
#include "tetra/assemble/emit_cups.h"
#include "tetra/solid/conform_contacts.h"

namespace tetra {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

struct Attempt {
    std::size_t frame = 0;
    PullPolicy pull = PullPolicy::automatic;
    CompactLevel compact = CompactLevel::standard;
    int other_seed = 0;
};

// How far a verified mesh is from the promise that input vertices come back bit for bit and other
// points lie on the caller's surface.
int imperfection(const SolidTets& tets) {
    return tets.report.restore.vertices_on_grid + tets.report.restore.steiner_off_plane;
}

// How many imperfect meshes are made before the best of them is taken: it is luck, which is cheap
// for small solids.
int most_imperfect(const GridSolid& solid) {
    const std::size_t size = solid.triangles.size();
    return size < 10000 ? 20 : (size < 100000 ? 6 : 2);
}
constexpr int kOtherSeeds = 10;
constexpr std::size_t kPlaneChoices = 3;

class SolidWorker {
  public:
    SolidWorker(const SolidInput& input, const TetOptions& options, StageClock& clock,
                Progress& progress)
        : input_(input), options_(options), clock_(clock), progress_(progress) {
        owners_ = facet_owners(input.grid.points, input.grid.triangles, input.faces, {});
        for (std::size_t t = 0; t < owners_.size(); ++t)
            if (index(owners_[t]) >= owner_triangle_.size())
                owner_triangle_.push_back(static_cast<int>(t));
        triangles_ = input.grid.triangles;
        for (Triangle& t : triangles_)
            for (int& v : t) v = input.grid.point_source[index(v)];
        report_.solid = input.solid;
        report_.grid_bits = input.grid.grid.bits;
    }

    SolidTets run() {
        prepare();
        const CompactLevel level = options_.compact.level;
        bool done = tries({0, options_.pull_off, level, 0});
        if (!done)
            for (const Attempt& a : further_attempts())
                if ((done = tries(a))) break;
        if (!best_) std::rethrow_exception(last_failure_);
        best_->report.repairs = std::move(report_.repairs);
        best_->report.directions = std::move(report_.directions);
        return std::move(*best_);
    }

  private:
    bool by_cells() const { return options_.method == TetMethod::bajaj_dey; }

    // Pulling everything needs no direction; when nothing remains, no direction is needed at all.
    void prepare() {
        if (by_cells()) {
            frames_.resize(kPlaneChoices);
            for (FenceDirection& frame : frames_) frame.name = "none needed";
            return;
        }
        if (options_.pull_off != PullPolicy::off) {
            const StageClock::Scope scope(clock_, "pull_off");
            everything_ =
                pull_off(input_.grid.points, input_.grid.triangles, owners_, {}, progress_);
            consumed_ = everything_.triangles.empty();
        }
        if (consumed_) {
            frames_.push_back({});
            frames_.front().name = "none needed";
        } else {
            const StageClock::Scope scope(clock_, "direction");
            frames_ =
                choose_frames(input_.grid, owners_, options_, 1, report_.directions, progress_);
        }
    }

    // True when nothing is left to wish for.
    bool tries(const Attempt& a) {
        if (a.compact != options_.compact.level && best_) return true;
        if (a.other_seed > 0 && !best_) return false;
        try {
            SolidTets result = attempt(a);
            const int score = imperfection(result);
            if (score > 0) {
                ++imperfect_;
                report_.repairs.push_back(name_of(a) + ": " + std::to_string(score) +
                                          " points could not be restored");
            }
            if (!best_ || score < imperfection(*best_)) best_ = std::move(result);
            return score == 0 || imperfect_ >= most_imperfect(input_.grid);
        } catch (const VerificationFailed& e) {
            note_failure(a, e.what());
        } catch (const InvalidSolid& e) {
            note_failure(a, e.what());
        }
        return false;
    }

    std::string name_of(const Attempt& a) const {
        std::string name = "direction " + frames_[a.frame].name;
        if (by_cells()) name = "choice of planes " + std::to_string(a.frame);
        if (a.pull == PullPolicy::off) name += ", no pull-off";
        if (a.compact == CompactLevel::none) name += ", not compacted";
        if (a.other_seed > 0) name += ", other seed";
        return name;
    }

    void note_failure(const Attempt& a, const char* what) {
        report_.repairs.push_back(name_of(a) + ": " + what);
        last_failure_ = std::current_exception();
    }

    std::vector<Attempt> further_attempts() {
        if (consumed_)
            frames_ =
                choose_frames(input_.grid, owners_, options_, 1, report_.directions, progress_);
        std::vector<Attempt> list;
        const CompactLevel level = options_.compact.level;
        if (level != CompactLevel::none)
            for (const int seed : {1, 2}) list.push_back({0, options_.pull_off, level, seed});
        if (consumed_ || report_.pulled != "none") list.push_back({0, PullPolicy::off, level, 0});
        for (std::size_t f = 1; f < frames_.size(); ++f)
            list.push_back({f, options_.pull_off, level, 0});
        if (level != CompactLevel::none)
            for (int seed = 3; seed <= kOtherSeeds; ++seed)
                list.push_back({0, options_.pull_off, level, seed});
        if (level != CompactLevel::none)
            for (std::size_t f = 0; f < frames_.size(); ++f)
                list.push_back({f, PullPolicy::off, CompactLevel::none, 0});
        return list;
    }

    SolidTets attempt(const Attempt& a) {
        const FenceDirection& frame = frames_[a.frame];
        report_.direction = frame.name;
        SolidTets result;
        result.mesh = by_cells() ? mesh_of_cells(a.frame) : raw_mesh(frame, a.pull);
        {
            const StageClock::Scope scope(clock_, "compact");
            CompactOptions compact_options = options_.compact;
            compact_options.level = a.compact;
            compact_options.seed += static_cast<std::uint64_t>(a.other_seed);
            report_.compact =
                compact(result.mesh, input_.grid, input_.faces, compact_options, progress_);
        }
        std::vector<int> facets;
        {
            const StageClock::Scope scope(clock_, "restore");
            RestoreOptions restore_options;
            restore_options.seed = options_.compact.seed + static_cast<std::uint64_t>(a.other_seed);
            restore_options.quality_below = options_.quality ? 0.05 : 0;
            Restored restored = restore(result.mesh, input_.grid, input_.caller.vertices,
                                        input_.faces, restore_options, progress_);
            result.points = std::move(restored.points);
            facets = std::move(restored.facet_of_triangle);
            report_.restore = std::move(restored.stats);
        }
        drop_unused(result);
        locate_sources(result.mesh, input_.grid, owners_);
        check(result, facets);
        result.report = report_;
        return result;
    }

    // As for cells: common vertices on both sides of every contact help where facets of one solid
    // touch.
    Polyhedra cut_cells(const CellsOptions& options, CellsStats& stats) const {
        try {
            return exact_cells(input_.grid, options, stats, progress_);
        } catch (const VerificationFailed&) {
            return exact_cells(conform_contacts(input_.grid), options, stats, progress_);
        }
    }

    // Cells by another choice among equally good planes each time.
    const ExactMesh& mesh_of_cells(std::size_t choice) {
        if (cells_mesh_ && cells_choice_ == choice) return *cells_mesh_;
        Polyhedra cells;
        CellsStats stats;
        {
            const StageClock::Scope scope(clock_, "notch_cutting");
            CellsOptions cut;
            cut.seed = choice;
            cells = cut_cells(cut, stats);
        }
        const StageClock::Scope scope(clock_, "overlay");
        CellTetCounts counts{stats.notches, stats.planes, stats.cuts, stats.raw_cells, 0, 0, 0};
        cells_mesh_ =
            tets_of_cells(input_.grid, owners_, {cells}, {input_.solid}, counts, progress_);
        cells_choice_ = choice;
        report_.cells = counts;
        report_.pulled = "none";
        return *cells_mesh_;
    }

    ExactMesh raw_mesh(const FenceDirection& frame, PullPolicy policy) {
        const std::vector<Vec3i> framed = to_frame(frame, input_.grid.points);
        PullOff pulled;
        {
            const StageClock::Scope scope(clock_, "pull_off");
            pulled =
                choose_pull(framed, input_.grid, owners_, policy, &everything_, report_, progress_);
        }
        try {
            FenceResult fenced;
            if (!pulled.triangles.empty()) {
                const StageClock::Scope scope(clock_, "fence_off");
                fenced = fence_off({framed, pulled.triangles, pulled.owners, {}, {}}, progress_);
                for (HPoint& p : fenced.mesh.points) p = from_frame(frame, p);
            }
            report_.fences = fenced.counts;
            const StageClock::Scope scope(clock_, "emit");
            return emit_cups(fenced, pulled, {input_.grid.points, owner_triangle_, input_.solid});
        } catch (const InvalidSolid& error) {
            throw InvalidSolid(named_by_caller(error.defects, pulled));
        }
    }

    // Vertices are named as points of the grid, triangles as those that pulling left: their facets
    // are the caller's unless a cup made them.
    std::vector<Defect> named_by_caller(std::vector<Defect> defects, const PullOff& pulled) const {
        for (Defect& d : defects) {
            for (int& v : d.vertices) v = input_.grid.point_source[index(v)];
            std::erase_if(d.triangles,
                          [&](int t) { return pulled.owners[index(t)] >= pulled.first_cup; });
            for (int& t : d.triangles)
                t = input_.grid
                        .triangle_source[index(owner_triangle_[index(pulled.owners[index(t)])])];
        }
        return defects;
    }

    // Points that no tetrahedron uses any more leave; the caller's vertices get their names.
    void drop_unused(SolidTets& result) const {
        ExactMesh& mesh = result.mesh;
        std::vector<int> place(mesh.points.size(), -1);
        for (const auto& tet : mesh.tets)
            for (const int p : tet) place[index(p)] = 0;
        std::size_t count = 0;
        for (std::size_t p = 0; p < place.size(); ++p) {
            if (place[p] < 0) continue;
            place[p] = static_cast<int>(count);
            mesh.points[count] = mesh.points[p];
            mesh.carriers[count] = mesh.carriers[p];
            result.points[count++] = result.points[p];
        }
        mesh.points.resize(count);
        mesh.carriers.resize(count);
        result.points.resize(count);
        for (auto& tet : mesh.tets)
            for (int& p : tet) p = place[index(p)];
        for (Triangle& t : mesh.skin)
            for (int& p : t) p = place[index(p)];
        for (const Carrier& c : mesh.carriers)
            result.point_source.push_back(
                c.kind == CarrierKind::vertex ? input_.grid.point_source[index(c.first)] : -1);
    }

    void check(const SolidTets& result, const std::vector<int>& facets) {
        const StageClock::Scope scope(clock_, "verify");
        const ExactMesh& mesh = result.mesh;
        CheckTolerance tolerance;
        tolerance.step = input_.grid.grid.step;
        report_.check =
            verify_mesh({result.points, mesh.tets, mesh.tet_solid, mesh.skin, mesh.skin_source,
                         result.point_source},
                        {input_.caller.vertices, triangles_, facets, input_.grid.point_source},
                        tolerance, progress_);
    }

    const SolidInput& input_;
    const TetOptions& options_;
    StageClock& clock_;
    Progress& progress_;
    std::vector<int> owners_, owner_triangle_;
    std::vector<Triangle> triangles_;  // of the caller's vertices
    std::vector<FenceDirection> frames_;
    PullOff everything_;
    bool consumed_ = false;
    std::optional<ExactMesh> cells_mesh_;
    std::size_t cells_choice_ = 0;
    SolidReport report_;  // of the attempt under way
    std::exception_ptr last_failure_;
    std::optional<SolidTets> best_;
    int imperfect_ = 0;
};

}  // namespace

StageClock::Scope::Scope(StageClock& clock, const char* stage)
    : clock_(clock), stage_(stage), start_(std::chrono::steady_clock::now()) {}

StageClock::Scope::~Scope() {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    for (auto& [name, seconds] : clock_.seconds)
        if (name == stage_) {
            seconds += spent.count();
            return;
        }
    clock_.seconds.emplace_back(stage_, spent.count());
}

SolidTets tetrahedralize_solid(const SolidInput& input, const TetOptions& options,
                               StageClock& clock, Progress& progress) {
    return SolidWorker(input, options, clock, progress).run();
}

}  // namespace tetra
