/** Creases that are rounded: blends in their place. */

import * as abi from "./abi.js";
import { type Floats, type Mesh, MeshIn } from "./arrays.js";
import { type Host, isSingle, watched } from "./fairing.js";
import { newMesh, type NewMesh, withMesh } from "./holes.js";
import { plainFields } from "./library.js";
import { fairingIn, type FairingOptions, known, WATCHING, withDefaults, writeRows } from "./options.js";
import { type Report, type ResultHandle, resultOf } from "./reports.js";

/** What fairing options have to say about blends. */
const OF_FAIRING = ["continuity", "tolerance", "maxIterations", "threads", "intersections"] as const;
const NAMES: readonly string[] = [...plainFields("roundOptions"), ...Object.keys(abi.rows.roundOptions), ...OF_FAIRING, ...WATCHING];

/** Options of `roundEdges`. One of `width` and `radius` is needed. */
export type RoundOptions = abi.PlainRoundOptions & abi.RowsRoundOptions & Pick<FairingOptions, (typeof OF_FAIRING)[number] | "progress" | "cancel">;

/** A crease of the mesh given, and what became of it. */
export interface Crease extends abi.Crease {
    /** Its vertices, one after the other, in the mesh given; those of a closed one end with the first. */
    vertices: Uint32Array;
}

/** A mesh with blends in place of creases. First what is left of the mesh given, then what is new. */
export interface RoundResult<P extends Floats = Floats> extends NewMesh<P> {
    /** How the fairing of all blends went. */
    report: Report;
    /** Edges that bend by more than so many degrees were taken for creases. */
    angle: number;
    /** The creases of the mesh given. */
    creases: Crease[];
    /** Vertices of the mesh given that stay sharp, as no sound blend was found there. */
    sharpCorners: Uint32Array;
    /** The vertices of the blends, without their rails. */
    freeVertices: Uint32Array;
    /** Per vertex that is left its number before; per triangle outside the blends that of the one that it is, or is a part of. */
    keptVertices: Uint32Array;
    keptTriangles: Uint32Array;
}

/** See `Fairmesh.roundEdges`. */
export function roundEdges(host: Host, given: Mesh, options: RoundOptions): RoundResult {
    known(options, NAMES);
    const mesh = new MeshIn(given);
    return watched(host, options, (told) =>
        withMesh(host, mesh, (address, scope) => {
            const how = withDefaults(scope, "roundOptions", "fairmesh_round_options_init", options);
            writeRows(scope, how, "roundOptions", options);
            const fairing = fairingIn(scope, options, isSingle(mesh), mesh.vertexCount, told);
            return resultOf(host.library, "fairmesh_round", [address, how, fairing], (result) => rounded(result, mesh));
        }),
    );
}

function rounded(result: ResultHandle, mesh: MeshIn): RoundResult {
    const { creaseCount, creaseAngle } = result.info();
    return {
        ...newMesh(result, mesh),
        report: result.report(),
        angle: creaseAngle,
        creases: Array.from({ length: creaseCount }, (_, k) => ({
            ...result.struct<abi.Crease>("fairmesh_result_crease", "crease", k),
            vertices: result.list("crease_vertices", k),
        })),
        sharpCorners: result.list("sharp_corners"),
        freeVertices: result.list("free_vertices"),
        keptVertices: result.list("kept_vertices"),
        keptTriangles: result.list("kept_triangles"),
    };
}
