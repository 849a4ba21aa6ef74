//! What the C interface costs over the Rust call: fairing of a cap with 13,000 free vertices.

#[allow(
    dead_code,
    unused_imports,
    unreachable_pub,
    reason = "only one function is timed"
)]
#[path = "../src/capi/lib.rs"]
mod capi;

use capi::*;
use fairmesh::{Options, Selection};
use fairmesh_shapes::{OUTSIDE, Sampling, Shape, sphere_cap};

fn main() {
    divan::main();
}

fn shape() -> Shape {
    sphere_cap(60.0, 13_000, Sampling::Irregular { seed: 1 }, OUTSIDE)
}

#[divan::bench(sample_count = 20, sample_size = 1)]
fn rust(bencher: divan::Bencher<'_, '_>) {
    let shape = shape();
    let start = shape.flat();
    bencher.bench_local(|| {
        let options = Options {
            threads: 2,
            ..Options::default()
        };
        fairmesh::fair(&start, &shape.triangles, Selection::Mask(&shape.free), &options).unwrap()
    });
}

#[divan::bench(sample_count = 20, sample_size = 1)]
fn c(bencher: divan::Bencher<'_, '_>) {
    let shape = shape();
    let start = shape.flat();
    let mask: Vec<u8> = shape.free.iter().map(|f| u8::from(*f)).collect();
    let mut out = vec![[0.0f64; 3]; start.len()];
    let mut options = std::mem::MaybeUninit::<fairmesh_options>::zeroed();
    assert_eq!(
        fairmesh_options_init(options.as_mut_ptr(), size_of::<fairmesh_options>()),
        fairmesh_status::Ok
    );
    #[allow(unsafe_code, reason = "filled by the call")]
    // SAFETY: every field was written.
    let mut options = unsafe { options.assume_init() };
    options.threads = 2;
    let mesh = fairmesh_mesh {
        struct_size: size_of::<fairmesh_mesh>() as u32,
        coincident: fairmesh_coincident::Join as u32,
        positions: fairmesh_points {
            data: start.as_ptr().cast(),
            count: start.len(),
            stride: 0,
            scalar: 2,
            reserved: 0,
        },
        triangles: fairmesh_indices {
            data: shape.triangles.as_ptr().cast(),
            count: shape.triangles.len(),
            stride: 0,
        },
        coincident_within: 0.0,
    };
    let selection = fairmesh_selection {
        struct_size: size_of::<fairmesh_selection>() as u32,
        kind: fairmesh_selection_kind::FreeMask as u32,
        data: mask.as_ptr().cast(),
        count: mask.len(),
        stride: 0,
    };
    let view = fairmesh_points_out {
        data: out.as_mut_ptr().cast(),
        count: out.len(),
        stride: 0,
        scalar: 2,
        reserved: 0,
    };
    bencher.bench_local(|| {
        let status = fairmesh_fair(
            &mesh,
            &selection,
            &options,
            &view,
            std::ptr::null_mut(),
            std::ptr::null_mut(),
            std::ptr::null_mut(),
        );
        assert_eq!(status, fairmesh_status::Ok);
    });
}
