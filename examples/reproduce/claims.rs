//! Convergence to known surfaces, and what the paper claims.

use std::fmt::Write;
use std::io;

use fairmesh_shapes::{Surface, Unduloid};

use crate::measure::{Distance, apart, diagonal, distortion, order, to_mesh};
use crate::short;
use crate::tool::{Case, Run, Tool};

const SIZES: [usize; 3] = [500, 2_000, 8_000];

/// Free vertices, error, and run.
type Solved = (usize, Distance, Run);

/// One surface at all sizes.
struct Series {
    kind: &'static str,
    runs: Vec<Solved>,
}

/// The surfaces that are known, by the kind that the program generates.
fn known() -> [(&'static str, Surface); 4] {
    [
        ("sphere-cap", Surface::Sphere),
        ("cylinder", Surface::Cylinder),
        ("catenoid", Surface::Catenoid),
        ("unduloid", Surface::Unduloid(Unduloid::new(0.7, 1.0))),
    ]
}

/// The section of the document.
pub fn section(tool: &Tool) -> io::Result<String> {
    let mut text = String::from(
        "## Convergence to known surfaces\n\n\
        Surfaces of constant mean curvature solve the equation. The interior starts on a wrong surface (flat, straight or pinched).\n\
        Errors are over the free part's diagonal; the order is in the edge length, from the coarsest to the finest mesh.\n\n\
        | surface | triangulation | vertices | largest error | rms | order of largest | of rms | iterations | outcome |\n\
        |---|---|---|---|---|---|---|---|---|\n",
    );
    let mut reproduced = Vec::new();
    for (kind, surface) in known() {
        for triangulation in ["regular", "irregular"] {
            let runs = SIZES
                .iter()
                .map(|n| {
                    let (case, run) = solve_known(tool, kind, triangulation, *n, &[])?;
                    let error = error(&case, &run, &surface);
                    Ok((case.free.len(), error, run))
                })
                .collect::<io::Result<Vec<Solved>>>()?;
            row(&mut text, kind, triangulation, &runs);
            reproduced.push(Series { kind, runs });
        }
    }
    text.push('\n');
    text += &claims(tool, &reproduced)?;
    Ok(text)
}

fn solve_known(
    tool: &Tool,
    kind: &str,
    triangulation: &str,
    n: usize,
    more: &[&str],
) -> io::Result<(Case, Run)> {
    let (name, count) = (format!("{kind}-{triangulation}-{n}"), n.to_string());
    let arguments = [
        kind,
        "--vertices",
        &count,
        "--triangulation",
        triangulation,
        "--start",
        "flat",
    ];
    let case = tool.generate(&name, &arguments)?;
    let mut all = vec!["--tolerance", "1e-10"];
    all.extend(more);
    let run = tool.fair(&case, if more.is_empty() { "fair" } else { "other" }, &all)?;
    Ok((case, run))
}

fn error(case: &Case, run: &Run, surface: &Surface) -> Distance {
    let free: Vec<[f64; 3]> = case.free.iter().map(|&v| run.positions[v as usize]).collect();
    let scale = diagonal(&free);
    Distance::of(free.iter().map(|p| surface.distance(*p) / scale))
}

fn row(text: &mut String, kind: &str, triangulation: &str, runs: &[Solved]) {
    let counts: Vec<usize> = runs.iter().map(|r| r.0).collect();
    let largest: Vec<f64> = runs.iter().map(|r| r.1.max).collect();
    let rms: Vec<f64> = runs.iter().map(|r| r.1.rms).collect();
    let list = |words: Vec<String>| words.join(" / ");
    let shown = |errors: &[f64]| list(errors.iter().map(|e| short(*e)).collect());
    // Rounding has no order.
    let order_of = |errors: &[f64]| {
        if errors[0] < 1e-8 {
            "exact".to_owned()
        } else {
            format!("{:.1}", order(errors, &counts))
        }
    };
    let _ = writeln!(
        text,
        "| {kind} | {triangulation} | {} | {} | {} | {} | {} | {} | {} |",
        list(counts.iter().map(usize::to_string).collect()),
        shown(&largest),
        shown(&rms),
        order_of(&largest),
        order_of(&rms),
        list(runs.iter().map(|r| r.2.iterations().to_string()).collect()),
        outcomes(runs)
    );
}

fn outcomes(runs: &[Solved]) -> String {
    let all: Vec<String> = runs.iter().map(|r| r.2.outcome()).collect();
    if all.iter().all(|o| *o == all[0]) {
        all[0].clone()
    } else {
        all.join(" / ")
    }
}

/// A claim, whether it holds here, and the figures.
struct Claim {
    what: &'static str,
    holds: Option<bool>,
    figures: String,
}

fn claims(tool: &Tool, reproduced: &[Series]) -> io::Result<String> {
    let blends = [
        ("118", "cylinder-blend"),
        ("920", "cylinder-blend"),
        ("13308", "cylinder-blend"),
        ("13308", "tetra-thing"),
    ]
    .map(|(n, kind)| {
        let case = tool.generate(&format!("claim-{kind}-{n}"), &[kind, "--vertices", n])?;
        let run = tool.fair(&case, "fair", &["--tolerance", "1e-10"])?;
        io::Result::Ok((case, run))
    });
    let [coarse, middle, fine, tetra] = blends;
    let blends = [coarse?, middle?, fine?, tetra?];
    let all = [
        spheres_and_cylinders(reproduced),
        extremes_on_the_boundary(reproduced, &blends),
        g1(&blends),
        coarse_is_close(&blends),
        weights_do_not_matter(tool, &blends[2])?,
        start_does_not_matter(tool)?,
        conformal_distorts_less(tool)?,
        no_minimal_energy(tool)?,
    ];
    let mut text = String::from("## Claims of the paper\n\n| claim | here | figures |\n|---|---|---|\n");
    for claim in all {
        let verdict = match claim.holds {
            Some(true) => "confirmed",
            Some(false) => "**not confirmed**",
            None => "not tried in this run",
        };
        let _ = writeln!(text, "| {} | {verdict} | {} |", claim.what, claim.figures);
    }
    text.push('\n');
    Ok(text)
}

fn spheres_and_cylinders(reproduced: &[Series]) -> Claim {
    let worst = |kind: &str, largest: usize| {
        let of = reproduced.iter().filter(|r| r.kind == kind);
        of.map(|r| r.runs[largest].1.max).fold(0.0, f64::max)
    };
    let last = SIZES.len() - 1;
    let (sphere, cylinder, catenoid) = (
        worst("sphere-cap", 0),
        worst("cylinder", last),
        worst("catenoid", last),
    );
    Claim {
        what: "Spheres, cylinders and minimal surfaces are reproduced (section 3)",
        holds: Some(sphere < 1e-8 && cylinder < 1e-4 && catenoid < 1e-4),
        figures: format!(
            "largest errors: sphere {} at {} vertices; cylinder {}, catenoid {} at {}",
            short(sphere),
            SIZES[0],
            short(cylinder),
            short(catenoid),
            SIZES[last]
        ),
    }
}

/// How far the curvature inside exceeds that on the boundary, over the boundary's largest.
fn excess(run: &Run) -> f64 {
    let ([low, high], [least, most]) = (run.curvature("h_inside"), run.curvature("h_boundary"));
    (high - most).max(least - low).max(0.0) / most.abs().max(least.abs())
}

fn extremes_on_the_boundary(reproduced: &[Series], blends: &[(Case, Run)]) -> Claim {
    let known = reproduced
        .iter()
        .filter(|r| r.kind != "catenoid")
        .flat_map(|r| &r.runs)
        .map(|r| excess(&r.2))
        .fold(0.0, f64::max);
    let worst = blends.iter().map(|b| excess(&b.1)).fold(0.0, f64::max);
    let [low, high] = blends[2].1.curvature("h_inside");
    let [least, most] = blends[2].1.curvature("h_boundary");
    Claim {
        what: "The extremes of H are on the boundary (section 3)",
        holds: Some(worst < 1e-6 && known < 1e-6),
        figures: format!(
            "relative excess of H inside over the boundary: blends and tetra thing {}, known surfaces {}; blend of 13,308: \
             {low:.4} to {high:.4} inside, {least:.4} to {most:.4} on the boundary",
            short(worst),
            short(known)
        ),
    }
}

fn g1(blends: &[(Case, Run)]) -> Claim {
    let all: Vec<f64> = blends[..3]
        .iter()
        .map(|b| b.1.number(&["quality", "normal_deviation_rms"]))
        .collect();
    let refined = (blends[2].0.positions.len() as f64 / blends[0].0.positions.len() as f64).sqrt();
    let order = (all[0] / all[2]).ln() / refined.ln();
    Claim {
        what: "The surface is G1 at the boundary (sections 1, 7.5)",
        holds: Some(order > 0.8 && all[2] < 2.0),
        figures: format!(
            "angle between the prescribed normals and the triangles' mean normal, rms: {} degrees at 118, 920 and 13,308 \
             vertices; order {order:.2} in the edge length (a smooth tangent surface has 1)",
            all.iter().map(|x| short(*x)).collect::<Vec<_>>().join(", ")
        ),
    }
}

fn coarse_is_close(blends: &[(Case, Run)]) -> Claim {
    let (case, fine) = (&blends[2].0, &blends[2].1);
    let distance = |k: usize| to_mesh(&blends[k].1.positions, &fine.positions, &case.triangles).max;
    let (coarse, middle) = (distance(0), distance(1));
    Claim {
        what: "A coarse mesh already approximates the smooth surface (sections 3, 7.4)",
        holds: Some(coarse < 0.02 && middle < coarse),
        figures: format!(
            "largest distance to the surface of 13,308 vertices: {} from 118, {} from 920",
            short(coarse),
            short(middle)
        ),
    }
}

fn weights_do_not_matter(tool: &Tool, (fine_case, fine): &(Case, Run)) -> io::Result<Claim> {
    let patch = [
        "cylinder-blend",
        "--vertices",
        "920",
        "--triangulation",
        "refined",
    ];
    let case = tool.generate("weights", &patch)?;
    let mut figures = Vec::new();
    let mut worst = 0.0f64;
    for inner in ["uniform", "conformal", "convex"] {
        if inner == "convex" && !tool.can(inner) {
            continue;
        }
        let run = tool.fair(&case, inner, &["--inner-fairness", inner])?;
        let distance = to_mesh(&run.positions, &fine.positions, &fine_case.triangles).max;
        figures.push(format!("{inner} {} ({})", short(distance), run.outcome()));
        worst = worst.max(distance);
    }
    Ok(Claim {
        what: "Inner fairness can be chosen freely: outer and inner fairness are separate (sections 3, 7.3)",
        holds: Some(worst < 5e-3),
        figures: format!(
            "blend of 920 with the patch, largest distance to the surface of 13,308: {}",
            figures.join(", ")
        ),
    })
}

fn start_does_not_matter(tool: &Tool) -> io::Result<Claim> {
    let mut runs = Vec::new();
    for start in ["exact", "noise", "random"] {
        let name = format!("start-{start}");
        let case = tool.generate(&name, &["cylinder-blend", "--start", start, "--noise", "0.5"])?;
        runs.push(tool.fair(&case, "fair", &["--tolerance", "1e-10"])?);
    }
    let worst = runs[1..]
        .iter()
        .map(|run| apart(&runs[0].positions, &run.positions).max)
        .fold(0.0, f64::max);
    Ok(Claim {
        what: "The surface is defined by the boundary alone (sections 3, 8)",
        holds: Some(worst < 1e-7),
        figures: format!(
            "largest distance between results from a smooth, a rough (half an edge length) and a random interior, 920 vertices: {}",
            short(worst)
        ),
    })
}

fn conformal_distorts_less(tool: &Tool) -> io::Result<Claim> {
    let case = tool.generate(
        "distortion",
        &[
            "cylinder-blend",
            "--vertices",
            "920",
            "--triangulation",
            "refined",
        ],
    )?;
    let angles = |inner: &str| {
        let run = tool.fair(&case, inner, &["--inner-fairness", inner])?;
        io::Result::Ok(distortion(&case, &run.positions).rms)
    };
    let (uniform, conformal) = (angles("uniform")?, angles("conformal")?);
    Ok(Claim {
        what: "Conformal weights distort the input's triangles least (section 7.3)",
        holds: Some(conformal < uniform),
        figures: format!(
            "rms change of the angles, blend with the patch: uniform {} degrees, conformal {}",
            short(uniform),
            short(conformal)
        ),
    })
}

fn no_minimal_energy(tool: &Tool) -> io::Result<Claim> {
    let what = "Minimal-energy surfaces do not reproduce cylinders (section 3)";
    if !tool.can("--target") {
        return Ok(Claim {
            what,
            holds: None,
            figures:
                "on a cylinder of radius 1 the equation's right-hand side -2H(H² - K) is 1/4 and its left 0"
                    .to_owned(),
        });
    }
    let errors = |kind: &str, surface: Surface| {
        let mut errors = Vec::new();
        for n in [500, 2_000] {
            let (case, run) = solve_known(tool, kind, "regular", n, &["--target", "minimal-energy"])?;
            errors.push((error(&case, &run, &surface).max, run.outcome()));
        }
        io::Result::Ok(errors)
    };
    let (cylinder, sphere) = (
        errors("cylinder", Surface::Cylinder)?,
        errors("sphere-cap", Surface::Sphere)?,
    );
    Ok(Claim {
        what,
        holds: Some(cylinder[1].0 > 1e-3 && sphere[1].0 < 1e-6 && cylinder[1].1 == "converged"),
        figures: format!(
            "`--target minimal-energy` between the circles of a cylinder: {} from it at 500, {} at 2,000 vertices ({}); from a \
             sphere: {}",
            short(cylinder[0].0),
            short(cylinder[1].0),
            cylinder[1].1,
            short(sphere[1].0)
        ),
    })
}
