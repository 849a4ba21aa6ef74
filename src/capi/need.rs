//! How much memory a call needs at most: what [`Reserve`](super::memory::Reserve) sets aside. Measured by
//! `tests/capi.rs`, which holds these bounds against what is taken when every allocation fails.

use super::input::{MeshIn, Selected};
use super::memory::Reserve;
use super::status::{Failure, Outcome};
use super::views::room;

/// For threads, channels and small things.
const BASE: usize = 1 << 20;
/// Per thread: its queues, and the room that dense kernels work in.
const THREAD: usize = 6 << 20;
/// Per vertex and per triangle of the whole mesh: copies and numberings.
const VERTEX: usize = 160;
const TRIANGLE: usize = 120;
/// Per free vertex, and per free vertex and binary digit of their number: the factors grow like n log n.
const FREE: usize = 4 << 10;
const FREE_DIGIT: usize = 400;
/// Per entry of the two-ring pattern.
const PATTERN: usize = 96;
/// What a solver holds between its calls.
pub const STANDING: usize = 64 << 10;

/// Sets the memory for a call aside.
pub fn reserve(bytes: usize) -> Outcome<Reserve> {
    Reserve::new(bytes).ok_or_else(Failure::out_of_memory)
}

fn threads(asked: usize) -> usize {
    if asked > 0 {
        asked
    } else {
        std::thread::available_parallelism().map_or(1, usize::from)
    }
}

/// For fairing a region.
pub fn of_fairing(mesh: &MeshIn, selected: &Selected, asked_threads: usize) -> Outcome<usize> {
    let free = selected.free_at_most(mesh.vertices());
    // The two-ring of a vertex has as many members as its neighbours have neighbours, at most.
    let mut valence = room::<u32>(mesh.vertices())?;
    valence.resize(mesh.vertices(), 0);
    for t in 0..mesh.triangles.count {
        for v in mesh.triangles.index::<3>(t) {
            if let Some(valence) = valence.get_mut(v as usize) {
                *valence += 1;
            }
        }
    }
    let is_free = |v: usize| match selected {
        Selected::Mask(mask) => mask[v],
        _ => true,
    };
    // Beyond what a valence of 6 makes of it.
    let squares = valence.iter().enumerate().filter(|(v, _)| is_free(*v));
    let pattern = squares.fold(0usize, |sum, (_, &d)| {
        sum.saturating_add((d as usize).saturating_mul(d as usize))
    });
    Ok(sum(mesh, asked_threads).saturating_add(of_region(free, pattern.saturating_sub(36 * free))))
}

fn sum(mesh: &MeshIn, asked_threads: usize) -> usize {
    let counts = mesh.vertices() * VERTEX + mesh.triangles.count * TRIANGLE;
    BASE + threads(asked_threads) * THREAD + counts
}

fn of_region(free: usize, irregular: usize) -> usize {
    let digits = (usize::BITS - free.leading_zeros()) as usize;
    free.saturating_mul(FREE + FREE_DIGIT * digits)
        .saturating_add(irregular.saturating_mul(PATTERN))
}

/// For what looks at the whole mesh once.
pub fn of_whole_mesh(mesh: &MeshIn, asked_threads: usize) -> usize {
    sum(mesh, asked_threads) + mesh.triangles.count * TRIANGLE + mesh.vertices() * VERTEX
}

/// For patches with so many new vertices, at most, on rims of so many edges.
pub fn of_filling(mesh: &MeshIn, vertices: usize, longest: usize, asked_threads: usize) -> usize {
    // Triangulation is quadratic up to the length where ears are cut first.
    let table = longest.min(200).pow(2) * 64;
    of_whole_mesh(mesh, asked_threads) + table + of_region(vertices, 0) + vertices * 2000
}

/// For remeshing a region.
pub fn of_remeshing(mesh: &MeshIn, selected: &Selected, most: usize) -> usize {
    let free = selected
        .free_at_most(mesh.vertices())
        .max(most.min(mesh.vertices().saturating_mul(8)));
    of_whole_mesh(mesh, 1) + free * 2000
}
