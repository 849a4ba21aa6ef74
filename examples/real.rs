//! scratch
use fairmesh::*;
use std::io::Write;
use std::ops::ControlFlow;
fn load(p: &str) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let d = std::fs::read(p).unwrap();
    let e = d.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
    let h = String::from_utf8_lossy(&d[..e]);
    let num = |k: &str| -> usize { h.lines().find(|l| l.starts_with(k)).unwrap().split_whitespace().last().unwrap().parse().unwrap() };
    let (nv, nf) = (num("element vertex"), num("element face"));
    let dbl = h.contains("property double x");
    let mut o = e;
    let mut v = vec![];
    for _ in 0..nv {
        let mut p = [0.0; 3];
        for c in &mut p { if dbl { *c = f64::from_le_bytes(d[o..o + 8].try_into().unwrap()); o += 8 } else { *c = f32::from_le_bytes(d[o..o + 4].try_into().unwrap()) as f64; o += 4 } }
        v.push(p);
    }
    let mut f = vec![];
    for _ in 0..nf { o += 1; let mut t = [0; 3]; for c in &mut t { *c = u32::from_le_bytes(d[o..o + 4].try_into().unwrap()); o += 4 } f.push(t); }
    (v, f)
}
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let (v, f) = load(&args[1]);
    let free: Vec<u32> = std::fs::read_to_string(&args[2]).unwrap().split_whitespace().map(|x| x.parse().unwrap()).collect();
    let has = |k: &str| args.iter().any(|a| a == k);
    let given: Vec<(u32, [f64; 3])> = args.iter().find_map(|a| a.strip_prefix("n=")).map(|p| std::fs::read_to_string(p).unwrap().lines().map(|l| { let w: Vec<f64> = l.split_whitespace().map(|x| x.parse().unwrap()).collect(); (w[0] as u32, [w[1], w[2], w[3]]) }).collect()).unwrap_or_default();
    let normals = if !given.is_empty() { BorderNormals::Given(&given) } else if has("avg") { BorderNormals::Averaged } else { BorderNormals::Fitted };
    let inner = if has("conformal") { InnerFairness::Conformal } else { InnerFairness::Uniform };
    let verbose = has("-v");
    let mut cb = |p: &Progress| { if verbose { eprintln!("  {:3} {:.3} {:.3e} {}", p.iterations, p.fraction, p.step, p.stage); } ControlFlow::Continue(()) };
    let threads = args.iter().find_map(|a| a.strip_prefix("t=")).map_or(1, |t| t.parse().unwrap());
    let mut o = Options { normals, inner, threads, discretization: if has("paper") { Discretization::Paper } else { Discretization::SecondOrder }, ..Options::default() };
    if verbose { o.progress = Some(&mut cb); }
    match fair(&v, &f, Selection::Vertices(&free), o) {
        Err(e) => println!("ERROR {e}"),
        Ok(r) => {
            let q = &r.report.quality;
            println!("{} {} {:?} it {} defect {:.1e} step {:.1e} | setup {:.4} start {:.4} iterate {:.4} total {:.4} | angle {:.2} flips {} needles {} H {:.3?} {:.3?} dev {:.2} rms {:.3} susp {} lin {}",
                args[2].split('/').next_back().unwrap(), r.report.free_vertices, r.report.outcome, r.report.iterations, r.report.defect, r.report.step,
                r.report.seconds.setup, r.report.seconds.start, r.report.seconds.iterate, r.report.seconds.total, q.worst_angle, q.flipped.len(), q.needles.len(), q.h_inside, q.h_border, q.normal_deviation, q.normal_deviation_rms, r.report.suspicious_normals.len(), r.report.linear_surface);
            if let Some(p) = args.iter().find_map(|a| a.strip_prefix("o=")) {
                let mut w = std::io::BufWriter::new(std::fs::File::create(p).unwrap());
                write!(w, "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n", v.len(), f.len()).unwrap();
                for p in &r.positions { for c in p { w.write_all(&c.to_le_bytes()).unwrap(); } }
                for t in &f { w.write_all(&[3]).unwrap(); for c in t { w.write_all(&c.to_le_bytes()).unwrap(); } }
            }
        }
    }
}
