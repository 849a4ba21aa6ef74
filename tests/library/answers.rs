//! `tests/answers.json`: small inputs and what the library answers, for the tests of the bindings, which only have to pass things through.
//!
//! Names of calls and options are those of Python; lists of options are JSON's. Each case has its mesh, `free` vertices if others than
//! the mesh's, options, and its answer: sampled positions, what came of it, and numbers of the report; or the error. Renew the file
//! with `FAIRMESH_WRITE=1` only in a commit that means to change results.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use fairmesh::{
    BoundaryCurvature, BoundaryNormals, BridgeOptions, Cap, Coincident, Combine, Discretization, Error,
    FillOptions, FillOutcome, Filled, InnerFairness, InteriorNormals, Intersections, Join, LoopFilter,
    LoopReport, Loops, OnFailure, Options, OutputPrecision, Place, Region, RegionStep, RemeshOptions, Rim,
    Seed, Selection, Solution, Target, boundary_loops, bridge, erase, fair, fill_holes, refill_region,
    remesh_region, select_region,
};
use serde_json::{Map, Value, json};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/answers.json");
/// Numbers of the file agree with those of today to this; hosts, with ten times as much.
const NEAR: f64 = 1e-9;
/// Vertices along a side of the sheets,
const SIDE: usize = 19;
/// and as many rows around what is free.
const FRAME: usize = 5;

struct Mesh {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    free: Vec<u32>,
}

/// As the file has it.
fn rounded(p: [f64; 3]) -> [f64; 3] {
    p.map(|c| (c * 1e6).round() / 1e6)
}

fn is_inside(i: usize) -> bool {
    (FRAME..SIDE - FRAME).contains(&i)
}

/// A part of an ellipsoid, irregular, with a dent that may move.
fn sheet() -> Mesh {
    let mut positions = Vec::new();
    for j in 0..SIDE {
        for i in 0..SIDE {
            let is_side = i == 0 || i == SIDE - 1;
            let shaken = if is_side { 0.0 } else { 0.03 };
            let shift = |k: usize| shaken * ((k * 37 % 11) as f64 / 5.0 - 1.0);
            let [u, v] = [i as f64 + shift(i + SIDE * j), j as f64 + shift(i * j + 3)]
                .map(|c| 2.0 * c / (SIDE - 1) as f64 - 1.0);
            let dent = if is_inside(i) && is_inside(j) { 0.1 } else { 0.0 };
            let z = 0.6 * (1.0 - 0.25 * (u * u + v * v)).sqrt();
            positions.push(rounded([0.5 * u, 0.4 * v, z - dent]));
        }
    }
    let corner = |i: usize, j: usize| (SIDE * j + i) as u32;
    let cells = (0..SIDE - 1).flat_map(|j| (0..SIDE - 1).map(move |i| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [
            corner(i, j),
            corner(i + 1, j),
            corner(i + 1, j + 1),
            corner(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    });
    let inside = (0..SIDE * SIDE).filter(|v| is_inside(v % SIDE) && is_inside(v / SIDE));
    Mesh {
        positions,
        triangles: triangles.collect(),
        free: inside.map(|v| v as u32).collect(),
    }
}

/// The sheet without the triangles around what is free, and with a small hole.
fn holed() -> Mesh {
    let mut mesh = sheet();
    mesh.free.push((2 * SIDE + 2) as u32);
    (mesh.triangles).retain(|t| !t.iter().any(|v| mesh.free.contains(v)));
    mesh.free.clear();
    mesh
}

/// Two open tubes of radius 1 around the z axis with a gap between them.
fn tubes() -> Mesh {
    const AROUND: usize = 12;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for bottom in [0.5, -2.0] {
        let base = positions.len() as u32;
        for k in 0..4 * AROUND {
            let turn = 2.0 * PI * (k % AROUND) as f64 / AROUND as f64;
            positions.push(rounded([
                turn.cos(),
                turn.sin(),
                bottom + 0.5 * (k / AROUND) as f64,
            ]));
        }
        for k in 0..3 * AROUND {
            let next = k / AROUND * AROUND + (k + 1) % AROUND;
            let [a, b, c, d] = [k, next, next + AROUND, k + AROUND].map(|v| base + v as u32);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh {
        positions,
        triangles,
        free: Vec::new(),
    }
}

/// Six triangles around vertex 0.
fn fan() -> Mesh {
    let ring =
        [[2, 0], [1, 2], [-1, 2], [-2, 0], [-1, -2], [1, -2]].map(|[x, y]| [f64::from(x), f64::from(y), 0.0]);
    Mesh {
        positions: [[0.0, 0.0, 0.5]].into_iter().chain(ring).collect(),
        triangles: (1..7).map(|k| [0, k, k % 6 + 1]).collect(),
        free: vec![0],
    }
}

/// A number that is the same on every machine.
fn number(x: f64) -> Value {
    let scale = 10f64.powi(11 - x.abs().max(1e-6).log10().ceil() as i32);
    json!((x * scale).round() / scale)
}

fn point(p: [f64; 3]) -> Value {
    p.map(number).to_vec().into()
}

/// About `count` of the vertices with their places.
fn samples(positions: &[[f64; 3]], vertices: &[u32], count: usize) -> Value {
    let chosen = vertices.iter().step_by((vertices.len() / count).max(1));
    chosen
        .map(|&v| json!([v, point(positions[v as usize])]))
        .collect()
}

fn fairing(report: &fairmesh::Report) -> Value {
    let Value::Object(mut told) = json!({
        "outcome": report.outcome.name(),
        "free_vertices": report.free_vertices,
        "diagonal": number(report.diagonal),
        "worst_angle": number(report.quality.worst_angle),
        "worst_triangle": report.quality.worst_triangle,
        "h_inside": report.quality.h_inside.map(number).to_vec(),
        "h_boundary": report.quality.h_boundary.map(number).to_vec(),
        "boundary_kink": number(report.quality.boundary_kink),
        "bending_energy": number(report.quality.bending_energy),
        "intersections_checked": report.self_intersections.is_some(),
        "level_count": report.levels.len(),
    }) else {
        unreachable!()
    };
    told.retain(|name, _| name != "level_count" || !report.levels.is_empty());
    told.into()
}

fn solution(found: &Solution, free: &[u32]) -> Value {
    let scalars = |list: &[(u32, f64)]| -> Value {
        list.iter()
            .step_by(20)
            .map(|&(v, h)| json!([v, number(h)]))
            .collect()
    };
    json!({
        "positions": samples(&found.positions, free, 4),
        "report": fairing(&found.report),
        "mean_curvature": scalars(&found.mean_curvature),
        "gaussian_curvature": scalars(&found.gaussian_curvature),
        "boundary_normals": found.boundary_normals.iter().step_by(8).map(|&(v, n)| json!([v, point(n)])).collect::<Value>(),
        "continuity": found.report.components[0].continuity.iter().map(|c| json!({
            "vertex": c.vertex, "reached": number(c.reached), "jump": number(c.jump), "curvature": number(c.curvature),
        })).collect::<Value>(),
    })
}

fn looped(report: &LoopReport) -> Value {
    json!({
        "loop_indices": report.loops,
        "edge_count": report.edges,
        "outcome": report.outcome.name(),
        "reason": match &report.outcome {
            FillOutcome::Flat { reason } => reason.name(),
            FillOutcome::LeftOpen(reason) => reason.name(),
            _ => "none",
        },
        "vertices": [report.vertices.start, report.vertices.end],
        "faces": [report.triangles.start, report.triangles.end],
    })
}

fn patched(positions: &[[f64; 3]], triangles: usize, kept: usize) -> Map<String, Value> {
    let new: Vec<u32> = (kept as u32..positions.len() as u32).collect();
    let Value::Object(told) = json!({
        "vertex_count": positions.len(),
        "face_count": triangles,
        "positions": samples(positions, &new, 4),
    }) else {
        unreachable!()
    };
    told
}

fn filled(found: &Filled, kept: usize) -> Value {
    let mut told = patched(&found.positions, found.triangles.len(), kept);
    told.insert("loops".into(), found.loops.iter().map(looped).collect());
    let parents = found.parents.iter().step_by((found.parents.len() / 3).max(1));
    let parents = parents.map(|p| json!([p.vertices, point(p.weights)]));
    told.insert("parents".into(), parents.collect());
    told.into()
}

/// The cases that are made so far.
struct Cases(Vec<Value>);

impl Cases {
    fn add(&mut self, name: &str, call: &str, mesh: &str, options: Value, answer: Value) {
        self.0
            .push(json!({ "name": name, "call": call, "mesh": mesh, "options": options, "answer": answer }));
    }

    /// `kind` is what the numbers count.
    fn refused(&mut self, name: &str, call: &str, mesh: &str, options: Value, kind: &str, error: &Error) {
        // The C interface says what is numbered.
        let message = error
            .to_string()
            .replace("the selection names element 5", "loop 5 is named");
        let told = json!({ "status": error.name(), "element_kind": kind, "message": message });
        self.0
            .push(json!({ "name": name, "call": call, "mesh": mesh, "options": options, "error": told }));
    }

    fn fair(&mut self, name: &str, mesh: &Mesh, options: Value, set: &dyn Fn(&mut Options)) {
        let mut asked = Options {
            threads: 1,
            ..Options::default()
        };
        set(&mut asked);
        let free: Vec<u32> = match options.get("free") {
            Some(free) => serde_json::from_value(free.clone()).unwrap(),
            None => mesh.free.clone(),
        };
        let found = fair(
            &mesh.positions,
            &mesh.triangles,
            Selection::Vertices(&free),
            &asked,
        )
        .expect(name);
        self.add(name, "fair", "sheet", options, solution(&found, &free));
    }

    fn fill(&mut self, name: &str, file: &str, mesh: &Mesh, options: Value, set: &dyn Fn(&mut FillOptions)) {
        let mut asked = FillOptions::default();
        asked.fairing.threads = 1;
        set(&mut asked);
        let found = fill_holes(&mesh.positions, &mesh.triangles, &asked).expect(name);
        self.add(
            name,
            "fill_holes",
            file,
            options,
            filled(&found, mesh.positions.len()),
        );
    }

    fn select(&mut self, name: &str, mesh: &Mesh, options: Value, steps: &[RegionStep]) -> Vec<u32> {
        let joined = Coincident::default();
        let found = select_region(&mesh.positions, &mesh.triangles, steps, joined).expect(name);
        self.add(name, name, "sheet", options, json!({ "faces": found.triangles }));
        found.triangles
    }
}

/// Calls a function with a name, options of JSON and the same as Rust sets them, a case a line.
macro_rules! each {
    ($add:ident: $($name:literal $options:tt |$asked:pat_param| $set:expr;)*) => {
        $($add($name, json!($options), &|$asked| $set);)*
    };
}

fn fairings(cases: &mut Cases, sheet: &Mesh) {
    let all = Selection::Vertices(&sheet.free);
    let rim = fair(&sheet.positions, &sheet.triangles, all, &Options::default()).unwrap();
    let rim: Vec<u32> = rim.boundary_normals.iter().map(|&(v, _)| v).collect();
    let (tilted, values) = ([0.28, 0.0, 0.96], vec![-0.5; rim.len()]);
    let given: Vec<_> = rim.iter().map(|&v| (v, -0.5)).collect();
    let normals: Vec<_> = rim[..5].iter().map(|&v| (v, tilted)).collect();
    let point = sheet.free[24];
    let without: Vec<u32> = (sheet.free.iter().copied()).filter(|&v| v != point).collect();
    let mut add = |name: &str, given: Value, set: &dyn Fn(&mut Options)| cases.fair(name, sheet, given, set);
    each! { add:
        "region" {} |_| ();
        "conformal" { "inner_fairness": "conformal" } |o| o.inner_fairness = InnerFairness::Conformal;
        "convex" { "inner_fairness": "convex" } |o| o.inner_fairness = InnerFairness::Convex;
        "discretization" { "discretization": "paper" } |o| o.discretization = Discretization::Paper;
        "g2" { "continuity": 1.0 } |o| o.continuity = 1.0;
        "curvature" { "continuity": 1.0, "boundary_curvature": { "vertices": rim, "values": values } }
            |o| (o.continuity, o.boundary_curvature) = (1.0, BoundaryCurvature::Given(given.clone()));
        "half" { "continuity": 0.5, "boundary_curvature": { "vertices": rim, "values": values } }
            |o| (o.continuity, o.boundary_curvature) = (0.5, BoundaryCurvature::Given(given.clone()));
        "loop" { "continuity": 1.0, "boundary_curvature": { "vertices": rim, "values": values }, "loop_continuity": [[rim[3], 0.25]] } |o| {
            (o.continuity, o.boundary_curvature) = (1.0, BoundaryCurvature::Given(given.clone()));
            o.loop_continuity = vec![(rim[3], 0.25)];
        };
        "constant" { "target": 2.0 } |o| o.target = Target::Constant(2.0);
        "minimal energy" { "target": "minimal_energy" } |o| o.target = Target::MinimalEnergy;
        "averaged" { "boundary_normals": "averaged" } |o| o.boundary_normals = BoundaryNormals::Averaged;
        "normals" { "boundary_normals": { "vertices": rim[..5], "vectors": vec![tilted; 5] } }
            |o| o.boundary_normals = BoundaryNormals::Given(normals.clone());
        "point" { "free": without } |_| ();
        "point of the input" { "free": without, "interior_normals": "input" }
            |o| o.interior_normals = InteriorNormals::Input;
        "tolerance" { "tolerance": 0.02 } |o| o.tolerance = 0.02;
        "iterations" { "max_iterations": 1 } |o| o.max_iterations = 1;
        "single" { "output_precision": "single" } |o| o.output_precision = OutputPrecision::Single;
        "unchecked" { "intersections": "skip" } |o| o.intersections = Intersections::Skip;
    }
}

fn fillings(cases: &mut Cases, holed: &Mesh) {
    let kinds = boundary_loops(&holed.positions, &holed.triangles).unwrap();
    let is_large = |&k: &usize| (10..40).contains(&kinds[k].vertices.len());
    let hole = (0..3).find(is_large).unwrap();
    let around = &kinds[hole].vertices;
    let across = [around[2], around[around.len() / 2 + 2]];
    let values = vec![-0.5; around.len()];
    let given: Vec<_> = around.iter().map(|&v| (v, -0.5)).collect();
    let flatter = vec![-0.3; around.len()];
    let less: Vec<_> = around.iter().map(|&v| (v, -0.3)).collect();
    let (centre, radius) = ([-0.375, -0.3, 0.5], 0.2);
    let (low, high) = ([-1.0; 3], [-0.2, -0.15, 1.0]);
    let mut add = |name: &str, given: Value, set: &dyn Fn(&mut FillOptions)| {
        cases.fill(name, "holed", holed, given, set);
    };
    each! { add:
        "hole" {} |_| ();
        "density" { "density": 2.5 } |o| o.density = 2.5;
        "few" { "max_new_vertices": 5 } |o| o.max_new_vertices = 5;
        "not faired" { "fair": false } |o| o.fair = false;
        "hole, G2" { "continuity": 1.0, "boundary_curvature": { "vertices": around, "values": values } }
            |o| (o.fairing.continuity, o.fairing.boundary_curvature) = (1.0, BoundaryCurvature::Given(given.clone()));
        "hole, half" { "continuity": 0.5, "boundary_curvature": { "vertices": around, "values": values } }
            |o| (o.fairing.continuity, o.fairing.boundary_curvature) = (0.5, BoundaryCurvature::Given(given.clone()));
        "hole, flatter" { "continuity": 1.0, "boundary_curvature": { "vertices": around, "values": flatter } }
            |o| (o.fairing.continuity, o.fairing.boundary_curvature) = (1.0, BoundaryCurvature::Given(less.clone()));
        "failed" { "max_iterations": 1 } |o| o.fairing.max_iterations = 1;
        "failed, flat" { "max_iterations": 1, "on_failure": "flat" }
            |o| (o.fairing.max_iterations, o.on_failure) = (1, OnFailure::Flat);
        "failed, open" { "max_iterations": 1, "on_failure": "open" }
            |o| (o.fairing.max_iterations, o.on_failure) = (1, OnFailure::Open);
        "max_edges" { "max_edges": 10 } |o| o.loops = Loops::UpTo(10);
        "named" { "loops": [hole] } |o| o.loops = Loops::Chosen(vec![hole]);
        "rim, freely" { "relax_rim": 2 } |o| o.rim = Rim { relax: 2, within: None };
        "rim" { "relax_rim": 2, "relax_within": 1e-4 } |o| o.rim = Rim { relax: 2, within: Some(1e-4) };
        "guide" { "guides": [across], "fair": false } |o| (o.guides, o.fair) = (vec![across], false);
    }
    let mut only = |name: &str, given: Value, set: &dyn Fn(&mut LoopFilter)| {
        let mut filter = LoopFilter::default();
        set(&mut filter);
        add(name, given, &|o| o.loops = Loops::Where(filter.clone()));
    };
    each! { only:
        "max_length" { "max_length": 0.8 } |f| f.max_length = Some(0.8);
        "max_area" { "max_area": 0.05 } |f| f.max_area = Some(0.05);
        "max_diagonal" { "max_diagonal": 0.3 } |f| f.max_diagonal = Some(0.3);
        "except_longest" { "except_longest": 1 } |f| f.except_longest = 1;
        "of_components" { "of_components": [1] } |f| f.components = Some(vec![1]);
        "in a ball" { "within": [centre, radius] } |f| f.within = Some(Place::Ball { centre, radius });
        "in a box" { "within": [low, high] } |f| f.within = Some(Place::Box { low, high });
    }
}

fn joined_fillings(cases: &mut Cases, tubes: &Mesh) {
    let ends = boundary_loops(&tubes.positions, &tubes.triangles).unwrap();
    let is_near = |k: &usize| tubes.positions[ends[*k].vertices[0] as usize][2].abs() < 1.0;
    let near: Vec<usize> = (0..ends.len()).filter(is_near).collect();
    let mut add = |name: &str, join: Value, set: &dyn Fn(&mut FillOptions)| {
        cases.fill(
            name,
            "tubes",
            tubes,
            json!({ "loops": near, "join": join }),
            &|o| {
                o.loops = Loops::Chosen(near.clone());
                set(o);
            },
        );
    };
    each! { add:
        "joined" [near] |o| o.join = Join::Groups(vec![near.clone()]);
        "joined by itself" "auto" |o| o.join = Join::Auto;
        "apart" "none" |o| o.join = Join::None;
    }
    let given = json!({ "loops": near, "join": "none", "cap": "flat" });
    cases.fill("flat caps", "tubes", tubes, given, &|o| {
        (o.loops, o.cap) = (Loops::Chosen(near.clone()), Cap::Flat);
    });
}

fn bridges(cases: &mut Cases, tubes: &Mesh) {
    let chains = [[0u32, 1, 2], [84, 85, 86]];
    for (name, width, fill) in [
        ("bridge", None, false),
        ("wide bridge", Some(2.2), false),
        ("bridge, filled", None, true),
    ] {
        let mut asked = BridgeOptions {
            width,
            fill,
            ..BridgeOptions::default()
        };
        asked.filling.fairing.threads = 1;
        let [start, end] = &chains;
        let found = bridge(&tubes.positions, &tubes.triangles, [start, end], &asked).unwrap();
        let mut answer = patched(&found.positions, found.triangles.len(), tubes.positions.len());
        let sorted = |list: &Vec<u32>| {
            let mut list = list.clone();
            list.sort_unstable();
            list
        };
        answer.insert("chains".into(), found.chains.iter().map(sorted).collect());
        answer.insert(
            "sides".into(),
            found.sides.iter().map(|side| json!(side.len())).collect(),
        );
        answer.insert("strip".into(), looped(&found.strip));
        answer.insert("rest".into(), json!(found.rest.len()));
        answer.insert(
            "whole".into(),
            found
                .whole
                .as_ref()
                .map_or(Value::Null, |w| w.outcome.name().into()),
        );
        let mut options = json!({ "start": start, "end": end });
        if let Some(width) = width {
            options["width"] = width.into();
        }
        if fill {
            options["fill"] = true.into();
        }
        cases.add(name, "bridge", "tubes", options, answer.into());
    }
}

fn edits(cases: &mut Cases, sheet: &Mesh) {
    let (x, t) = (&sheet.positions, &sheet.triangles);
    let around: Vec<u32> = (0..t.len() as u32)
        .filter(|&k| t[k as usize].iter().any(|v| sheet.free.contains(v)))
        .collect();
    let left = erase(x, t, &around, Coincident::default()).unwrap();
    let answer = json!({ "face_count": left.kept.len(), "dropped_count": left.dropped, "loops": left.loops });
    cases.add("erase", "erase", "sheet", json!({ "erased": around }), answer);
    for (name, density, max_vertices) in [
        ("remesh", 2f64.sqrt(), 200_000),
        ("finer", 2.5, 200_000),
        ("coarser", 2f64.sqrt(), 6),
    ] {
        let asked = RemeshOptions {
            density,
            max_vertices,
            ..RemeshOptions::default()
        };
        let new = remesh_region(x, t, Selection::Vertices(&sheet.free), &asked).unwrap();
        let mut answer = patched(&new.positions, new.triangles.len(), new.kept_vertices.len());
        answer.insert("free_vertices".into(), new.free.len().into());
        answer.insert("kept_vertices".into(), new.kept_vertices.len().into());
        answer.insert("kept_faces".into(), new.kept_triangles.len().into());
        let mut options = json!({});
        if density > 2.0 {
            options["density"] = density.into();
        }
        if max_vertices < 10 {
            options["max_vertices"] = max_vertices.into();
        }
        cases.add(name, "remesh", "sheet", options, answer.into());
    }
    let new = refill_region(x, t, Selection::Vertices(&sheet.free), &FillOptions::default())
        .unwrap()
        .unwrap();
    let mut answer = patched(&new.positions, new.triangles.len(), new.kept_vertices.len());
    answer.insert("kept_vertices".into(), new.kept_vertices.len().into());
    cases.add("refill", "refill", "sheet", json!({}), answer.into());
}

fn regions(cases: &mut Cases, sheet: &Mesh) {
    let plus = |region| RegionStep::With(Combine::Add, region);
    let mut found = Vec::new();
    let mut add = |name: &str, options: Value, set: &dyn Fn(&mut Vec<RegionStep>)| {
        let mut steps = Vec::new();
        set(&mut steps);
        found = cases.select(name, sheet, options, &steps);
    };
    let (centre, radius) = ([0.2, 0.1, 0.5], 0.15);
    let (low, high) = ([-1.0, -1.0, -1.0], [0.0, -0.2, 1.0]);
    let (point, normal) = ([0.35, 0.0, 0.0], [1.0, 0.5, 0.0]);
    let (corner, angle) = ([-0.5, -0.4, 0.4], 12.0);
    let seed = Seed::Point(corner);
    each! { add:
        "select_box" { "low": low, "high": high } |s| s.push(plus(Region::Within(Place::Box { low, high })));
        "select_halfspace" { "point": point, "normal": normal }
            |s| s.push(plus(Region::HalfSpace { point, normal }));
        "select_geodesic" { "seed": corner, "radius": radius } |s| s.push(plus(Region::Geodesic { seed, radius }));
        "select_patch" { "seed": corner, "angle": angle } |s| s.push(plus(Region::Patch { seed, angle }));
        "select_component" { "seed": 7 } |s| s.push(plus(Region::Component(Seed::Vertex(7))));
        "select_ball" { "centre": centre, "radius": radius }
            |s| s.push(plus(Region::Within(Place::Ball { centre, radius })));
    }
    let region = found.clone();
    let from = plus(Region::Triangles(region.clone()));
    let mut add = |name: &str, options: Value, step| {
        cases.select(name, sheet, options, &[from.clone(), step]);
    };
    add(
        "grow",
        json!({ "region": region, "rings": 2 }),
        RegionStep::Grow(2),
    );
    add(
        "shrink",
        json!({ "region": region, "rings": 1 }),
        RegionStep::Shrink(1),
    );
}

/// An error of each kind of element, and each option out of its range.
fn refused_fairings(cases: &mut Cases, fan: &Mesh) {
    let mut of_mesh = |kind: &str, triangles: &[[u32; 3]], free: &[u32]| {
        let selection = Selection::Vertices(free);
        let error = fair(&fan.positions, triangles, selection, &Options::default()).unwrap_err();
        let options = json!({ "faces": triangles, "free": free });
        cases.refused(kind, "fair", "fan", options, kind, &error);
    };
    let and = |more: [u32; 3]| fan.triangles.iter().copied().chain([more]).collect::<Vec<_>>();
    of_mesh("none", &fan.triangles, &[]);
    of_mesh("vertex", &fan.triangles, &[3]);
    of_mesh("triangle", &and([0, 1, 9]), &[0]);
    of_mesh("edge", &and([0, 1, 4]), &[0]);

    let mut one = |name: &str, value: Value, set: &dyn Fn(&mut Options)| {
        let mut options = Options::default();
        set(&mut options);
        let selection = Selection::Vertices(&[0]);
        let error = fair(&fan.positions, &fan.triangles, selection, &options).unwrap_err();
        let options = json!({ name: value });
        cases.refused(name, "fair", "fan", options, "argument", &error);
    };
    each! { one:
        "continuity" 1.01 |o| o.continuity = 1.01;
        "target" "inf" |o| o.target = Target::Constant(f64::INFINITY);
        "tolerance" 0.0 |o| o.tolerance = 0.0;
        "max_iterations" 0 |o| o.max_iterations = 0;
        "threads" 1025 |o| o.threads = 1025;
    }
}

fn refused_fillings(cases: &mut Cases, holed: &Mesh) {
    let mut one = |name: &str, value: Value, set: &dyn Fn(&mut FillOptions)| {
        let mut options = FillOptions::default();
        set(&mut options);
        let error = fill_holes(&holed.positions, &holed.triangles, &options).unwrap_err();
        let kind = if name == "loops" { "loop" } else { "argument" };
        cases.refused(name, "fill_holes", "holed", json!({ name: value }), kind, &error);
    };
    let groups = vec![vec![0, 1], vec![1]];
    each! { one:
        "loops" [5] |o| o.loops = Loops::Chosen(vec![5]);
        "density" 0.0 |o| o.density = 0.0;
        "relax_within" (-1.0) |o| o.rim = Rim { relax: 1, within: Some(-1.0) };
        "join" [[0, 1], [1]] |o| o.join = Join::Groups(groups.clone());
    }
    let mut only = |name: &str, value: Value, set: &dyn Fn(&mut LoopFilter)| {
        let mut filter = LoopFilter::default();
        set(&mut filter);
        one(name, value, &|o| o.loops = Loops::Where(filter.clone()));
    };
    let (centre, radius) = ([0.0; 3], -1.0);
    each! { only:
        "max_length" (-1.0) |f| f.max_length = Some(-1.0);
        "max_area" (-1.0) |f| f.max_area = Some(-1.0);
        "max_diagonal" (-1.0) |f| f.max_diagonal = Some(-1.0);
        "within" [centre, radius] |f| f.within = Some(Place::Ball { centre, radius });
    }
}

fn meshes() -> [(&'static str, Mesh); 4] {
    [
        ("sheet", sheet()),
        ("holed", holed()),
        ("tubes", tubes()),
        ("fan", fan()),
    ]
}

fn written() -> Value {
    let [(_, sheet), (_, holed), (_, tubes), (_, fan)] = meshes();
    let mut cases = Cases(Vec::new());
    fairings(&mut cases, &sheet);
    fillings(&mut cases, &holed);
    joined_fillings(&mut cases, &tubes);
    bridges(&mut cases, &tubes);
    edits(&mut cases, &sheet);
    regions(&mut cases, &sheet);
    refused_fairings(&mut cases, &fan);
    refused_fillings(&mut cases, &holed);
    let of = |mesh: &Mesh| json!({ "vertices": mesh.positions, "faces": mesh.triangles, "free": mesh.free });
    let meshes: Map<String, Value> = meshes()
        .iter()
        .map(|(name, mesh)| ((*name).to_owned(), of(mesh)))
        .collect();
    json!({ "meshes": meshes, "cases": cases.0 })
}

/// A case a line, a mesh a line.
fn text(all: &Value) -> String {
    let meshes = all["meshes"].as_object().unwrap().iter();
    let meshes: Vec<String> = meshes.map(|(name, mesh)| format!("\"{name}\": {mesh}")).collect();
    let cases: Vec<String> = all["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(Value::to_string)
        .collect();
    format!(
        "{{\"meshes\": {{\n{}\n}}, \"cases\": [\n{}\n]}}\n",
        meshes.join(",\n"),
        cases.join(",\n")
    )
}

/// The first place where two values differ by more than rounding.
fn difference(path: &str, a: &Value, b: &Value) -> Option<String> {
    let differs = || Some(format!("{path}: {a} is not {b}"));
    match (a, b) {
        (Value::Number(x), Value::Number(y)) => {
            let (x, y) = (x.as_f64()?, y.as_f64()?);
            if (x - y).abs() <= NEAR * y.abs().max(1.0) {
                None
            } else {
                differs()
            }
        }
        (Value::Array(x), Value::Array(y)) if x.len() == y.len() => {
            let mut pairs = x.iter().zip(y).enumerate();
            pairs.find_map(|(k, (x, y))| difference(&format!("{path}.{k}"), x, y))
        }
        (Value::Object(x), Value::Object(y)) if x.keys().eq(y.keys()) => x
            .iter()
            .find_map(|(name, x)| difference(&format!("{path}.{name}"), x, &y[name])),
        _ if a == b => None,
        _ => differs(),
    }
}

#[test]
fn the_answers_that_hosts_compare_with_are_those_of_the_library() {
    let now = written();
    if std::env::var_os("FAIRMESH_WRITE").is_some() {
        std::fs::write(FILE, text(&now)).unwrap();
    }
    let stored: Value = serde_json::from_str(&std::fs::read_to_string(FILE).unwrap()).unwrap();
    let [a, b] = [&now, &stored].map(|all| all["cases"].as_array().unwrap());
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!(difference(&b["name"].to_string(), a, b), None);
    }
    assert_eq!(difference("meshes", &now["meshes"], &stored["meshes"]), None);
}

/// For each option there are two cases that differ by it alone, and in their answers: a host that forgets it fails.
#[test]
fn each_option_changes_an_answer() {
    let all = written();
    let cases: Vec<&Value> = all["cases"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|case| case.get("answer").is_some())
        .collect();
    let options = |case: &Value| case["options"].as_object().unwrap().clone();
    let differ_by = |name: &str, a: &Value, b: &Value| {
        let [mut a, mut b] = [options(a), options(b)];
        let given = [a.remove(name), b.remove(name)];
        a == b && given[0] != given[1]
    };
    let mut unseen = Vec::new();
    for call in ["fair", "fill_holes", "bridge", "remesh"] {
        let of_call: Vec<&&Value> = cases.iter().filter(|case| case["call"] == call).collect();
        let names: BTreeSet<String> = of_call
            .iter()
            .flat_map(|case| options(case))
            .map(|(name, _)| name)
            .collect();
        for name in names {
            let is_seen = |a: &Value| {
                (of_call.iter())
                    .any(|b| differ_by(&name, a, b) && difference("", &a["answer"], &b["answer"]).is_some())
            };
            if !of_call.iter().any(|a| is_seen(a)) {
                unseen.push(format!("{call}: {name}"));
            }
        }
    }
    // They are what the call is about.
    assert_eq!(unseen, ["bridge: end", "bridge: start"]);
}
