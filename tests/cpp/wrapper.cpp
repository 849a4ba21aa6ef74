// The C++ layer: everything in it is used, errors carry their detail, exceptions cross the callback intact.
#include "../c/common.h"
#include <fairmesh.hpp>

namespace {

struct broken : std::runtime_error {
    int number;
    explicit broken(int which) : std::runtime_error("broken"), number(which) {}
};

using positions_t = std::vector<std::array<double, 3>>;

struct scene {
    positions_t positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint8_t> mask;
};

scene cap(std::size_t side, bool as_roof = false) {
    Cap c = cap_new(side);
    if (as_roof) cap_as_roof(&c);
    scene s;
    for (std::size_t v = 0; v < c.vertices; v++) {
        s.positions.push_back({c.positions[3 * v], c.positions[3 * v + 1], c.positions[3 * v + 2]});
        s.mask.push_back(c.free_mask[v]);
    }
    for (std::size_t t = 0; t < c.triangles; t++) {
        s.triangles.push_back({c.corners[3 * t], c.corners[3 * t + 1], c.corners[3 * t + 2]});
    }
    cap_free(&c);
    return s;
}

void fairing() {
    auto s = cap(15);
    auto mesh = fairmesh::mesh(s.positions, s.triangles);
    auto found = fairmesh::fair(mesh, fairmesh::free_mask(s.mask));
    CHECK(found.report().outcome == FAIRMESH_OUTCOME_CONVERGED);
    CHECK(found.info().kind == FAIRMESH_RESULT_KIND_FAIRED);
    auto x = found.positions();
    CHECK(off_sphere(x.data()->data(), x.size()) < 2e-3);
    auto boundary = found.list(FAIRMESH_LIST_BOUNDARY_VERTICES);
    auto normals = found.vectors(FAIRMESH_VECTORS_BOUNDARY_NORMALS);
    CHECK(boundary.size() == normals.size() && !boundary.empty());
    auto h = found.scalars(FAIRMESH_SCALARS_MEAN_CURVATURE);
    CHECK(h.size() == s.positions.size());

    auto part = found.component(0);
    CHECK(part.attempt_count >= 1 && part.bending_energy > 0);
    auto last = found.attempt(0, part.attempt_count - 1);
    CHECK(last.end == FAIRMESH_ATTEMPT_END_SOUND && last.free_vertices == part.free_vertices && last.name[0] != 0);

    // In place, with a callback, and by a list.
    std::vector<std::uint32_t> list;
    for (std::uint32_t v = 0; v < s.mask.size(); v++) {
        if (s.mask[v]) list.push_back(v);
    }
    fairmesh::options options;
    int calls = 0;
    options.on_progress = [&](const fairmesh_progress &) { return ++calls, true; };
    auto report = fairmesh::fair(mesh, fairmesh::free_vertices(list), options,
                                 fairmesh::points_out(s.positions.data()->data(), s.positions.size()));
    CHECK(report.outcome == FAIRMESH_OUTCOME_CONVERGED && calls > 0 && s.positions == x);
    CHECK(fairmesh::mean_curvature(mesh).size() == s.positions.size());
    CHECK(fairmesh::memory_needed(mesh, fairmesh::interior()) > fairmesh::memory_needed(mesh, fairmesh::free_vertices(list)));
    fairmesh::set_log(nullptr);
    CHECK(report.intersections_checked && report.intersection_count == 0);
    CHECK(fairmesh::self_intersections(mesh).empty() && fairmesh::self_intersections(mesh, {0, 1}).empty());
    std::vector<std::uint32_t> all(s.triangles.size());
    for (std::uint32_t t = 0; t < all.size(); t++) all[t] = t;
    CHECK(fairmesh::fair(mesh, fairmesh::faces(all)).report().free_vertices == 13 * 13);
    CHECK(fairmesh::fair(mesh).report().free_vertices == 13 * 13);
}

void errors() {
    auto s = cap(9);
    s.triangles[17][1] = 4711;
    try {
        fairmesh::fair(fairmesh::mesh(s.positions, s.triangles), fairmesh::free_mask(s.mask));
        CHECK(false);
    } catch (const fairmesh::error &e) {
        CHECK(e.status() == FAIRMESH_STATUS_INDEX_OUT_OF_RANGE && e.detail().element == 17);
        CHECK(e.detail().element_kind == FAIRMESH_ELEMENT_TRIANGLE && std::string(e.what()).find("4711") != std::string::npos);
    }
}

void exceptions() {
    auto s = cap(15);
    auto mesh = fairmesh::mesh(s.positions, s.triangles);
    fairmesh::options options;
    std::uint64_t seen = 0;
    bool armed = true;
    options.on_progress = [&](const fairmesh_progress &p) -> bool {
        seen = p.iterations;
        if (armed && p.iterations == 2) throw broken(42);
        return true;
    };
    auto before = s.positions;
    try {
        fairmesh::fair(mesh, fairmesh::free_mask(s.mask), options);
        CHECK(false);
    } catch (const broken &b) {
        CHECK(b.number == 42 && seen == 2 && s.positions == before);
    }
    // A solver outlives it, also when it moves.
    fairmesh::solver first(mesh, fairmesh::free_mask(s.mask), options);
    fairmesh::solver solver(std::move(first));
    try {
        solver.run();
        CHECK(false);
    } catch (const broken &b) {
        CHECK(b.number == 42 && seen == 2);
    }
    armed = false;
    CHECK(solver.run().outcome == FAIRMESH_OUTCOME_CONVERGED);
    auto found = solver.snapshot().positions();
    CHECK(off_sphere(found.data()->data(), found.size()) < 2e-3);
}

double farthest(const positions_t &a, const positions_t &b) {
    double most = 0;
    for (std::size_t v = 0; v < a.size(); v++) {
        for (std::size_t k = 0; k < 3; k++) most = std::max(most, std::abs(a[v][k] - b[v][k]));
    }
    return most;
}

/** A boundary vertex tilted and back, a handle moved, and a bulge within its range. */
void live() {
    auto s = cap(21);
    const auto mesh = fairmesh::mesh(s.positions, s.triangles);
    fairmesh::solver solver(mesh, fairmesh::free_mask(s.mask));
    const auto at = [&solver] { return solver.snapshot().positions(); };
    solver.finish();
    const auto first = at();
    std::vector<std::uint32_t> fixed;
    for (std::uint32_t v = 0; v < s.mask.size(); v++) {
        if (!s.mask[v]) fixed.push_back(v);
    }
    std::uint32_t on_boundary = 0;
    for (const auto &t : s.triangles) {
        for (std::size_t k = 0; k < 3; k++) {
            if (!s.mask[t[k]] && s.mask[t[(k + 1) % 3]]) on_boundary = t[k];
        }
    }
    solver.edit({fairmesh::tilt(on_boundary, 0.1, 0.5), fairmesh::twist(on_boundary, 0.05)});
    CHECK(solver.update({3}).evaluations <= 3);
    CHECK(solver.update().is_settled == 1);
    CHECK(solver.finish().outcome == FAIRMESH_OUTCOME_CONVERGED);
    CHECK(farthest(at(), first) > 1e-3);
    solver.edit({fairmesh::moved(fixed, {0.0, 0.0, 2.0})});
    CHECK(solver.finish().outcome == FAIRMESH_OUTCOME_CONVERGED);
    auto moved = at();
    for (auto &p : moved) p[2] -= 2.0;
    CHECK(farthest(moved, first) < 1e-6);
    solver.edit({});
    const auto range = solver.bulge_range();
    CHECK(range[0] < 0 && range[1] > 0);
    solver.edit({fairmesh::bulge(range[1] / 2)});
    CHECK(solver.finish().outcome == FAIRMESH_OUTCOME_CONVERGED);
    try {
        solver.edit({fairmesh::tilt(UINT32_MAX, 0.1)});
        CHECK(false);
    } catch (const fairmesh::error &e) {
        CHECK(e.status() == FAIRMESH_STATUS_SELECTION_OUT_OF_RANGE);
    }
}

void continuing_curvature() {
    auto s = cap(31);
    auto mesh = fairmesh::mesh(s.positions, s.triangles);
    fairmesh::options options;
    CHECK(options.continuity == FAIRMESH_CONTINUITY_AUTO);
    options.continuity = 0;
    auto plain = fairmesh::fair(mesh, fairmesh::free_mask(s.mask), options);
    CHECK(plain.component(0).continuity_count == 0);
    auto boundary = plain.list(FAIRMESH_LIST_BOUNDARY_VERTICES);
    const std::vector<float> given(boundary.size(), -1.25f);
    options.continuity = 0.5;
    options.boundary_curvature.kind = FAIRMESH_BOUNDARY_CURVATURE_KIND_GIVEN;
    options.boundary_curvature.values = fairmesh::numbers(given.data(), given.size());
    options.boundary_curvature.vertices = fairmesh::indices(boundary.data(), boundary.size());
    auto found = fairmesh::fair(mesh, fairmesh::free_mask(s.mask), options);
    CHECK(found.component(0).continuity_count == 1);
    auto loop = found.continuity(0, 0);
    CHECK(loop.vertex_count == boundary.size() && loop.vertex == boundary[0]);
    CHECK(std::abs(loop.curvature - 1.25) < 1e-6 && loop.reached <= 0.5 && loop.jump < loop.jump_before);
    fairmesh::solver solver(mesh, fairmesh::free_mask(s.mask), options);
    solver.run();
    CHECK(solver.snapshot().continuity(0, 0).jump == loop.jump);
    const double some[] = {0.25};
    const std::uint32_t at[] = {boundary.front()};
    fairmesh_loop_continuity of_loops{fairmesh::numbers(some, 1), fairmesh::indices(at, 1)};
    solver.set_continuity(0.5, of_loops);
    solver.run();
    CHECK(solver.snapshot().continuity(0, 0).reached <= 0.25);
    solver.set_continuity(0.0);
    solver.run();
    CHECK(solver.snapshot().component(0).continuity_count == 0);
    solver.set_boundary_curvature(fairmesh_boundary_curvature{});
    options.continuity = 0.0;
    options.loop_continuity = of_loops;
    CHECK(fairmesh::fair(mesh, fairmesh::free_mask(s.mask), options).continuity(0, 0).reached <= 0.25);
}

void continuing_edges() {
    auto s = cap(15, true);
    fairmesh::options options;
    options.sharp = FAIRMESH_SHARP_AUTO;
    auto found = fairmesh::fair(fairmesh::mesh(s.positions, s.triangles), fairmesh::free_mask(s.mask), options);
    CHECK(found.report().sharp_edge_count == 1);
    auto edge = found.sharp_edge(0);
    CHECK(edge.fate == FAIRMESH_SHARP_FATE_GOES_ON && edge.end_count == 2);
    CHECK(edge.vertex_count == found.list(FAIRMESH_LIST_SHARP_VERTICES).size());
    CHECK(std::abs(found.crease_end(0, 1).angle - 90) < 1e-6);
}

void stepping() {
    auto s = cap(15);
    fairmesh::solver solver(fairmesh::mesh(s.positions, s.triangles), fairmesh::free_mask(s.mask));
    CHECK(solver.run(1).outcome == FAIRMESH_OUTCOME_ITERATION_LIMIT && solver.snapshot().report().iterations == 1);
    CHECK(solver.run().outcome == FAIRMESH_OUTCOME_CONVERGED);
    const auto found = solver.snapshot();
    CHECK(found.attempt(0, found.component(0).attempt_count - 1).end == FAIRMESH_ATTEMPT_END_SOUND);
    solver.set_target(fairmesh_target{FAIRMESH_TARGET_KIND_CONSTANT, 0, 1.0});
    CHECK(solver.run().outcome == FAIRMESH_OUTCOME_CONVERGED);
    solver.set_boundary_normals(fairmesh_boundary_normals{FAIRMESH_BOUNDARY_NORMALS_KIND_AVERAGED, 0, {}, {}});
    CHECK(solver.run().outcome != FAIRMESH_OUTCOME_CANCELLED);
    std::vector<float> x(3 * s.positions.size()), h(s.positions.size());
    solver.positions(fairmesh::points_out(x.data(), h.size()));
    solver.snapshot().scalars(FAIRMESH_SCALARS_MEAN_CURVATURE, fairmesh::scalars_out(h.data(), h.size()));
    CHECK(x[0] == static_cast<float>(s.positions[0][0]) && h[112] < 0.0f);
}

void holes() {
    auto s = cap(15);
    std::vector<std::array<std::uint32_t, 3>> left;
    for (auto &t : s.triangles) {
        if (!s.mask[t[0]] && !s.mask[t[1]] && !s.mask[t[2]]) left.push_back(t);
    }
    auto mesh = fairmesh::mesh(s.positions, left);
    auto loops = fairmesh::boundary_loops(mesh);
    CHECK(loops.info().loop_count == 2 && loops.loop(0).vertex_count == loops.list(FAIRMESH_LIST_LOOP_VERTICES, 0).size());
    fairmesh::fill_options fill;
    fill.density = 2.0;
    auto filled = fairmesh::fill_holes(mesh, fill);
    CHECK(filled.triangles().size() == filled.info().triangle_count && filled.positions().size() > s.positions.size());
    CHECK(filled.list(FAIRMESH_LIST_PARENTS).size() == 3 * filled.vectors(FAIRMESH_VECTORS_PARENT_WEIGHTS).size());
    bool faired = false;
    for (std::uint64_t k = 0; k < 2; k++) faired |= filled.fill_report(k).outcome == FAIRMESH_FILL_OUTCOME_FAIRED;
    CHECK(faired);
    auto anew = fairmesh::remesh(fairmesh::mesh(s.positions, s.triangles), fairmesh::free_mask(s.mask));
    CHECK(!anew.list(FAIRMESH_LIST_FREE_VERTICES).empty());
}

/* The unit sphere without a band, whole again. */
void check_whole_sphere(const fairmesh::result &filled) {
    const auto x = filled.positions();
    const auto t = filled.triangles();
    CHECK(fairmesh::boundary_loops(fairmesh::mesh(x, t)).info().loop_count == 0 && x.size() == t.size() / 2 + 2);
    CHECK(off_sphere(x.data()->data(), x.size()) < 1e-8);
}

void joins() {
    Ball ball;
    ball_make(&ball);
    const fairmesh::loop_groups both{{0, 1}};
    CHECK(fairmesh::suggest_joins(ball.mesh) == both);
    const auto components = fairmesh::components(ball.mesh);
    CHECK(components.size() == BALL_TRIANGLES && components.front() == 0 && components.back() == 1);
    fairmesh::fill_options fill;
    fill.join_groups({{1, 0}});
    fill.only({});
    fill.on_failure = FAIRMESH_ON_FAILURE_OPEN;
    const auto copy = fill;
    check_whole_sphere(fairmesh::fill_holes(ball.mesh, copy));
    fill.join_auto();
    CHECK(fairmesh::fill_holes(ball.mesh, fill).info().loop_count == 0);
    fill = fairmesh::fill_options();
    fill.join_auto();
    const auto joined = fairmesh::fill_holes(ball.mesh, fill);
    check_whole_sphere(joined);
    CHECK(joined.fill_report(0).joined_count == 2 && joined.list(FAIRMESH_LIST_JOINED_LOOPS) == both[0]);

    const auto filled = [&](const fairmesh::fill_options &asked) {
        const auto found = fairmesh::fill_holes(ball.mesh, asked);
        return found.fill_report(0).triangle_count > 0 && found.fill_report(1).triangle_count == 0;
    };
    fairmesh::fill_options first;
    first.fair = 0;
    first.only_of_components({0});
    CHECK(filled(first));
    first = fairmesh::fill_options();
    first.fair = 0;
    first.only_in_ball({0, 0, 1}, 1.4);
    CHECK(filled(first));
    first.only_in_box({-1, -1, 0}, {1, 1, 1});
    CHECK(filled(first));

    // One cap turned around: refused, and the two loops named.
    for (std::size_t t = BALL_CAP_TRIANGLES; t < BALL_TRIANGLES; t++) std::swap(ball.corners[3 * t], ball.corners[3 * t + 1]);
    const auto refused = fairmesh::fill_holes(ball.mesh, copy).fill_report(0);
    CHECK(refused.reason == FAIRMESH_FILL_REASON_OPPOSITE_SIDES && refused.reason_element == 0 && refused.reason_other == 1);
}

void bridging() {
    Ball ball;
    ball_make(&ball);
    const std::vector<std::uint32_t> from{BALL_CAP - BALL_ROUND, BALL_CAP - BALL_ROUND + 1, BALL_CAP - BALL_ROUND + 2};
    const std::vector<std::uint32_t> to{BALL_VERTICES - BALL_ROUND, BALL_VERTICES - BALL_ROUND + 1};
    fairmesh::bridge_options how;
    how.fill = 1;
    const auto whole = fairmesh::bridge(ball.mesh, from, to, how);
    CHECK(whole.info().is_success && whole.bridge_report().rest_count == 1 && whole.info().loop_count == 2);
    check_whole_sphere(whole);
    fairmesh::fill_options fill;
    fill.join_auto();
    fill.guide({{{from[0], to[0]}}});
    check_whole_sphere(fairmesh::fill_holes(ball.mesh, fill));
}

void rounding() {
    std::vector<std::array<double, 3>> corners;
    for (int v = 0; v < 8; v++) corners.push_back({v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0});
    const std::vector<std::array<std::uint32_t, 3>> faces{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const auto box = fairmesh::mesh(corners, faces);
    fairmesh::round_options how;
    how.width = 0.2;
    const auto all = fairmesh::round(box, how);
    CHECK(all.info().is_success && all.info().crease_count == 12 && all.crease(11).is_rounded);
    how.only_edges = {{{0, 1}}, {{1, 3}}};
    const auto two = fairmesh::round(box, how);
    std::uint32_t rounded = 0;
    for (std::uint64_t k = 0; k < 12; k++) rounded += two.crease(k).is_rounded;
    CHECK(rounded == 2);
}

void erasing() {
    auto s = cap(15);
    std::vector<std::uint32_t> dent;
    for (std::uint32_t t = 0; t < s.triangles.size(); t++) {
        const auto &c = s.triangles[t];
        if (s.mask[c[0]] || s.mask[c[1]] || s.mask[c[2]]) dent.push_back(t);
    }
    const auto left = fairmesh::erase(fairmesh::mesh(s.positions, s.triangles), dent);
    CHECK(left.kept.size() + dent.size() + left.dropped == s.triangles.size() && left.loops.size() == 1);
    std::vector<std::array<std::uint32_t, 3>> kept;
    for (const auto t : left.kept) kept.push_back(s.triangles[t]);
    fairmesh::fill_options fill;
    fill.only(left.loops);
    const auto filled = fairmesh::fill_holes(fairmesh::mesh(s.positions, kept), fill);
    CHECK(filled.info().loop_count == 1 && filled.fill_report(0).outcome == FAIRMESH_FILL_OUTCOME_FAIRED);
    // Nothing there is slender.
    const auto cleaned = fairmesh::erase(fairmesh::mesh(s.positions, s.triangles), dent, 5);
    CHECK(cleaned.cleaned == 0 && cleaned.kept == left.kept);
}

void regions() {
    auto s = cap(15);
    const auto mesh = fairmesh::mesh(s.positions, s.triangles);
    fairmesh_region_step ball{}, ring{};
    ball.kind = FAIRMESH_REGION_KIND_BALL;
    ball.point[2] = 1.0;
    ball.value = 0.4;
    ring.kind = FAIRMESH_REGION_KIND_GROW;
    ring.rings = 1;
    const auto chosen = fairmesh::select_region(mesh, {ball, ring});
    CHECK(chosen.counts.size() == 2 && chosen.counts[0] > 0 && chosen.counts[0] < chosen.counts[1]);
    CHECK(chosen.triangles.size() == chosen.counts[1] && chosen.bumps.empty());
    CHECK(fairmesh::select_region(mesh, {fairmesh_region_step{}}).triangles.size() == s.triangles.size());
    CHECK(fairmesh::select_region(mesh, {}).triangles.empty());
    CHECK(fairmesh::erase(mesh, chosen.triangles).kept.size() < s.triangles.size());
    ball.value = -1.0;
    try {
        fairmesh::select_region(mesh, {ball});
        CHECK(false);
    } catch (const fairmesh::error &refused) {
        CHECK(refused.status() == FAIRMESH_STATUS_BAD_OPTION);
    }
}

void trimming() {
    auto s = cap(15);
    // Two triangles at corners of the sheet hang by one edge; they are at no hole.
    const auto mesh = fairmesh::mesh(s.positions, s.triangles);
    CHECK(fairmesh::trim_boundary(mesh).kept.size() == s.triangles.size());
    fairmesh::trim_limits limits;
    limits.triangles = 2;
    const auto trimmed = fairmesh::trim_boundary(mesh, {0}, limits);
    CHECK(trimmed.dropped == 2 && trimmed.kept.size() == s.triangles.size() - 2 && trimmed.area > 0.0);
    limits.area = 0.5 * trimmed.area;
    CHECK(fairmesh::trim_boundary(mesh, {0}, limits).dropped < 2);
    const auto rough = fairmesh::rim_roughness(mesh);
    CHECK(rough.info().loop_count == 1 && rough.loop(0).vertex_count == 56);
    CHECK(rough.loop(0).has_roughness && rough.loop(0).roughness > 0.0 && !fairmesh::boundary_loops(mesh).loop(0).has_roughness);
}

void refilling() {
    auto s = cap(15);
    const auto mesh = fairmesh::mesh(s.positions, s.triangles);
    const auto refilled = fairmesh::refill(mesh, fairmesh::free_mask(s.mask));
    const auto x = refilled.positions();
    CHECK(off_sphere(x.data()->data(), x.size()) < 5e-3);
    const auto carried = fairmesh::carry_over(mesh, {5, 7}, fairmesh::points(x.data()->data(), x.size()));
    CHECK(carried.triangles.size() == x.size() && carried.corners.size() == 3 * x.size() && carried.weights.size() == x.size());
    for (const auto t : carried.triangles) CHECK(t == 5 || t == 7);
    fairmesh::options stopped;
    stopped.on_progress = [](const fairmesh_progress &) { return false; };
    try {
        fairmesh::refill(mesh, fairmesh::free_mask(s.mask), fairmesh::fill_options(), stopped);
        CHECK(false);
    } catch (const fairmesh::error &caught) {
        CHECK(caught.status() == FAIRMESH_STATUS_NO_FAIR_PATCH);
    }
    stopped.on_progress = [](const fairmesh_progress &) -> bool { throw 7; };
    try {
        fairmesh::refill(mesh, fairmesh::free_mask(s.mask), fairmesh::fill_options(), stopped);
        CHECK(false);
    } catch (int thrown) {
        CHECK(thrown == 7);
    }
}

} // namespace

int main() {
    CHECK(fairmesh::version() == fairmesh_version_string());
    fairing();
    errors();
    exceptions();
    continuing_edges();
    stepping();
    live();
    continuing_curvature();
    holes();
    joins();
    bridging();
    rounding();
    erasing();
    regions();
    trimming();
    refilling();
    std::puts("wrapper: passed");
}
