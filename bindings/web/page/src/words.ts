/** What can be done about an answer of the library, in the words and with the buttons of this page. Buttons stand in “ ”. */

/** By the library's names of outcomes, reasons and refusals. What is not here needs nothing to be done, or cannot happen on the page. */
export const REMEDIES: Record<string, string> = {
    // How a surface has come out.
    converged_poor_triangles: "look at it with “Wireframe”; “Remesh” makes better triangles, then “Fair the region” again",
    target_not_reachable: "choose a smaller region with “Shrink”",
    not_converged: "take “Grow” or “Remesh”, then “Fair the region” again; or “Erase and fill”",
    iteration_limit: "take “Fair the region” once more: it goes on from here",
    cancelled: "start it again, and let it end",
    boundary_crease: "move the edge of the region away from creases and noise, with “Grow”, “Shrink” or “Paint”, then “Fair the region” again",
    self_intersecting: "look at it; take “Grow” and “Fair the region”, or “Erase and fill”",
    poor_when_rounded: "save it as PLY or OBJ, which keep all digits",
    nearest_member: "look at it: it is smooth, but bends by another rule; turn the arrows less, or take “Grow” and “Fair the region”",
    // What is to be said of it.
    suspicious_normals: "triangles at the edge of the region may face the wrong way: move the edge with “Grow” or “Paint”",
    rounding: "the coordinates are far from the origin: move the mesh near to it in the program that it comes from",
    bump: "look at it with “Curvature”; take “Grow”, or smooth the edge of the region with “Paint”, then “Fair the region” again",
    tolerance: "look at it: it is as exact as numbers allow here",
    drawn_normals: "look at it; or “Undo”, paint a ring around the hole, and take “Erase and fill”",
    curvature: "look at it; or take “Grow” and “Fair the region”",
    sharp_edge: "take “Grow” until the sharp edge ends outside, or leaves the region again, then “Fair the region” again",
    // Why a hole is open, or its patch is flat.
    non_manifold: "paint the triangles there, and take “Erase and fill”",
    outer_boundary: "it is the rim of an open surface: “Join” fills it with another hole, or paint around it and take “Erase and fill”",
    too_many_edges: "paint around the hole, and take “Erase and fill”",
    no_triangulation: "paint the triangles that span the hole, and take “Erase and fill”",
    not_finite: "repair the file: coordinates there are no numbers",
    opposite_sides: "the two parts face opposite ways: turn one around in the program that the file comes from",
    shared_vertex: "take “Fill holes”: these two touch, and cannot be joined",
    not_asked_for: "take “Fill holes”",
    not_fair: "“Join” it to a hole beside it, or paint a ring around it and take “Erase and fill”",
    intersects: "“Join” it to a hole beside it, or paint a ring around it and take “Erase and fill”",
    hanging: "paint the triangles that hang there, and take “Erase and fill”",
    inconsistent: "triangles there face opposite ways: turn them around in the program that the file comes from",
    refused: "the mesh around the hole is damaged: paint a ring around it, and take “Erase and fill”",
    unsound: "paint a ring around the hole, and take “Erase and fill”; or look at it with “Curvature”",
    intersecting: "paint a ring around the hole, and take “Erase and fill”",
    least_bending: "look at it; click it here, then “Fair the region”",
    flat: "click it here, take “Remesh”, then “Fair the region”",
    left_open: "paint around the hole, and take “Erase and fill”",
    // Why something was refused.
    out_of_memory: "choose a smaller region, or close other tabs",
    threads: "close other tabs",
    index_out_of_range: "repair the file: a triangle names a vertex that is not there",
    repeated_index: "repair the file: a triangle has a vertex twice",
    duplicate_triangle: "“Unpaint” the triangles there, or repair the file",
    non_manifold_edge: "“Unpaint” the triangles there, or repair the file",
    non_manifold_vertex: "“Unpaint” the triangles there, or repair the file",
    inconsistent_orientation: "“Unpaint” the triangles there, or turn them around in the program that the file comes from",
    free_vertex_on_boundary: "“Unpaint” the rim of the surface: it stays where it is",
    free_vertex_without_triangle: "“Unpaint” there",
    nothing_fixed: "“Unpaint” a part: what stays holds the rest",
    empty_region: "paint more, or take “Grow”: a vertex moves if all triangles around it are chosen",
    no_normal: "choose a region with other triangles beside it",
    coordinate_too_large: "make the mesh smaller in the program that it comes from",
    valence_too_large: "“Unpaint” the vertex in which so many triangles meet",
    no_fair_patch: "take “Remesh” and “Fair the region”; or choose another region",
    no_bump: "paint the bump",
    not_orientable: "cut it open in the program that it comes from, or “Unpaint” it",
    no_crease: "choose the triangles on both sides of an edge, which is rounded then",
    bad_edit: "take “Back to the fair surface”",
    internal: "save what you have, and load the page anew",
};

/** In place of the library's own sentences where these speak of its functions and reports. */
export const TEXTS: Record<string, string> = {
    cancelled: "it was stopped; the best surface so far is shown",
    faired: "filled with a fair surface",
    least_bending: "filled with the surface that bends least",
    flat: "filled, but not faired",
    left_open: "left open",
    unsound: "no sound surface was found for it",
    boundary_crease: "the surface has a crease along the edge of the region",
    iteration_limit: "it was not done after the most steps; the best surface so far is shown",
    not_converged: "no sound surface was found; the one that bends least is shown",
    target_not_reachable: "no such surface was found; the one that bends least is shown",
    sharp_edge: "a sharp edge ends at the edge of the region, and does not go on in it",
    nearest_member: "no such surface was found; a smooth one near to it is shown",
    free_vertex_on_boundary: "the region reaches the rim of the surface",
    nothing_fixed: "nothing would hold the region: all of a part is chosen",
    empty_region: "nothing can move: the region is too thin",
    no_fair_patch: "erased and filled, this region gets no fair surface that cuts nothing",
    internal: "this is a bug of fairmesh, caught",
    bad_edit: "the boundary cannot be moved like this",
};

/** What an answer means, with what can be done. The name of it decides; of a reservation that of its reason. */
export function worded(name: string, text: string): string {
    const remedy = REMEDIES[name];
    return `${TEXTS[name] ?? text}${remedy === undefined ? "" : `. ${remedy.charAt(0).toUpperCase()}${remedy.slice(1)}`}`;
}
