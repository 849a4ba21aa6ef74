//! Texts of the help that belong to no flag.

macro_rules! examples {
    () => {
        "\
Examples:
  fairmesh fair scan.stl -o fair.stl --bump 12.5,3,40 the bump or dent at a point
  fairmesh fair scan.stl -o fair.stl --ball 12.5,3,40,6
  fairmesh fair part.ply -o fair.ply                  the faces selected in MeshLab
  fairmesh fair part.obj -o fair.obj --faces f.txt    the faces listed in f.txt
  fairmesh fair scan.stl -o scan.stl --free v.txt --json report.json
  fairmesh fair part.ply -o fair.ply --selection vertex:quality
  fairmesh fair scan.stl -o fair.stl --bump 12.5,3,40 --picture seen.png --report told.html
  fairmesh fair scans/*.ply -o fair/                  several files into a directory

"
    };
}

/// What commands that only make files have behind their flags.
macro_rules! file_codes {
    () => {
        "\
Exit codes: 0 written; 2 wrong usage or input, nothing written; 4 memory or threads ran out, nothing written; 5 written,
but not the report about it."
    };
}

macro_rules! exit_codes {
    () => {
        "\
Exit codes: 0 converged and sound; 2 wrong usage or input, nothing written; 3 not converged, not sound
or with another reservation, which the outcome names: the best surface is written; 4 memory or threads ran out, nothing written; 5 the surface is
written, but not the report about it. Of several files, the worst in the order 4, 2, 5, 3."
    };
}

/// Before the flags of `fair --help`.
pub const FAIR_ABOUT: &str = "\
Fairs a region of a mesh file: moves its free vertices until the surface is as evenly curved as possible, and joins the
fixed surroundings with the same tangent planes.

Choose the vertices that may move by place and shape (--ball to --bump; 'fairmesh select' previews them), or by --free,
--faces or --selection. Without any of these, the selection that MeshLab stores in a PLY file (property 'flags') is used,
selected faces first. A vertex moves if all faces around it are selected.

Input and output are PLY (ASCII or binary), OBJ, OFF (ASCII) or STL (ASCII or binary), by their file names.
A file without faces is refused. If both have the same format, only the coordinates of the free vertices change, and
the normals that the file has for these vertices and their neighbours. Colours, texture coordinates, materials, groups,
comments, unknown elements and all other vertices stay as they are, byte for byte. If the formats differ, the output has only
vertices and faces. Polygons are split into triangles for the computation only. STL has no vertices: corners with equal
coordinates count as one, and vertices are numbered in the order of their first appearance.

'-' is stdin as input and stdout as output, in the format of --format; the report then goes to stderr. Files that
end in .gz are unpacked and packed.

Vertices and faces are counted from 0, in messages and in lists, for OBJ too.";

/// After the flags of `fair -h`.
pub const FAIR_SHORT: &str = concat!(examples!(), exit_codes!());

/// After the flags of `fair --help`.
pub const FAIR_LONG: &str = concat!(
    examples!(),
    "\
Lists (--free, --faces): one number per line; blank lines and what follows a # are ignored. Normals (--normals):
'vertex nx ny nz' per line, of any length but zero, pointing to the side that the faces turn to. Mean curvatures
(--boundary-curvature): 'vertex H' per line, in one over the unit of the file, negative on a sphere with outward normals; read at
boundary vertices, fitted at those that are not named.

The report (--json) has the keys outcome, reason, advice, iterations, levels (of --solver paper), defect
(of Delta_B H = 0, without unit), step, seconds, quality, components, free_vertices, diagonal, least_bending,
suspicious_normals, creased_vertices, reached, member_weight (w of the equation
Delta_B H = -2 w H (H^2 - K), where the outcome is nearest_member), fallback_weights and stale_normals (vertices
whose normals in the file could not be updated) and references (what is said of materials and textures that the file names). In seconds, 'solve' is everything from the arrays of the input to the arrays of
the result; 'setup' (connectivity, boundary normals), 'start', 'iterate' and 'quality' are parts of it;
'pictures' is null where none was asked for; 'total' is the whole run. In components, each part of the region that is a problem of its own has vertex (the smallest of
its free ones), free_vertices, outcome, iterations, defect, step, diagonal, least_bending, member_weight, quality,
attempts: what was tried, in its order, each with the free_vertices of its mesh (coarse or its own), name, iterations,
end and bending_energy (the integral of H^2), and continuity, where more than g1 is asked for: for each boundary loop its smallest vertex,
how many vertices it has, how much of the way was asked for (-1: auto) and reached, the jump of H there of the g1 surface (jump_before, root mean
square, and largest_jump_before) and now (jump, largest_jump), H of the surroundings (curvature) and how uncertain that
is (uncertainty), root mean squares in one over the unit of the file. Numbers that are not finite are null.

",
    exit_codes!()
);

/// After the flags of `select`.
pub const SELECT: &str = "\
Examples:
  fairmesh select scan.stl --ball 0,0,10,4 --picture ball.png
  fairmesh select scan.stl --bump 12.5,3,40 --grow 2 -o faces.txt
  fairmesh select part.obj --patch-at 0,0,5 --without --box -1,-1,4,1,1,6 -o patch.obj

The same flags choose what 'fairmesh fair' moves, and what 'fairmesh fill --erase' replaces.

Exit codes: 0 selected; 2 wrong usage or input, or a selection without a face, nothing written; 4 memory ran out, nothing
written; 5 selected, but the report about it cannot be written.";

/// After the flags of `generate`, `render` and `man`.
pub const FILES: &str = file_codes!();

/// After the flags of `holes`.
pub const LISTS: &str = "\
Exit codes: 0 listed, whether there are holes or not; 2 wrong usage or input; 4 memory or threads ran out; 5 the list cannot
be written.";

/// After the flags of `demo`.
pub const DEMO: &str = "\
Exit codes: 0 converged and sound; 2 wrong usage, or a file that cannot be written; 3 written, but not converged or not
sound; 4 memory or threads ran out; 5 written, but not the report about it.";

/// After the flags of `completions`.
pub const COMPLETIONS: &str = "\
Examples:
  fairmesh completions bash > ~/.local/share/bash-completion/completions/fairmesh
  fairmesh completions zsh > _fairmesh        in a directory of $fpath
  fairmesh completions fish > ~/.config/fish/completions/fairmesh.fish

Exit codes: 0 printed; 2 wrong usage; 5 the script cannot be written.";

/// After the flags of `fill`.
pub const FILL: &str = "\
New vertices and faces are appended. In PLY and OBJ everything else stays as it is, byte for byte; OFF, STL and formats other
than the input's are written anew. In PLY, new vertices get normals and interpolated colours, quality and texture
coordinates (u, v, s, t); all other properties of new vertices and faces are 0 or empty lists.

--erase and --drop-components-below also keep the rest of a PLY or OBJ file, except for the vertex numbers of faces.

A boundary that encloses the mesh and not a gap (the outer boundary of an open sheet) stays open unless --loop names it. If there
are no other boundaries, nothing is filled, and the exit code is 3.

Exit codes: 0 all holes asked for are filled and fair; 2 wrong usage or input, nothing written; 3 written, but a
hole is left open or not fair, or there was none: the report says which and why ('success' in the JSON, of each loop and of all); 4 memory or threads ran out, nothing written;
5 written, but not the report about it. Of several files, the worst in the order 4, 2, 5, 3.";

/// After the flags of `bridge`.
pub const BRIDGE: &str = "\
New vertices and faces are appended, as by 'fairmesh fill'. Vertices are counted from 0, for OBJ too;
'fairmesh holes --json' lists those of every boundary.

Exit codes: 0 the bridge is fair, and with --fill also the holes beside it; 2 wrong usage or input, or a bridge that cannot
be made, nothing written; 3 written, but not fair: the report says why; 4 memory or threads ran out, nothing written;
5 written, but not the report about it.";

/// After the flags of `round`.
pub const ROUND: &str = "\
Faces stay where they are; those that reach into a blend are cut. What is new has the colours, texture coordinates, materials
and other properties of what was there. Vertices are counted from 0, for OBJ too.

Exit codes: 0 all blends are fair; 2 wrong usage or input, nothing written; 3 written, but a blend is not fair: the report
says why; 4 memory or threads ran out, nothing written; 5 written, but not the report about it.";
