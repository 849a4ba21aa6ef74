//! Rims that are noise.

use fairmesh::*;
use fairmesh_shapes::{Sampling, sphere_with_hole};

struct Rng(u64);
impl Rng {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64) / (1u64 << 53) as f64
    }
    fn normal(&mut self) -> f64 {
        let (a, b) = (self.unit().max(1e-300), self.unit());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}
fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Largest angle in degrees between new and old triangles over an edge.
fn crease(f: &Filled) -> f64 {
    let first = f.loops[0].triangles.start as usize;
    let mut edges = std::collections::BTreeMap::new();
    let n = |t: usize| {
        let [a, b, c] = f.triangles[t].map(|v| f.positions[v as usize]);
        cross(sub(b, a), sub(c, a))
    };
    for t in 0..first {
        for k in 0..3 {
            edges.insert((f.triangles[t][k], f.triangles[t][(k + 1) % 3]), t);
        }
    }
    let mut worst: f64 = 0.0;
    for t in first..f.triangles.len() {
        for k in 0..3 {
            if let Some(&o) = edges.get(&(f.triangles[t][(k + 1) % 3], f.triangles[t][k])) {
                let (p, q) = (n(t), n(o));
                worst = worst.max(norm(cross(p, q)).atan2(dot(p, q)));
            }
        }
    }
    worst.to_degrees()
}

#[test]
#[ignore]
fn experiment() {
    let n: usize = std::env::var("N").map_or(3000, |s| s.parse().unwrap());
    let k: usize = std::env::var("K").map_or(3, |s| s.parse().unwrap());
    let noises: Vec<f64> = std::env::var("NOISE").map_or(vec![0.0, 0.05, 0.1, 0.2, 0.3], |s| {
        s.split(',').map(|x| x.parse().unwrap()).collect()
    });
    let seeds: u64 = std::env::var("SEEDS").map_or(2, |s| s.parse().unwrap());
    let isos = if std::env::var("ISO").is_ok() {
        vec![true]
    } else {
        vec![false, true]
    };
    for iso in isos {
        for whole in [true, false] {
            for &noise in &noises {
                for seed in 0..seeds {
                    let mut shape = sphere_with_hole(60.0, n, Sampling::Irregular { seed }, 3);
                    let free = shape.free.clone();
                    shape.triangles.retain(|t| t.iter().all(|&v| free[v as usize]));
                    let h = shape.mean_edge();
                    let mut rng = Rng(seed + 17);
                    for _ in 0..10 {
                        rng.unit();
                    }
                    // rings
                    let mut ring = vec![usize::MAX; shape.positions.len()];
                    for v in &boundary_loops(&shape.positions, &shape.triangles).unwrap()[0].vertices {
                        ring[*v as usize] = 0;
                    }
                    for r in 1..k {
                        for t in &shape.triangles {
                            if t.iter().any(|&v| ring[v as usize] == r - 1) {
                                for &v in t {
                                    if ring[v as usize] == usize::MAX {
                                        ring[v as usize] = r;
                                    }
                                }
                            }
                        }
                    }
                    let mut x = shape.positions.clone();
                    for v in 0..x.len() {
                        let s = noise * h;
                        let d = [rng.normal() * s, rng.normal() * s, rng.normal() * s];
                        if whole || ring[v] != usize::MAX {
                            let p = shape.positions[v];
                            if iso {
                                for i in 0..3 {
                                    x[v][i] += d[i];
                                }
                            } else {
                                for i in 0..3 {
                                    x[v][i] += d[0] * p[i];
                                }
                            }
                        }
                    }
                    let mut out = String::new();
                    let mut nn = 0;
                    for relax in [0, k] {
                        let options = FillOptions {
                            loops: Loops::Chosen(vec![0]),
                            rim: Rim { relax, within: None },
                            fairing: Options {
                                threads: 2,
                                ..Options::default()
                            },
                            ..FillOptions::default()
                        };
                        let f = fill_holes(&x, &shape.triangles, &options).unwrap();
                        nn = f.positions.len() - x.len();
                        let new = &f.positions[x.len()..];
                        let e: Vec<f64> = new.iter().map(|p| norm(*p) - 1.0).collect();
                        let rms = (e.iter().map(|e| e * e).sum::<f64>() / e.len() as f64).sqrt();
                        let max = e.iter().fold(0.0f64, |m, e| m.max(e.abs()));
                        out += &format!(
                            " | {} rms {:.3} max {:.3} /h (ratio {:.2}) crease {:.2} {:?}",
                            relax,
                            rms / h,
                            max / h,
                            rms / h / noise,
                            crease(&f),
                            f.loops[0].fairing.as_ref().map(|r| &r.outcome).map(|o| o.name())
                        );
                        if let Some(r) = &f.loops[0].rim {
                            out += &format!(
                                " moved {} rms {:.3} largest {:.3} bounded {} folded {} noise {:.3} radius {:.1}",
                                r.moved,
                                r.rms / h,
                                r.largest / h,
                                r.bounded,
                                r.folded + 1000 * r.self_intersections.len(),
                                r.noise / h,
                                r.radius / h
                            );
                        }
                    }
                    println!(
                        "v {} loop {} h {h:.4} new {} iso {} whole {} noise {noise} seed {seed}{out}",
                        x.len(),
                        boundary_loops(&shape.positions, &shape.triangles).unwrap()[0]
                            .vertices
                            .len(),
                        nn,
                        iso as u8,
                        whole as u8
                    );
                }
            }
        }
    }
}

/// The boundary faces of the unit cells whose centres lie in a ball about `c`: a raw staircase.
fn staircase(r: f64, c: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let m = r.ceil() as i64 + 2;
    let inside = |i: [i64; 3]| norm(sub(i.map(|k| k as f64), c)) < r;
    let mut ids = std::collections::BTreeMap::new();
    let (mut x, mut t) = (Vec::new(), Vec::new());
    for i in -m..=m {
        for j in -m..=m {
            for k in -m..=m {
                if !inside([i, j, k]) {
                    continue;
                }
                for axis in 0..3 {
                    for side in [-1i64, 1] {
                        let mut n = [i, j, k];
                        n[axis] += side;
                        if inside(n) {
                            continue;
                        }
                        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                        let corner = |p: i64, q: i64| {
                            let mut g = [2 * i, 2 * j, 2 * k];
                            g[axis] += side;
                            g[a] += p;
                            g[b] += q;
                            g
                        };
                        let mut quad = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
                        if side < 0 {
                            quad.reverse();
                        }
                        let v = quad.map(|g| {
                            *ids.entry(g).or_insert_with(|| {
                                x.push(g.map(|g| g as f64 / 2.0));
                                x.len() as u32 - 1
                            })
                        });
                        t.push([v[0], v[1], v[2]]);
                        t.push([v[0], v[2], v[3]]);
                    }
                }
            }
        }
    }
    (x, t)
}

/// Marching cubes on what is inside and what is not: vertices in the middle of edges, the inner corners of a face always apart.
fn marching(r: f64, c: [f64; 3]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let m = r.ceil() as i64 + 2;
    let inside = |i: [i64; 3]| norm(sub(i.map(|k| k as f64), c)) < r;
    let mut ids = std::collections::BTreeMap::new();
    let (mut x, mut t): (Vec<[f64; 3]>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
    for i in -m..m {
        for j in -m..m {
            for k in -m..m {
                let mut next = std::collections::BTreeMap::new();
                for axis in 0..3 {
                    for side in [0i64, 1] {
                        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                        let corner = |p: i64, q: i64| {
                            let mut g = [i, j, k];
                            g[axis] += side;
                            g[a] += p;
                            g[b] += q;
                            g
                        };
                        let mut face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                        if side == 0 {
                            face.reverse();
                        }
                        let is: Vec<bool> = face.iter().map(|&g| inside(g)).collect();
                        let mid = |p: usize| {
                            let (g, h) = (face[p], face[(p + 1) % 4]);
                            [g[0] + h[0], g[1] + h[1], g[2] + h[2]]
                        };
                        for p in 0..4 {
                            if !is[p] && is[(p + 1) % 4] {
                                let enter = mid(p);
                                let mut q = (p + 1) % 4;
                                while is[(q + 1) % 4] {
                                    q = (q + 1) % 4;
                                }
                                next.insert(mid(q), enter);
                            }
                        }
                    }
                }
                while let Some((&start, _)) = next.iter().next() {
                    let mut run = vec![start];
                    let mut at = next.remove(&start).unwrap();
                    while at != start {
                        run.push(at);
                        at = next.remove(&at).unwrap();
                    }
                    let v: Vec<u32> = run
                        .into_iter()
                        .map(|g: [i64; 3]| {
                            *ids.entry(g).or_insert_with(|| {
                                x.push(g.map(|g| g as f64 / 2.0));
                                x.len() as u32 - 1
                            })
                        })
                        .collect();
                    for p in 1..v.len() - 1 {
                        t.push([v[0], v[p + 1], v[p]]);
                    }
                }
            }
        }
    }
    (x, t)
}

#[test]
#[ignore]
fn voxels() {
    let k: usize = std::env::var("K").map_or(3, |s| s.parse().unwrap());
    let ds: Vec<f64> = std::env::var("D").map_or(vec![40.0, 70.0, 100.0], |s| {
        s.split(',').map(|x| x.parse().unwrap()).collect()
    });
    let seeds: u64 = std::env::var("SEEDS").map_or(2, |s| s.parse().unwrap());
    for raw in [true, false] {
        for &d in &ds {
            for angle in [30.0f64, 60.0] {
                for seed in 0..seeds {
                    let mut rng = Rng(seed * 77 + 5);
                    for _ in 0..10 {
                        rng.unit();
                    }
                    let c = [rng.unit(), rng.unit(), rng.unit()];
                    let axis = if seed == 0 {
                        [0.0, 0.0, 1.0]
                    } else {
                        let a = [rng.normal(), rng.normal(), rng.normal()];
                        let n = norm(a);
                        a.map(|x| x / n)
                    };
                    let r = d / 2.0;
                    let (x, mut t) = if raw { staircase(r, c) } else { marching(r, c) };
                    t.retain(|t| {
                        let m: [f64; 3] = std::array::from_fn(|i| {
                            t.iter().map(|&v| x[v as usize][i]).sum::<f64>() / 3.0 - c[i]
                        });
                        dot(m, axis) < norm(m) * angle.to_radians().cos()
                    });
                    let n = |t: &[u32; 3]| {
                        let [a, b, q] = t.map(|v| x[v as usize]);
                        dot(cross(sub(b, a), sub(q, a)), sub(a, c))
                    };
                    let sign = t.iter().map(n).sum::<f64>();
                    let used: std::collections::BTreeSet<u32> = t.iter().flatten().copied().collect();
                    let mean = used.iter().map(|&v| norm(sub(x[v as usize], c)) - r).sum::<f64>()
                        / used.len() as f64;
                    let loops = boundary_loops(&x, &t).unwrap();
                    let l = (0..loops.len()).max_by_key(|&l| loops[l].vertices.len()).unwrap();
                    let mut out = format!(
                        "sign {} loops {} edges {} meanoff {mean:.3}",
                        sign > 0.0,
                        loops.len(),
                        loops[l].vertices.len()
                    );
                    let rr = if std::env::var("BOTH").is_ok() {
                        vec![0, k]
                    } else {
                        vec![k]
                    };
                    for relax in rr {
                        let clock = std::time::Instant::now();
                        let options = FillOptions {
                            loops: Loops::Chosen(vec![l]),
                            rim: Rim { relax, within: None },
                            fairing: Options {
                                threads: 2,
                                ..Options::default()
                            },
                            ..FillOptions::default()
                        };
                        let f = fill_holes(&x, &t, &options).unwrap();
                        let new = &f.positions[x.len()..];
                        let e: Vec<f64> = new.iter().map(|p| norm(sub(*p, c)) - r).collect();
                        let rms = (e.iter().map(|e| e * e).sum::<f64>() / e.len() as f64).sqrt();
                        let max = e.iter().fold(0.0f64, |m, e| m.max(e.abs()));
                        out += &format!(
                            "\n  {:.1} s | {} rms {:.3} max {:.3} voxels crease {:.2} {:?} {:?}",
                            clock.elapsed().as_secs_f64(),
                            relax,
                            rms,
                            max,
                            crease(&f),
                            f.loops[0].outcome,
                            f.loops[0].fairing.as_ref().map(|r| &r.outcome).map(|o| o.name())
                        );
                        if let Some(r) = &f.loops[0].rim {
                            out += &format!(
                                " moved {} rms {:.3} largest {:.3} bounded {} folded {} noise {:.3} radius {:.1}",
                                r.moved,
                                r.rms,
                                r.largest,
                                r.bounded,
                                r.folded + 1000 * r.self_intersections.len(),
                                r.noise,
                                r.radius
                            );
                        }
                    }
                    println!("raw {} d {d} angle {angle} seed {seed} {out}", raw as u8);
                }
            }
        }
    }
}
