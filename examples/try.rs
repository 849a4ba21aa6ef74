//! scratch
use fairmesh::shapes::*;
use fairmesh::*;
use std::ops::ControlFlow;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let n: usize = args[2].parse().unwrap();
    let irr = if args.iter().any(|a| a == "reg") { Sampling::Regular } else { Sampling::Irregular { seed: args.iter().find_map(|a| a.strip_prefix("seed=")).map_or(7, |t| t.parse().unwrap()) } };
    let s = match args[1].as_str() {
        "sphere" => sphere_cap(60.0, n, irr, 4),
        "zone" => sphere_zone(-40.0, 50.0, n, irr, 4),
        "cylinder" => cylinder_band(n, irr, 4),
        "catenoid" => catenoid_band(n, irr, 4),
        "unduloid" => unduloid_band(args.iter().find_map(|a| a.strip_prefix("neck=")).map_or(0.6, |t| t.parse().unwrap()), 1.0, n, irr, 4),
        "hole" => sphere_with_hole(args.iter().find_map(|a| a.strip_prefix("hole=")).map_or(60.0, |t| t.parse().unwrap()), n, irr, 4),
        "blend" => match n { 118 => cylinder_blend_coarse(), 920 => cylinder_blend(), 1292 => cylinder_blend_refined_patch(), _ => cylinder_blend_fine() },
        _ => panic!(),
    };
    let mut given = s.border_normals();
    if let Some(t) = args.iter().find_map(|a| a.strip_prefix("tilt=")) {
        let t = t.parse::<f64>().unwrap().to_radians();
        for (v, n) in &mut given {
            let p = s.positions[*v as usize];
            // tube axis: direction of the tube centre
            let a = (0..3).map(|k| { let a = (k as f64) * std::f64::consts::TAU / 3.0; [a.cos(), a.sin(), 0.0] }).chain((0..3).map(|k| { let a = (k as f64) * std::f64::consts::TAU / 3.0 + std::f64::consts::PI / 3.0; [a.cos(), a.sin(), 0.0] })).max_by(|a, b| (a[0] * p[0] + a[1] * p[1]).total_cmp(&(b[0] * p[0] + b[1] * p[1]))).unwrap();
            for c in 0..3 { n[c] = t.cos() * n[c] + t.sin() * a[c]; }
        }
    }
    let start = match args.get(3).map(|s| s.as_str()) { Some("noise") => s.noise(3, 0.4), Some("random") => s.random(5), Some("own") => s.positions.clone(), _ => s.flat() };
    let normals = if args.iter().any(|a| a == "fit") { BorderNormals::Fitted } else if args.iter().any(|a| a == "avg") { BorderNormals::Averaged } else { BorderNormals::Given(&given) };
    let disc = if args.iter().any(|a| a == "paper") { Discretization::Paper } else { Discretization::SecondOrder };
    let inner = if args.iter().any(|a| a == "conformal") { InnerFairness::Conformal } else { InnerFairness::Uniform };
    let verbose = args.iter().any(|a| a == "-v");
    let mut cb = |p: &Progress| { if verbose { eprintln!("  {:3} {:.3} {:.3e} {}", p.iterations, p.fraction, p.step, p.stage); } ControlFlow::Continue(()) };
    let threads = args.iter().find_map(|a| a.strip_prefix("t=")).map_or(1, |t| t.parse().unwrap());
    let mut o = Options { normals, discretization: disc, inner, threads, ..Options::default() };
    if verbose { o.progress = Some(&mut cb); }
    let r = fair(&start, &s.triangles, Selection::Mask(&s.free), o).unwrap();
    let d = r.report.diagonal;
    let e: Vec<f64> = s.free.iter().zip(&r.positions).filter(|p| *p.0).map(|(_, p)| s.surface.as_ref().map_or(0.0, |s| s.distance(*p)) / d).collect();
    let max = e.iter().fold(0.0f64, |a, b| a.max(*b));
    let rms = (e.iter().map(|x| x * x).sum::<f64>() / e.len() as f64).sqrt();
    if args.iter().any(|a| a == "prof") {
        let mut bins = vec![(0.0f64, 0usize, 9.0f64, 0.0f64); 24];
        let (lo, hi) = s.positions.iter().fold((9.0f64, -9.0f64), |a, p| (a.0.min(p[2]), a.1.max(p[2])));
        for (p, f) in r.positions.iter().zip(&s.free) { if *f { let k = (((p[2] - lo) / (hi - lo) * 24.0) as usize).clamp(0, 23); let rr = p[0].hypot(p[1]); let b = &mut bins[k]; b.0 += rr; b.1 += 1; b.2 = b.2.min(rr); b.3 = b.3.max(rr); } }
        for (k, b) in bins.iter().enumerate() { println!("z {:.3} n {} r {:.3} [{:.3} {:.3}]", lo + (hi - lo) * (k as f64 + 0.5) / 24.0, b.1, b.0 / b.1 as f64, b.2, b.3); }
    }
    println!("{} {} {} it {} max {:.2e} rms {:.2e} defect {:.1e} step {:.1e} | setup {:.4} start {:.4} iterate {:.4} q {:.4} total {:.4} | angle {:.2} flips {} H {:?} {:?} dev {:.3} rms {:.3}",
        args[1], r.report.free_vertices, r.report.outcome.name(), r.report.iterations, max, rms, r.report.defect, r.report.step,
        r.report.seconds.setup, r.report.seconds.start, r.report.seconds.iterate, r.report.seconds.quality, r.report.seconds.total,
        r.report.quality.worst_angle, r.report.quality.flipped.len(), r.report.quality.h_inside, r.report.quality.h_border, r.report.quality.normal_deviation, r.report.quality.normal_deviation_rms);
}
