/** fairmesh for C++17: the C interface with classes that clean up and errors that are thrown. It computes nothing, and
 *  is nothing but this file.
 *
 *  Errors of the library are fairmesh::error. An exception thrown in a progress callback stops the run and is thrown again by the
 *  call. Arrays are as in fairmesh.h: owned by the caller, not kept. */
#ifndef FAIRMESH_HPP
#define FAIRMESH_HPP

#include <fairmesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace fairmesh {

/** What a number that the library answers with is called; see fairmesh_describe. */
inline const char *name(fairmesh_answer answer, std::int64_t number) {
    return fairmesh_describe(answer, number, FAIRMESH_TEXT_NAME);
}

/** What it means. */
inline const char *meaning(fairmesh_answer answer, std::int64_t number) {
    return fairmesh_describe(answer, number, FAIRMESH_TEXT_MEANING);
}

/** What can be done about it; empty if there is nothing to do. */
inline const char *remedy(fairmesh_answer answer, std::int64_t number) {
    return fairmesh_describe(answer, number, FAIRMESH_TEXT_REMEDY);
}

/** A failed call, with the detail that the library gave. */
class error : public std::runtime_error {
public:
    explicit error(const fairmesh_error &detail)
        : std::runtime_error(detail.message[0] ? detail.message : name(FAIRMESH_ANSWER_STATUS, detail.status)), detail_(detail) {}

    fairmesh_status status() const noexcept { return static_cast<fairmesh_status>(detail_.status); }
    /** A fairmesh_element, and the numbers that go with it. */
    const fairmesh_error &detail() const noexcept { return detail_; }

private:
    fairmesh_error detail_;
};

namespace detail {

inline void check(fairmesh_status status, fairmesh_error &why) {
    if (status == FAIRMESH_STATUS_OK) return;
    why.status = static_cast<int32_t>(status);
    throw error(why);
}

inline fairmesh_error no_error() {
    fairmesh_error none{};
    none.element = none.other = FAIRMESH_NO_ELEMENT;
    return none;
}

/** Calls a function of the library that ends with a fairmesh_error. */
template <class Function, class... Arguments> void call(Function function, Arguments... arguments) {
    fairmesh_error why = no_error();
    check(function(arguments..., &why), why);
}

template <class Scalar> constexpr std::uint32_t scalar() {
    static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>, "float or double");
    return std::is_same_v<Scalar, float> ? FAIRMESH_SCALAR_FLOAT32 : FAIRMESH_SCALAR_FLOAT64;
}

template <class Struct> Struct sized() {
    Struct made{};
    made.struct_size = sizeof made;
    return made;
}

/** The struct that a function of the library fills, the last of its arguments but the error. */
template <class Struct, class Function, class... Arguments> Struct record(Function function, Arguments... arguments) {
    auto made = sized<Struct>();
    call(function, arguments..., &made);
    return made;
}

/** Gives options their defaults. */
template <class Options>
void init(fairmesh_status (*defaults)(Options *, std::size_t), std::common_type_t<Options> *options) {
    fairmesh_error why = no_error();
    check(defaults(options, sizeof *options), why);
}

} // namespace detail

/** Points to be read or written: `count` of them, three numbers at every `stride` bytes (0: nothing between). */
template <class Scalar> fairmesh_points points(const Scalar *data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, detail::scalar<Scalar>(), 0};
}

template <class Scalar> fairmesh_points_out points_out(Scalar *data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, detail::scalar<Scalar>(), 0};
}

/** Numbers to be read, such as given mean curvatures. */
template <class Scalar> fairmesh_numbers numbers(const Scalar *data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, detail::scalar<Scalar>(), 0};
}

template <class Scalar> fairmesh_scalars_out scalars_out(Scalar *data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride, detail::scalar<Scalar>(), 0};
}

inline fairmesh_indices indices(const std::uint32_t *data, std::size_t count, std::size_t stride = 0) {
    return {data, count, stride};
}

/** A mesh in the caller's memory. Set its `coincident` to FAIRMESH_COINCIDENT_SEPARATE if vertices at the same place are not one. */
inline fairmesh_mesh mesh(const fairmesh_points &positions, const fairmesh_indices &triangles) {
    auto made = detail::sized<fairmesh_mesh>();
    made.positions = positions;
    made.triangles = triangles;
    return made;
}

inline fairmesh_mesh mesh(const std::vector<std::array<double, 3>> &positions,
                          const std::vector<std::array<std::uint32_t, 3>> &triangles) {
    return mesh(points(positions.empty() ? nullptr : positions.data()->data(), positions.size()),
                indices(triangles.empty() ? nullptr : triangles.data()->data(), triangles.size()));
}

/** All vertices that are not on the boundary of the mesh are free. */
inline fairmesh_selection interior() { return detail::sized<fairmesh_selection>(); }

namespace detail {

template <class Entry> fairmesh_selection selection(fairmesh_selection_kind kind, const std::vector<Entry> &entries) {
    auto made = sized<fairmesh_selection>();
    made.kind = kind;
    made.data = entries.data();
    made.count = entries.size();
    return made;
}

} // namespace detail

/** One byte per vertex: not zero is free. */
inline fairmesh_selection free_mask(const std::vector<std::uint8_t> &mask) {
    return detail::selection(FAIRMESH_SELECTION_KIND_FREE_MASK, mask);
}

/** The free vertices. */
inline fairmesh_selection free_vertices(const std::vector<std::uint32_t> &vertices) {
    return detail::selection(FAIRMESH_SELECTION_KIND_FREE_VERTICES, vertices);
}

/** The selected triangles. */
inline fairmesh_selection faces(const std::vector<std::uint32_t> &triangles) {
    return detail::selection(FAIRMESH_SELECTION_KIND_FACES, triangles);
}

/** Told how far a run is; false stops it. It may throw: the call throws the same. */
using progress = std::function<bool(const fairmesh_progress &)>;

/** fairmesh_options with their defaults, and a progress callback of C++. */
struct options : fairmesh_options {
    options() : fairmesh_options() {
        detail::init(fairmesh_options_init, this);
    }

    /** In place of `progress` and `user_data` of the C struct. */
    fairmesh::progress on_progress;
};

namespace detail {

/** Keeps exceptions on this side of the library. */
struct relay {
    fairmesh::progress told;
    std::exception_ptr thrown;

    static std::int32_t tell(const fairmesh_progress *how_far, void *self) noexcept {
        auto &relay = *static_cast<detail::relay *>(self);
        try {
            return relay.told(*how_far) ? 0 : 1;
        } catch (...) {
            relay.thrown = std::current_exception();
            return 1;
        }
    }

    void rethrow() {
        if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
    }
};

/** Runs a call that takes a callback and what it gets. What the callback has thrown comes before what the call says of being stopped. */
template <class Call> auto watched(const fairmesh::progress &told, const Call &call) {
    relay through{told, nullptr};
    try {
        auto made = call(told ? relay::tell : nullptr, static_cast<void *>(&through));
        through.rethrow();
        return made;
    } catch (const fairmesh::error &) {
        through.rethrow();
        throw;
    }
}

/** The options with the relay in the place of the callback, if there is one. */
inline fairmesh_options with(const fairmesh::options &asked, relay &through) {
    fairmesh_options plain = asked;
    if (asked.on_progress) {
        through.told = asked.on_progress;
        plain.progress = relay::tell;
        plain.user_data = &through;
    }
    return plain;
}

} // namespace detail

/** Something that was computed; see fairmesh_result. Any number of threads may read it. */
class result {
public:
    result() = default;
    explicit result(fairmesh_result *handle) noexcept : handle_(handle) {}
    result(result &&other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    result &operator=(result &&other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~result() { fairmesh_result_free(handle_); }

    fairmesh_result *get() const noexcept { return handle_; }

    fairmesh_info info() const {
        return detail::record<fairmesh_info>(fairmesh_result_info, handle_);
    }
    /** Whether there is nothing to be said of the whole result, see fairmesh_info. */
    bool is_success() const { return info().is_success != 0; }
    fairmesh_report report(std::uint64_t index = 0) const {
        return detail::record<fairmesh_report>(fairmesh_result_report, handle_, index);
    }
    fairmesh_component component(std::uint64_t number, std::uint64_t index = 0) const {
        return detail::record<fairmesh_component>(fairmesh_result_component, handle_, index, number);
    }
    /** An attempt at the surface of a component. */
    fairmesh_attempt attempt(std::uint64_t component, std::uint64_t number, std::uint64_t index = 0) const {
        return detail::record<fairmesh_attempt>(fairmesh_result_attempt, handle_, index, component, number);
    }
    /** A boundary loop of a component whose curvature was to be continued. */
    fairmesh_continuity continuity(std::uint64_t component, std::uint64_t number, std::uint64_t index = 0) const {
        return detail::record<fairmesh_continuity>(fairmesh_result_continuity, handle_, index, component, number);
    }
    /** What became of a sharp edge that reaches the boundary; its vertices are in the list FAIRMESH_LIST_SHARP_VERTICES. */
    fairmesh_sharp_edge sharp_edge(std::uint64_t number, std::uint64_t index = 0) const {
        return detail::record<fairmesh_sharp_edge>(fairmesh_result_sharp_edge, handle_, index, number);
    }
    /** Where it arrives at the boundary. */
    fairmesh_crease_end crease_end(std::uint64_t edge, std::uint64_t number, std::uint64_t index = 0) const {
        return detail::record<fairmesh_crease_end>(fairmesh_result_crease_end, handle_, index, edge, number);
    }
    fairmesh_loop loop(std::uint64_t index) const {
        return detail::record<fairmesh_loop>(fairmesh_result_loop, handle_, index);
    }
    fairmesh_fill_report fill_report(std::uint64_t index) const {
        return detail::record<fairmesh_fill_report>(fairmesh_result_fill_report, handle_, index);
    }
    /** A group of loops that would be joined. */
    fairmesh_join_suggestion suggestion(std::uint64_t index) const {
        return detail::record<fairmesh_join_suggestion>(fairmesh_result_suggestion, handle_, index);
    }
    /** What became of a bridge. */
    fairmesh_bridge_report bridge_report() const {
        return detail::record<fairmesh_bridge_report>(fairmesh_result_bridge, handle_);
    }
    /** A crease of a rounded mesh: `crease_count` of the info. */
    fairmesh_crease crease(std::uint64_t index) const {
        return detail::record<fairmesh_crease>(fairmesh_result_crease, handle_, index);
    }
    void positions(const fairmesh_points_out &out) const { detail::call(fairmesh_result_positions, handle_, &out); }
    std::vector<std::array<double, 3>> positions() const {
        std::vector<std::array<double, 3>> all(static_cast<std::size_t>(info().vertex_count));
        positions(points_out(all.empty() ? static_cast<double *>(nullptr) : all.data()->data(), all.size()));
        return all;
    }
    void triangles(const fairmesh_indices_out &out) const { detail::call(fairmesh_result_triangles, handle_, &out); }
    std::vector<std::array<std::uint32_t, 3>> triangles() const {
        std::vector<std::array<std::uint32_t, 3>> all(static_cast<std::size_t>(info().triangle_count));
        triangles(fairmesh_indices_out{all.empty() ? nullptr : all.data()->data(), all.size(), 0});
        return all;
    }
    void scalars(fairmesh_scalars which, const fairmesh_scalars_out &out) const {
        detail::call(fairmesh_result_scalars, handle_, static_cast<std::uint32_t>(which), &out);
    }
    /** One number per vertex. */
    std::vector<double> scalars(fairmesh_scalars which) const {
        std::vector<double> all(static_cast<std::size_t>(info().vertex_count));
        scalars(which, scalars_out(all.data(), all.size()));
        return all;
    }
    std::vector<std::uint32_t> list(fairmesh_list which, std::uint64_t index = 0) const {
        std::size_t size = 0;
        auto number = static_cast<std::uint32_t>(which);
        detail::call(fairmesh_result_list, handle_, number, index, static_cast<std::uint32_t *>(nullptr),
                     static_cast<std::size_t>(0), &size);
        std::vector<std::uint32_t> all(size);
        if (size > 0) detail::call(fairmesh_result_list, handle_, number, index, all.data(), size, &size);
        return all;
    }
    /** The vectors that go with the list of boundary vertices, or with that of parents (three each). */
    std::vector<std::array<double, 3>> vectors(fairmesh_vectors which) const {
        auto size = which == FAIRMESH_VECTORS_BOUNDARY_NORMALS ? info().boundary_vertex_count : info().new_vertex_count;
        std::vector<std::array<double, 3>> all(static_cast<std::size_t>(size));
        auto out = points_out(all.empty() ? static_cast<double *>(nullptr) : all.data()->data(), all.size());
        detail::call(fairmesh_result_vectors, handle_, static_cast<std::uint32_t>(which), &out);
        return all;
    }

private:
    fairmesh_result *handle_ = nullptr;
};

namespace detail {

/** The result that a function of the library makes, its last argument but the error. */
template <class Function, class... Arguments> result made(Function function, Arguments... arguments) {
    fairmesh_result *handle = nullptr;
    call(function, arguments..., &handle);
    return result(handle);
}

/** Runs something with these options; what their callback throws goes before what the library says of it. */
template <class Run> auto relayed(const fairmesh::options &asked, Run run) {
    relay through;
    const auto plain = with(asked, through);
    try {
        auto made = run(&plain);
        through.rethrow();
        return made;
    } catch (const error &) {
        through.rethrow();
        throw;
    }
}

} // namespace detail

/** Fairs a mesh; see fairmesh_fair. Positions go to `out`, which may be the mesh's own. Returns the report. */
inline fairmesh_report fair(const fairmesh_mesh &mesh, const fairmesh_selection &selection, const options &asked,
                            const fairmesh_points_out &out) {
    return detail::relayed(asked, [&](const fairmesh_options *plain) {
        auto report = detail::sized<fairmesh_report>();
        detail::call(fairmesh_fair, &mesh, &selection, plain, &out, &report, static_cast<fairmesh_result **>(nullptr));
        return report;
    });
}

/** The same, with everything that was found. */
inline result fair(const fairmesh_mesh &mesh, const fairmesh_selection &selection = interior(),
                   const options &asked = options()) {
    return detail::relayed(asked, [&](const fairmesh_options *plain) {
        return detail::made(fairmesh_fair, &mesh, &selection, plain, static_cast<const fairmesh_points_out *>(nullptr),
                            static_cast<fairmesh_report *>(nullptr));
    });
}

namespace detail {

inline std::vector<std::array<std::uint32_t, 2>> self_intersections(const fairmesh_mesh &mesh, const fairmesh_indices *among,
                                                                    const fairmesh::progress &told) {
    const auto list = watched(told, [&](fairmesh_progress_fn tell, void *self) {
        return made(fairmesh_self_intersections, &mesh, among, tell, self).list(FAIRMESH_LIST_INTERSECTIONS);
    });
    std::vector<std::array<std::uint32_t, 2>> pairs(list.size() / 2);
    for (std::size_t k = 0; k < pairs.size(); ++k) pairs[k] = {list[2 * k], list[2 * k + 1]};
    return pairs;
}

} // namespace detail

/** Mean curvature at every vertex; see fairmesh_mean_curvature. */
inline std::vector<double> mean_curvature(const fairmesh_mesh &mesh) {
    std::vector<double> all(mesh.positions.count);
    auto out = scalars_out(all.data(), all.size());
    detail::call(fairmesh_mean_curvature, &mesh, &out);
    return all;
}

/** Pairs of triangles that intersect, the smaller number first, ascending; see fairmesh_self_intersections. */
inline std::vector<std::array<std::uint32_t, 2>> self_intersections(const fairmesh_mesh &mesh, const progress &told = nullptr) {
    return detail::self_intersections(mesh, nullptr, told);
}

/** Only pairs with at least one of these triangles. */
inline std::vector<std::array<std::uint32_t, 2>> self_intersections(const fairmesh_mesh &mesh,
                                                                    const std::vector<std::uint32_t> &among,
                                                                    const progress &told = nullptr) {
    const auto list = indices(among.data(), among.size());
    return detail::self_intersections(mesh, &list, told);
}

/** Turns the boundary normals of a loop about the boundary; see fairmesh_edit_kind. In radians. */
inline fairmesh_edit tilt(std::uint32_t vertex, double angle, double falloff = 0) {
    fairmesh_edit made{};
    made.kind = FAIRMESH_EDIT_KIND_TILT;
    made.vertex = vertex;
    made.amount = angle;
    made.falloff = falloff;
    return made;
}

/** The same on one side of the vertex, and the opposite on the other. */
inline fairmesh_edit twist(std::uint32_t vertex, double angle, double falloff = 0) {
    auto made = tilt(vertex, angle, falloff);
    made.kind = FAIRMESH_EDIT_KIND_TWIST;
    return made;
}

/** Bulges the whole region; see fairmesh_solver_bulge_range. */
inline fairmesh_edit bulge(double amount) {
    fairmesh_edit made{};
    made.kind = FAIRMESH_EDIT_KIND_BULGE;
    made.amount = amount;
    return made;
}

/** Moves fixed vertices, which have to live as long as it does, by a translation. Set `rotation` and `centre` for more. */
inline fairmesh_edit moved(const std::vector<std::uint32_t> &vertices, const std::array<double, 3> &translation, double falloff = 0) {
    fairmesh_edit made{};
    made.kind = FAIRMESH_EDIT_KIND_MOVE;
    made.vertices = indices(vertices.data(), vertices.size());
    std::copy(translation.begin(), translation.end(), made.translation);
    made.falloff = falloff;
    return made;
}

/** What a frame may cost; see fairmesh_budget. No number converts to it: which of them it were, nobody would see. */
struct budget {
    std::uint64_t evaluations = 0;
    double seconds = 0;
    double tolerance = 0;
};

/** About how many bytes a fairing takes at most; see fairmesh_memory_needed. */
inline std::uint64_t memory_needed(const fairmesh_mesh &mesh, const fairmesh_selection &selection, const options &asked = options()) {
    std::uint64_t bytes = 0;
    detail::call(fairmesh_memory_needed, &mesh, &selection, static_cast<const fairmesh_fill_options *>(nullptr), &asked, &bytes);
    return bytes;
}

/** Takes what the library would write to stderr; see fairmesh_set_log. */
inline void set_log(fairmesh_log_fn log, void *user_data = nullptr) { fairmesh_set_log(log, user_data); }

/** Fairing in steps; see fairmesh_solver_new. Used by one thread at a time. */
class solver {
public:
    solver(const fairmesh_mesh &mesh, const fairmesh_selection &selection = interior(), const options &asked = options())
        : relay_(std::make_unique<detail::relay>()) {
        auto plain = detail::with(asked, *relay_);
        detail::call(fairmesh_solver_new, &mesh, &selection, &plain, &handle_);
    }
    solver(solver &&other) noexcept
        : relay_(std::move(other.relay_)), handle_(std::exchange(other.handle_, nullptr)) {}
    solver &operator=(solver &&other) noexcept {
        std::swap(relay_, other.relay_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~solver() { fairmesh_solver_free(handle_); }

    fairmesh_solver *get() const noexcept { return handle_; }

    fairmesh_report run(std::uint64_t iterations = UINT64_MAX) {
        const auto report = detail::record<fairmesh_report>(fairmesh_solver_run, handle_, iterations);
        relay_->rethrow();
        return report;
    }
    /** Other options from now on; see fairmesh_solver_set. */
    void set_boundary_normals(const fairmesh_boundary_normals &normals) {
        options asked;
        asked.boundary_normals = normals;
        set(FAIRMESH_SETTING_BOUNDARY_NORMALS, asked);
    }
    void set_continuity(double continuity, const fairmesh_loop_continuity &of_loops = {}) {
        options asked;
        asked.continuity = continuity;
        asked.loop_continuity = of_loops;
        set(FAIRMESH_SETTING_CONTINUITY, asked);
    }
    void set_boundary_curvature(const fairmesh_boundary_curvature &curvature) {
        options asked;
        asked.boundary_curvature = curvature;
        set(FAIRMESH_SETTING_BOUNDARY_CURVATURE, asked);
    }
    void set_target(const fairmesh_target &target) {
        options asked;
        asked.target = target;
        set(FAIRMESH_SETTING_TARGET, asked);
    }
    /** Changes of the boundary, in the place of those before; see fairmesh_solver_edit. */
    void edit(const std::vector<fairmesh_edit> &edits) { detail::call(fairmesh_solver_edit, handle_, edits.data(), edits.size()); }
    /** One frame; see fairmesh_solver_update. */
    fairmesh_frame update(const budget &limit = {}) {
        auto plain = detail::sized<fairmesh_budget>();
        plain.evaluations = limit.evaluations;
        plain.seconds = limit.seconds;
        plain.tolerance = limit.tolerance;
        return detail::record<fairmesh_frame>(fairmesh_solver_update, handle_, &plain);
    }
    /** The converged surface; see fairmesh_solver_finish. */
    fairmesh_report finish() {
        const auto report = detail::record<fairmesh_report>(fairmesh_solver_finish, handle_);
        relay_->rethrow();
        return report;
    }
    /** The smallest and largest amount of a bulge; see fairmesh_solver_bulge_range. */
    std::array<double, 2> bulge_range() {
        const auto made = detail::record<fairmesh_bulge_range>(fairmesh_solver_bulge_range, handle_);
        relay_->rethrow();
        return {made.low, made.high};
    }
    void positions(const fairmesh_points_out &out) const { detail::call(fairmesh_solver_positions, handle_, &out); }
    /** Everything that is known of the surface as it stands: its report, curvatures, lists. */
    result snapshot() const {
        return detail::made(fairmesh_solver_result, handle_);
    }

private:
    void set(fairmesh_setting setting, const options &asked) { detail::call(fairmesh_solver_set, handle_, setting, &asked); }
    /** Stays where it is when the solver moves: the library knows its address. */
    std::unique_ptr<detail::relay> relay_;
    fairmesh_solver *handle_ = nullptr;
};

/** The boundary loops of a mesh; see fairmesh_boundary_loops. */
inline result boundary_loops(const fairmesh_mesh &mesh) {
    return detail::made(fairmesh_boundary_loops, &mesh);
}

/** The same, and how rough their rims are: `loop` of the result tells; see fairmesh_rim_roughness. */
inline result rim_roughness(const fairmesh_mesh &mesh) {
    return detail::made(fairmesh_rim_roughness, &mesh);
}

/** Loops that get one patch together, by their numbers. */
using loop_groups = std::vector<std::vector<std::uint32_t>>;

/** fairmesh_fill_options with their defaults, and lists that stay where they are. */
struct fill_options : fairmesh_fill_options {
    fill_options() : fairmesh_fill_options() {
        detail::init(fairmesh_fill_options_init, this);
    }

    /** In place of `loops` of the C struct: these loops and no others, also where there are none of them. */
    void only(std::vector<std::uint32_t> numbers) {
        listed_ = std::move(numbers);
        lists_ = true;
    }

    /** In place of `join` of the C struct: one patch for the loops of each group. */
    void join_groups(const loop_groups &groups) {
        joined_.clear();
        starts_.clear();
        for (const auto &group : groups) {
            starts_.push_back(static_cast<std::uint32_t>(joined_.size()));
            joined_.insert(joined_.end(), group.begin(), group.end());
        }
        join.kind = groups.empty() ? FAIRMESH_JOIN_KIND_NONE : FAIRMESH_JOIN_KIND_GROUPS;
        groups_ = true;
    }

    /** One patch for loops whose joint patch bends less than patches of their own would. */
    void join_auto() {
        join = fairmesh_join{};
        join.kind = FAIRMESH_JOIN_KIND_AUTO;
        groups_ = false;
    }

    /** In place of `guides` of the C struct: pairs of boundary vertices that the triangulation shall have an edge between. */
    void guide(const std::vector<std::array<std::uint32_t, 2>> &pairs) {
        std::vector<std::uint32_t> flat;
        for (const auto &pair : pairs) flat.insert(flat.end(), pair.begin(), pair.end());
        rows(&fairmesh_fill_options::guides, std::move(flat), 2);
    }

    /** One more such pair. */
    void add_guide(const std::array<std::uint32_t, 2> &pair) {
        auto &flat = kept(&fairmesh_fill_options::guides, 2);
        flat.insert(flat.end(), pair.begin(), pair.end());
    }

    /** In place of a list of the C struct: rows of so many indices, one after the other. */
    void rows(fairmesh_indices fairmesh_fill_options::*list, std::vector<std::uint32_t> flat, std::size_t width = 1) {
        kept(list, width) = std::move(flat);
    }

    /** In place of `filter.components` of the C struct: holes of these components of the mesh. */
    void only_of_components(std::vector<std::uint32_t> components) {
        components_ = std::move(components);
        filters_components_ = true;
    }

    /** Only holes whose vertices all lie in a ball. */
    void only_in_ball(const std::array<double, 3> &centre, double radius) {
        filter.within = fairmesh_place{};
        filter.within.kind = FAIRMESH_PLACE_KIND_BALL;
        std::copy(centre.begin(), centre.end(), filter.within.centre);
        filter.within.radius = radius;
    }

    /** Only holes whose vertices all lie in a box. */
    void only_in_box(const std::array<double, 3> &low, const std::array<double, 3> &high) {
        filter.within = fairmesh_place{};
        filter.within.kind = FAIRMESH_PLACE_KIND_BOX;
        std::copy(low.begin(), low.end(), filter.within.low);
        std::copy(high.begin(), high.end(), filter.within.high);
    }

    /** The C struct, with the lists; as long as this lives. */
    fairmesh_fill_options plain() const {
        fairmesh_fill_options made = *this;
        if (lists_) {
            made.loops = indices(listed_.data(), listed_.size());
            made.only_listed = 1;
        }
        if (groups_) {
            made.join.loops = indices(joined_.data(), joined_.size());
            made.join.starts = indices(starts_.data(), starts_.size());
        }
        for (const auto &row : rows_) made.*row.list = indices(row.flat.data(), row.flat.size() / row.width);
        if (filters_components_) made.filter.components = indices(components_.data(), components_.size());
        return made;
    }

private:
    std::vector<std::uint32_t> &kept(fairmesh_indices fairmesh_fill_options::*list, std::size_t width) {
        for (auto &row : rows_)
            if (row.list == list) return row.flat;
        rows_.push_back({list, {}, width});
        return rows_.back().flat;
    }

    struct rows_of {
        fairmesh_indices fairmesh_fill_options::*list;
        std::vector<std::uint32_t> flat;
        std::size_t width;
    };
    std::vector<rows_of> rows_;
    std::vector<std::uint32_t> listed_, joined_, starts_, components_;
    bool lists_ = false, groups_ = false, filters_components_ = false;
};

/** Fills holes; see fairmesh_fill_holes. */
inline result fill_holes(const fairmesh_mesh &mesh, const fill_options &fill = fill_options(),
                         const options &asked = options()) {
    const auto how = fill.plain();
    return detail::relayed(asked, [&](const fairmesh_options *plain) { return detail::made(fairmesh_fill_holes, &mesh, &how, plain); });
}

/** Which loops `join_auto` would give one patch; see fairmesh_suggest_joins. */
inline loop_groups suggest_joins(const fairmesh_mesh &mesh, const fill_options &fill = fill_options()) {
    const auto how = fill.plain();
    const auto found = detail::made(fairmesh_suggest_joins, &mesh, &how);
    loop_groups groups(static_cast<std::size_t>(found.info().loop_count));
    for (std::size_t k = 0; k < groups.size(); ++k) groups[k] = found.list(FAIRMESH_LIST_JOINED_LOOPS, k);
    return groups;
}

/** fairmesh_bridge_options with their defaults. */
struct bridge_options : fairmesh_bridge_options {
    bridge_options() : fairmesh_bridge_options() {
        detail::init(fairmesh_bridge_options_init, this);
    }
};

/** Connects two runs of boundary edges by a strip; see fairmesh_bridge. */
inline result bridge(const fairmesh_mesh &mesh, const std::vector<std::uint32_t> &from, const std::vector<std::uint32_t> &to,
                     const bridge_options &how = bridge_options(), const fill_options &fill = fill_options(),
                     const options &asked = options()) {
    const auto filling = fill.plain();
    const auto first = indices(from.data(), from.size()), second = indices(to.data(), to.size());
    const fairmesh_bridge_options *strip = &how;
    return detail::relayed(asked, [&](const fairmesh_options *plain) {
        return detail::made(fairmesh_bridge, &mesh, &first, &second, strip, &filling, plain);
    });
}

/** fairmesh_round_options with their defaults. */
struct round_options : fairmesh_round_options {
    round_options() : fairmesh_round_options() {
        detail::init(fairmesh_round_options_init, this);
    }

    /** These edges only, each by its two vertices; in place of `edges` of the C struct. */
    std::vector<std::array<std::uint32_t, 2>> only_edges;
};

/** Blends in place of creases; see fairmesh_round. */
inline result round(const fairmesh_mesh &mesh, const round_options &how, const options &asked = options()) {
    fairmesh_round_options rounding = how;
    if (!how.only_edges.empty()) rounding.edges = indices(how.only_edges.data()->data(), how.only_edges.size());
    const fairmesh_round_options *pointer = &rounding;
    return detail::relayed(asked, [&](const fairmesh_options *plain) { return detail::made(fairmesh_round, &mesh, pointer, plain); });
}

/** What is left of a mesh without some of its triangles. */
struct erased_triangles {
    /** The numbers of those that are left, ascending. */
    std::vector<std::uint32_t> kept;
    /** The loops that the deleted ones leave, as boundary_loops numbers those of the mesh that is left. */
    std::vector<std::uint32_t> loops;
    /** How many were dropped besides those named: they hung loose. */
    std::uint64_t dropped = 0;
    /** How many were dropped because they would spoil the boundary of a patch. */
    std::uint64_t cleaned = 0;
};

/** Deletes triangles, and up to `clean` more beside them that would spoil the boundary of a patch; see fairmesh_erase. */
inline erased_triangles erase(const fairmesh_mesh &mesh, const std::vector<std::uint32_t> &triangles, std::uint64_t clean = 0) {
    const auto list = indices(triangles.data(), triangles.size());
    const auto left = detail::made(fairmesh_erase, &mesh, &list, clean);
    const auto info = left.info();
    return {left.list(FAIRMESH_LIST_KEPT_TRIANGLES), left.list(FAIRMESH_LIST_ERASED_LOOPS), info.dropped_count, info.cleaned_count};
}

/** How much may be taken away at the boundaries of holes. */
struct trim_limits {
    std::uint64_t triangles = UINT64_MAX;
    /** All of them together; 0: of any area. */
    double area = 0.0;
};

/** What is left of a mesh whose boundary was trimmed. */
struct trimmed_triangles {
    /** The numbers of the triangles that are left, ascending. */
    std::vector<std::uint32_t> kept;
    /** How many are gone. */
    std::uint64_t dropped = 0;
    /** Their area. */
    double area = 0.0;
};

namespace detail {

inline trimmed_triangles trim_boundary(const fairmesh_mesh &mesh, const fairmesh_indices *loops, const trim_limits &limits) {
    const auto left = detail::made(fairmesh_trim_boundary, &mesh, loops, limits.triangles, limits.area);
    const auto info = left.info();
    return {left.list(FAIRMESH_LIST_KEPT_TRIANGLES), info.dropped_count, info.dropped_area};
}

} // namespace detail

/** Takes away what would spoil patches at all holes; see fairmesh_trim_boundary. */
inline trimmed_triangles trim_boundary(const fairmesh_mesh &mesh, const trim_limits &limits = trim_limits()) {
    return detail::trim_boundary(mesh, nullptr, limits);
}

/** The same at these loops. */
inline trimmed_triangles trim_boundary(const fairmesh_mesh &mesh, const std::vector<std::uint32_t> &loops,
                                       const trim_limits &limits = trim_limits()) {
    const auto list = indices(loops.data(), loops.size());
    return detail::trim_boundary(mesh, &list, limits);
}

/** Per triangle the number of its component; see fairmesh_components. */
inline std::vector<std::uint32_t> components(const fairmesh_mesh &mesh) {
    return detail::made(fairmesh_components, &mesh).list(FAIRMESH_LIST_TRIANGLE_COMPONENTS);
}

/** Triangles chosen by place, distance and shape. */
struct selected_region {
    /** Ascending. */
    std::vector<std::uint32_t> triangles;
    /** Per step how many triangles it named, or how many there were after it. */
    std::vector<std::uint32_t> counts;
    /** What was taken for bumps, one for each step that asks for one. */
    std::vector<fairmesh_bump> bumps;
};

/** Chooses triangles step by step; see fairmesh_select_region. A `fairmesh_region_step{}` is the whole mesh. */
inline selected_region select_region(const fairmesh_mesh &mesh, const std::vector<fairmesh_region_step> &steps, const progress &told = nullptr) {
    const auto chosen = detail::watched(told, [&](fairmesh_progress_fn tell, void *self) {
        return detail::made(fairmesh_select_region, &mesh, steps.data(), steps.size(), tell, self);
    });
    selected_region made{chosen.list(FAIRMESH_LIST_REGION_TRIANGLES), chosen.list(FAIRMESH_LIST_REGION_COUNTS), {}};
    for (const auto &step : steps) {
        if (step.kind != FAIRMESH_REGION_KIND_BUMP) continue;
        const std::uint64_t number = made.bumps.size();
        made.bumps.push_back(detail::record<fairmesh_bump>(fairmesh_result_bump, chosen.get(), number));
    }
    return made;
}

/** fairmesh_remesh_options with their defaults. */
struct remesh_options : fairmesh_remesh_options {
    remesh_options() : fairmesh_remesh_options() {
        detail::init(fairmesh_remesh_options_init, this);
    }

    /** In place of `progress` and `user_data` of the C struct. */
    fairmesh::progress on_progress;
};

/** Triangulates a region anew; see fairmesh_remesh. */
inline result remesh(const fairmesh_mesh &mesh, const fairmesh_selection &selection,
                     const remesh_options &asked = remesh_options()) {
    return detail::watched(asked.on_progress, [&](fairmesh_progress_fn tell, void *self) {
        fairmesh_remesh_options plain = asked;
        if (tell) plain.progress = tell, plain.user_data = self;
        return detail::made(fairmesh_remesh, &mesh, &selection, static_cast<const fairmesh_remesh_options *>(&plain));
    });
}

/** Deletes a region and fills it; see fairmesh_refill. */
inline result refill(const fairmesh_mesh &mesh, const fairmesh_selection &selection, const fill_options &fill = fill_options(),
                     const options &asked = options()) {
    const auto how = fill.plain();
    return detail::relayed(asked, [&](const fairmesh_options *plain) {
        return detail::made(fairmesh_refill, &mesh, &selection, &how, plain);
    });
}

/** Per point its place on a mesh. */
struct carried_points {
    /** The triangle; UINT32_MAX where there is none. */
    std::vector<std::uint32_t> triangles;
    /** Its corners, three for each point, and their weights. */
    std::vector<std::uint32_t> corners;
    std::vector<std::array<double, 3>> weights;
};

/** The places of the points on these triangles of a mesh; see fairmesh_carry_over. */
inline carried_points carry_over(const fairmesh_mesh &mesh, const std::vector<std::uint32_t> &among, const fairmesh_points &points,
                                 const progress &told = nullptr) {
    const auto list = indices(among.data(), among.size());
    const auto found = detail::watched(told, [&](fairmesh_progress_fn tell, void *self) {
        return detail::made(fairmesh_carry_over, &mesh, &list, &points, tell, self);
    });
    return {found.list(FAIRMESH_LIST_CARRIED_TRIANGLES), found.list(FAIRMESH_LIST_PARENTS),
            found.vectors(FAIRMESH_VECTORS_PARENT_WEIGHTS)};
}

/** The version of the library that runs, such as "0.1.0". */
inline std::string version() { return fairmesh_version_string(); }

} // namespace fairmesh

#endif
