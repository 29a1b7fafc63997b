// SPDX-License-Identifier: LGPL-2.1-or-later
// The attempts at one solid, from the cheapest expected result to the safest.
#include "tetrahedralize_solid.h"

#include <algorithm>
#include <exception>

#include "tetra/assemble/emit_cups.h"

namespace tetra {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

struct Attempt {
    std::size_t frame = 0;
    PullPolicy pull = PullPolicy::automatic;
    CompactLevel compact = CompactLevel::standard;
};

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
        SolidTets result;
        if (succeeds({0, options_.pull_off, options_.compact.level}, result)) return result;
        for (const Attempt& a : further_attempts())
            if (succeeds(a, result)) return result;
        std::rethrow_exception(last_failure_);
    }

  private:
    // Pulling everything needs no direction; when nothing remains, no direction is needed at all.
    void prepare() {
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
            frames_ = choose_frames(input_.grid, owners_, options_, report_.directions, progress_);
        }
    }

    bool succeeds(const Attempt& a, SolidTets& result) {
        try {
            result = attempt(a);
            return true;
        } catch (const VerificationFailed& e) {
            note_failure(a, e.what());
        } catch (const InvalidSolid& e) {
            note_failure(a, e.what());
        }
        return false;
    }

    void note_failure(const Attempt& a, const char* what) {
        std::string name = "direction " + frames_[a.frame].name;
        if (a.pull == PullPolicy::off) name += ", no pull-off";
        if (a.compact == CompactLevel::none) name += ", not compacted";
        report_.repairs.push_back(name + ": " + what);
        last_failure_ = std::current_exception();
    }

    std::vector<Attempt> further_attempts() {
        if (consumed_)
            frames_ = choose_frames(input_.grid, owners_, options_, report_.directions, progress_);
        std::vector<Attempt> list;
        const CompactLevel level = options_.compact.level;
        if (consumed_ || report_.pulled != "none") list.push_back({0, PullPolicy::off, level});
        for (std::size_t f = 1; f < frames_.size(); ++f)
            list.push_back({f, options_.pull_off, level});
        if (level != CompactLevel::none)
            for (std::size_t f = 0; f < frames_.size(); ++f)
                list.push_back({f, PullPolicy::off, CompactLevel::none});
        return list;
    }

    SolidTets attempt(const Attempt& a) {
        const FenceDirection& frame = frames_[a.frame];
        report_.direction = frame.name;
        SolidTets result;
        result.mesh = raw_mesh(frame, a.pull);
        {
            const StageClock::Scope scope(clock_, "compact");
            CompactOptions compact_options = options_.compact;
            compact_options.level = a.compact;
            report_.compact =
                compact(result.mesh, input_.grid, input_.faces, compact_options, progress_);
        }
        std::vector<int> facets;
        {
            const StageClock::Scope scope(clock_, "restore");
            RestoreOptions restore_options;
            restore_options.seed = options_.compact.seed;
            restore_options.quality_below = options_.quality ? 0.05 : 0;
            Restored restored = restore(result.mesh, input_.grid, input_.caller.vertices,
                                        input_.faces, restore_options, progress_);
            result.points = std::move(restored.points);
            facets = std::move(restored.facet_of_triangle);
            report_.restore = std::move(restored.stats);
        }
        drop_unused(result);
        check(result, facets);
        result.report = report_;
        return result;
    }

    ExactMesh raw_mesh(const FenceDirection& frame, PullPolicy policy) {
        const std::vector<Vec3i> framed = to_frame(frame, input_.grid.points);
        PullOff pulled;
        {
            const StageClock::Scope scope(clock_, "pull_off");
            pulled =
                choose_pull(framed, input_.grid, owners_, policy, &everything_, report_, progress_);
        }
        FenceResult fenced;
        if (!pulled.triangles.empty()) {
            const StageClock::Scope scope(clock_, "fence_off");
            fenced = fence_off({framed, pulled.triangles, pulled.owners, {}, {}}, progress_);
            for (HPoint& p : fenced.mesh.points) p = from_frame(frame, p);
        }
        report_.fences = fenced.counts;
        const StageClock::Scope scope(clock_, "emit");
        return emit_cups(fenced, pulled, {input_.grid.points, owner_triangle_, input_.solid});
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
    SolidReport report_;
    std::exception_ptr last_failure_;
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
