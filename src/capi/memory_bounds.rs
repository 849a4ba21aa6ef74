//! How much memory a call needs at most: what [`Reserve`](super::memory::Reserve) sets aside. Measured by
//! `tests/capi.rs`, which holds these bounds against what is taken when every allocation fails.

use super::input::{MeshIn, SelectedBy};
use super::memory::Reserve;
use super::options::OptionsIn;
use super::patch_sizes::PatchSizes;
use super::status::{CallResult, Failure};
use super::views::try_with_capacity;

// All in bytes. When allocations fail anywhere in 19 kinds of calls on 8,100 and 14,400 vertices, at most 8 in 100 of what these add up to are
// taken: with half of each nothing would fail that does not, and double only takes more address space.

/// For threads, channels and small things.
const BASE: u64 = 1 << 20;
/// Per thread: its queues, and the room that dense kernels work in.
const THREAD: u64 = 6 << 20;
/// Per vertex and per triangle of the whole mesh: copies and numberings, and the tree that intersections are found by.
const VERTEX: u64 = 176;
const TRIANGLE: u64 = 480;
/// Per free vertex, and per free vertex and binary digit of their number: the factors grow like n log n.
const FREE: u64 = 4 << 10;
const FREE_DIGIT: u64 = 400;
/// Per component of the region but the first: its surroundings, up to eight rings of them.
const COMPONENT: u64 = 32 << 10;
/// Per free vertex, where curvature is continued: modes along the loops, extended over the region, and a factor for that.
const CONTINUED: u64 = 3 << 10;
/// Per vertex that is made.
const MADE: u64 = 2000;
/// Of the vertices of a blend that was expected, those that are tried.
const TRIED: usize = 4;
/// Per edge of loops that are joined: what they are triangulated with.
const EDGE: u64 = 1 << 10;
/// Per vertex of the mesh, where boundaries are relaxed: positions, rings, and fits to what is around.
const RELAXED: u64 = 1 << 10;
/// Per point whose place on a mesh is looked for.
const CARRIED: u64 = 160;
/// Per entry of the two-ring pattern.
const PATTERN: u64 = 96;
/// What is set aside at most. Only in WebAssembly is there a bound: its memory grows when a block is made, not when it is used, and a trap
/// takes nothing along but the module, which the host has another one of. With this much, 4 GB are at least fifteen parts work; at half,
/// a large call that runs out of memory is more often a trap; at double, of 1 GB a half is set aside.
const MOST: Option<u64> = if cfg!(target_family = "wasm") {
    Some(256 << 20)
} else {
    None
};
/// What a solver holds between its calls.
pub(crate) const STANDING: u64 = 64 << 10;

/// Sets the memory for a call aside.
pub(crate) fn reserve(bytes: u64) -> CallResult<Reserve> {
    let bytes = MOST.map_or(bytes, |most| bytes.min(most));
    let bytes = usize::try_from(bytes).ok();
    bytes.and_then(Reserve::new).ok_or_else(Failure::out_of_memory)
}

fn threads(asked: usize) -> u64 {
    if asked > 0 {
        asked as u64
    } else {
        std::thread::available_parallelism().map_or(1, |n| n.get() as u64)
    }
}

/// For fairing a region at once, or in steps, before which curvature may be asked for any time.
pub(crate) fn of_fairing(
    mesh: &MeshIn,
    selected: &SelectedBy,
    asked: &OptionsIn,
    in_steps: bool,
) -> CallResult<u64> {
    let free = selected.candidates(mesh)?;
    // The two-ring of a vertex has as many members as its neighbours have neighbours, at most.
    let mut valence = try_with_capacity::<u32>(mesh.vertices())?;
    valence.resize(mesh.vertices(), 0);
    let vertex = |v: u32| (v as usize) < free.len();
    let mut connected = Connected(try_with_capacity(free.len())?);
    connected.0.extend(0..free.len() as u32);
    for t in 0..mesh.triangles.count {
        let corners = mesh.triangles.index::<3>(t);
        if corners.iter().any(|&v| vertex(v) && free[v as usize]) {
            corners
                .iter()
                .filter(|v| vertex(**v))
                .for_each(|&v| valence[v as usize] += 1);
            let mut moving = corners.iter().filter(|v| vertex(**v) && free[**v as usize]);
            if let Some(&first) = moving.next() {
                moving.for_each(|&v| connected.unite(first, v));
            }
        }
    }
    // Beyond what a valence of 6 makes of it.
    let beyond = valence
        .iter()
        .map(|&d| u64::from(d).saturating_mul(u64::from(d)).saturating_sub(36));
    let irregular = beyond.fold(0, u64::saturating_add);
    let roots = (0..)
        .zip(free.iter())
        .filter(|(v, f)| **f && connected.0[*v] == *v as u32);
    let components = (roots.count() as u64).saturating_sub(1) * COMPONENT;
    let free = free.iter().filter(|f| **f).count();
    let continued = in_steps || asked.asks_continuity();
    let region = of_region(free, irregular, continued).saturating_add(components);
    Ok(sum(mesh, asked.threads()).saturating_add(region))
}

/// Per vertex one that it is connected with, or itself: of each set of connected vertices one.
struct Connected(Vec<u32>);

impl Connected {
    fn root(&mut self, mut v: u32) -> u32 {
        while self.0[v as usize] != v {
            let above = self.0[self.0[v as usize] as usize];
            self.0[v as usize] = above;
            v = above;
        }
        v
    }

    fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

fn sum(mesh: &MeshIn, asked_threads: usize) -> u64 {
    let counts = mesh.vertices() as u64 * VERTEX + mesh.triangles.count as u64 * TRIANGLE;
    BASE + threads(asked_threads) * THREAD + counts
}

fn of_region(free: usize, irregular: u64, is_continued: bool) -> u64 {
    let digits = u64::from(usize::BITS - free.leading_zeros());
    let continued = CONTINUED * u64::from(is_continued);
    (free as u64)
        .saturating_mul(FREE + FREE_DIGIT * digits + continued)
        .saturating_add(irregular.saturating_mul(PATTERN))
}

/// For what looks at the whole mesh once.
pub(crate) fn of_whole_mesh(mesh: &MeshIn, asked_threads: usize) -> u64 {
    sum(mesh, asked_threads) + mesh.triangles.count as u64 * TRIANGLE + mesh.vertices() as u64 * VERTEX
}

/// For patches of these sizes, at most; of boundaries that are `relaxed` the mesh around is looked at once more.
pub(crate) fn of_filling(mesh: &MeshIn, patches: &PatchSizes, asked: &OptionsIn, relaxed: bool) -> u64 {
    let region = of_region(patches.vertices, 0, asked.asks_continuity());
    let rims = u64::from(relaxed) * (mesh.vertices() as u64 * RELAXED + of_whole_mesh(mesh, 1));
    of_whole_mesh(mesh, asked.threads())
        + of_triangulation(patches)
        + region
        + patches.vertices as u64 * MADE
        + rims
}

/// For blends of about so many vertices: what is cut out, and triangulated anew, has a few times as many.
pub(crate) fn of_rounding(mesh: &MeshIn, vertices: usize, asked: &OptionsIn) -> u64 {
    let most = vertices.saturating_mul(TRIED);
    let made = (most as u64).saturating_mul(MADE);
    of_whole_mesh(mesh, asked.threads())
        .saturating_mul(2)
        .saturating_add(of_region(most, 0, asked.asks_continuity()).saturating_add(made))
}

/// For finding out which loops to join.
pub(crate) fn of_joining(mesh: &MeshIn, patches: &PatchSizes) -> u64 {
    of_whole_mesh(mesh, 1) + of_triangulation(patches)
}

fn of_triangulation(patches: &PatchSizes) -> u64 {
    // Triangulation is quadratic up to the length where ears are cut first; bridges are looked for between each two loops.
    let table = (patches.longest as u64).min(300).pow(2) * 64;
    let joining = (patches.joined as u64).saturating_pow(2).saturating_mul(64);
    joining.saturating_add(table + patches.longest as u64 * EDGE * u64::from(patches.joined > 1))
}

/// For telling how rough boundaries are, besides what one look at the mesh takes.
pub(crate) fn of_rims(vertices: usize, triangles: usize) -> u64 {
    threads(0) * THREAD + vertices as u64 * (RELAXED + 2 * VERTEX) + triangles as u64 * 2 * TRIANGLE
}

/// For deleting triangles.
pub(crate) fn of_erasing(mesh: &MeshIn) -> u64 {
    2 * of_whole_mesh(mesh, 1)
}

/// For choosing triangles in so many steps, whose lists have so many entries together. Where bumps are looked for, one region after the other
/// of the mesh is faired.
pub(crate) fn of_selecting(mesh: &MeshIn, steps: usize, listed: usize, with_bumps: bool) -> u64 {
    let bumps = if with_bumps {
        of_region(mesh.vertices(), 0, false).saturating_add(of_whole_mesh(mesh, 0))
    } else {
        0
    };
    let each = size_of::<fairmesh::RegionStep>() + size_of::<fairmesh::Bump>();
    let each = (steps as u64).saturating_mul(each as u64);
    of_whole_mesh(mesh, 0)
        .saturating_add(bumps)
        .saturating_add(each.saturating_mul(2))
        .saturating_add((listed as u64).saturating_mul(4))
}

/// For finding the nearest ones of so many triangles, which may be listed more than once, to so many points.
pub(crate) fn of_carrying(mesh: &MeshIn, listed: usize, points: usize) -> u64 {
    let lists = (listed as u64).saturating_mul(8);
    let places = (points as u64).saturating_mul(CARRIED);
    of_whole_mesh(mesh, 1)
        .saturating_add(lists)
        .saturating_add(places)
}

/// For remeshing a region.
pub(crate) fn of_remeshing(mesh: &MeshIn, selected: &SelectedBy, most: usize) -> CallResult<u64> {
    let free = selected.candidates(mesh)?.iter().filter(|f| **f).count();
    // Edges may become ten times shorter.
    let vertices = free.max(most.min(free.saturating_mul(200)));
    Ok(of_whole_mesh(mesh, 1).saturating_add(vertices as u64 * MADE))
}
