/* All that a call may be given. */
#ifndef GIVEN_H
#define GIVEN_H

#include "bytes.h"

enum { STEPS = 4, EDITS = 2, SCRIPT = 24 };

/* What is NULL. */
enum {
    NO_MESH = 1,
    NO_SELECTION = 2,
    NO_OPTIONS = 4,
    NO_FILL = 8,
    NO_BRIDGE = 16,
    NO_REMESH = 32,
    NO_FIRST = 64,
    NO_OUT = 128,
    NO_REPORT = 256,
    NO_RESULT = 512,
    NO_ERROR = 1024,
    NO_LIMIT = 2048
};

typedef struct {
    fairmesh_mesh mesh;
    fairmesh_selection selection;
    fairmesh_options options;
    fairmesh_fill_options fill;
    fairmesh_bridge_options bridge;
    fairmesh_round_options round;
    fairmesh_remesh_options remesh;
    fairmesh_region_step steps[STEPS];
    fairmesh_edit edits[EDITS];
    fairmesh_budget limit;
    fairmesh_indices first, second;
    fairmesh_points points;
    fairmesh_points_out out;
    size_t step_count, edit_count;
    double number;
    uint64_t most;
    uint32_t missing;
    /* After how many calls the callback stops the run; 0: there is no callback. */
    uint8_t patience;
    /* How much larger than this header has them structs are that are written, in words; and what is behind those that are read. */
    int8_t growth;
    uint8_t padding;
    /* What is done to a solver, which numbers are described. */
    uint8_t script[SCRIPT];
} Given;

/* A mesh without anything, and the defaults. */
static inline void give_nothing(Given *given) {
    memset(given, 0, sizeof *given);
    given->mesh.struct_size = sizeof given->mesh;
    given->selection.struct_size = sizeof given->selection;
    given->limit.struct_size = sizeof given->limit;
    fairmesh_options_init(&given->options, sizeof given->options);
    fairmesh_fill_options_init(&given->fill, sizeof given->fill);
    fairmesh_bridge_options_init(&given->bridge, sizeof given->bridge);
    fairmesh_round_options_init(&given->round, sizeof given->round);
    fairmesh_remesh_options_init(&given->remesh, sizeof given->remesh);
}

/* What is handed over: structs of the sizes that they claim, or NULL. */
typedef struct {
    const fairmesh_mesh *mesh;
    const fairmesh_selection *selection;
    const fairmesh_options *options;
    const fairmesh_fill_options *fill;
    const fairmesh_bridge_options *bridge;
    const fairmesh_round_options *round;
    const fairmesh_remesh_options *remesh;
    const fairmesh_budget *limit;
    const fairmesh_indices *first;
    const fairmesh_points_out *out;
    fairmesh_report *report;
    fairmesh_result **result;
    fairmesh_error *error;
} Handed;

#define HAND(name, bit) \
    if (!(given->missing & (bit))) handed.name = sized(&given->name, sizeof given->name, given->padding)

static inline Handed hand_over(const Given *given, fairmesh_result **result, fairmesh_error *error) {
    Handed handed;
    memset(&handed, 0, sizeof handed);
    HAND(mesh, NO_MESH);
    HAND(selection, NO_SELECTION);
    HAND(options, NO_OPTIONS);
    HAND(fill, NO_FILL);
    HAND(bridge, NO_BRIDGE);
    HAND(round, NO_BRIDGE);
    HAND(remesh, NO_REMESH);
    HAND(limit, NO_LIMIT);
    if (!(given->missing & NO_FIRST)) handed.first = &given->first;
    if (!(given->missing & NO_OUT)) handed.out = &given->out;
    if (!(given->missing & NO_REPORT)) handed.report = room_of(sizeof *handed.report, given->growth);
    if (!(given->missing & NO_RESULT)) handed.result = result;
    if (!(given->missing & NO_ERROR)) handed.error = error;
    return handed;
}

#endif
