//! scratch
use fairmesh::shapes::*; use fairmesh::*; use fairmesh::mesh::*;
fn main() {
    let a: Vec<String> = std::env::args().collect(); let n: usize = a[2].parse().unwrap();
    for seed in [7u64, 1] {
    let irr = Sampling::Irregular { seed };
    let s = match a[1].as_str() { "sphere" => sphere_cap(60.0, n, irr, 4), "cylinder" => cylinder_band(n, irr, 4), _ => catenoid_band(n, irr, 4) };
    let r = Region::new(&s.positions, &s.triangles, Selection::Mask(&s.free)).unwrap(); let rings = Rings::new(&r);
    let mut o = Options::default(); o.max_iterations = 1; let sol = fair(&s.positions, &s.triangles, Selection::Mask(&s.free), o).unwrap();
    let mut v: Vec<(f64, usize, usize)> = sol.border_normals.iter().enumerate().map(|(b, (i, m))| { let e = s.normals[*i as usize]; let c = nalgebra::Vector3::from(*m).cross(&nalgebra::Vector3::from(e)).norm(); (c.asin().to_degrees(), (rings.outside_edge_start[b + 1] - rings.outside_edge_start[b]) as usize, b) }).collect();
    let rms = (v.iter().map(|x| x.0 * x.0).sum::<f64>() / v.len() as f64).sqrt();
    v.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("{} {n} rms {rms:.2e} median {:.2e} worst {:?}", a[1], v[v.len() / 2].0, v.iter().take(8).map(|x| format!("{:.2e} tri {}", x.0, x.1)).collect::<Vec<_>>());
    }
}
