//! Figures 1, 2, 7, 8 and, with scans, 9 and 10.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};

use fairmesh::InnerFairness;

use crate::measure::{Distance, linear_surface, to_mesh};
use crate::tool::{Case, Run, Tool};
use crate::{Scan, short};

const FROM_ABOVE: [&str; 2] = ["--view", "0.45,-0.75,0.8"];

/// A mesh, its linear and its intrinsic surface.
struct Faired {
    case: Case,
    linear: Vec<[f64; 3]>,
    linear_file: PathBuf,
    run: Run,
}

fn faired(tool: &Tool, name: &str, generate: &[&str], inner: &str) -> io::Result<Faired> {
    let case = tool.generate(name, generate)?;
    let fairness = if inner == "conformal" {
        InnerFairness::Conformal
    } else {
        InnerFairness::Uniform
    };
    let linear = linear_surface(&case, fairness)?;
    let linear_file = tool.write(&case, &format!("linear-{inner}"), &linear)?;
    let run = tool.fair(&case, inner, &["--inner-fairness", inner])?;
    Ok(Faired {
        case,
        linear,
        linear_file,
        run,
    })
}

/// The section of the document.
pub fn section(tool: &Tool) -> io::Result<String> {
    let mut text = figures_1_and_2(tool)?;
    text += &figure_7(tool)?;
    text += &figure_8(tool)?;
    Ok(text)
}

fn figures_1_and_2(tool: &Tool) -> io::Result<String> {
    const MESHES: [(&str, &[&str]); 4] = [
        ("920", &["cylinder-blend", "--vertices", "920"]),
        ("118", &["cylinder-blend", "--vertices", "118"]),
        (
            "920 with the patch",
            &[
                "cylinder-blend",
                "--vertices",
                "920",
                "--triangulation",
                "refined",
            ],
        ),
        ("13,308", &["cylinder-blend", "--vertices", "13308"]),
    ];
    let mut all = Vec::new();
    for inner in ["uniform", "conformal"] {
        for (k, (label, generate)) in MESHES.iter().enumerate() {
            all.push((
                *label,
                inner,
                faired(tool, &format!("blend{k}"), generate, inner)?,
            ));
        }
    }
    let fine = &all[3].2;
    let mut text = String::from(
        "## Figures 1 and 2: linear against intrinsic fairing\n\n\
        Three cylinders, symmetrically arranged. Linear fairing (Δ²f = 0, above, Fig. 1) depends on the mesh and on its weights;\n\
        the intrinsic surface (Δ_B H = 0, below, Fig. 2) hardly does.\n\n",
    );
    let shown = [0, 1, 2, 4];
    let captions = ["uniform, 920", "uniform, 118", "uniform, patch", "conformal, 920"];
    for (picture, what, is_linear) in [
        ("figure1.png", "Linear surfaces on four meshes", true),
        ("figure2.png", "Intrinsic surfaces on the same meshes", false),
    ] {
        let file = |f: &'_ Faired| -> PathBuf {
            if is_linear {
                f.linear_file.clone()
            } else {
                f.run.file.clone()
            }
        };
        let files: Vec<PathBuf> = shown.iter().map(|&k| file(&all[k].2)).collect();
        let meshes: Vec<(&Path, &str)> = files.iter().map(PathBuf::as_path).zip(captions).collect();
        let mut arguments = FROM_ABOVE.to_vec();
        arguments.extend(["--shade", "flat,reflection", "--size", "200x175"]);
        text += &tool.render(picture, what, &meshes, &arguments)?;
        text.push('\n');
    }
    let files: Vec<PathBuf> = shown.iter().map(|&k| all[k].2.run.file.clone()).collect();
    let meshes: Vec<(&Path, &str)> = files.iter().map(PathBuf::as_path).zip(captions).collect();
    let mut arguments = FROM_ABOVE.to_vec();
    arguments.extend(["--shade", "curvature", "--size", "200x175"]);
    text += "Mean curvature of the intrinsic surfaces, from the triangles alone, which is poor on the boundary of the mesh at 118 vertices:\n\n";
    text += &tool.render("figure2-curvature.png", "Mean curvature", &meshes, &arguments)?;
    text += "\nDistances of the vertices to the surface of 13,308 vertices with uniform weights, linear to linear and intrinsic to intrinsic:\n\n\
        | mesh | weights | linear: largest | rms | intrinsic: largest | rms | linear / intrinsic | outcome | iterations |\n\
        |---|---|---|---|---|---|---|---|---|\n";
    for (label, inner, f) in &all {
        let linear = to_mesh(&f.linear, &fine.linear, &fine.case.triangles);
        let intrinsic = to_mesh(&f.run.positions, &fine.run.positions, &fine.case.triangles);
        let _ = writeln!(
            text,
            "| {label} | {inner} | {} | {} | {} | {} | {} | {} | {} |",
            short(linear.max),
            short(linear.rms),
            short(intrinsic.max),
            short(intrinsic.rms),
            ratio(linear, intrinsic),
            f.run.outcome(),
            f.run.iterations()
        );
    }
    let between = to_mesh(&fine.linear, &fine.run.positions, &fine.case.triangles);
    let _ = writeln!(
        text,
        "\nWith uniform weights at 13,308 vertices, the linear and the intrinsic surface are up to {} apart (rms {}).\n",
        short(between.max),
        short(between.rms)
    );
    Ok(text)
}

fn ratio(a: Distance, b: Distance) -> String {
    // The reference has no distance to itself.
    if b.max < 1e-12 {
        "-".to_owned()
    } else {
        format!("{:.0}", a.max / b.max)
    }
}

fn figure_7(tool: &Tool) -> io::Result<String> {
    let regular = faired(
        tool,
        "regular",
        &["cylinder-blend", "--vertices", "920"],
        "uniform",
    )?;
    let sparse = [
        "cylinder-blend",
        "--vertices",
        "300",
        "--triangulation",
        "irregular",
        "--seed",
        "3",
    ];
    let sparse = faired(tool, "sparse", &sparse, "uniform")?;
    let fine = faired(
        tool,
        "blend3",
        &["cylinder-blend", "--vertices", "13308"],
        "uniform",
    )?;
    let counts = [&regular, &sparse].map(|f| f.case.positions.len());
    let captions = [
        format!("linear, {}", counts[0]),
        format!("intrinsic, {}", counts[0]),
        format!("linear, {}", counts[1]),
        format!("intrinsic, {}", counts[1]),
    ];
    let files = [
        &regular.linear_file,
        &regular.run.file,
        &sparse.linear_file,
        &sparse.run.file,
    ];
    let meshes: Vec<(&Path, &str)> = files
        .iter()
        .map(|f| f.as_path())
        .zip(captions.iter().map(String::as_str))
        .collect();
    let mut arguments = FROM_ABOVE.to_vec();
    arguments.extend(["--shade", "flat,reflection", "--size", "200x175"]);
    let mut text = String::from(
        "## Figure 7: regular, and sparse with irregular connectivity\n\n\
        The paper has another shape and a third scheme between the two.\n\n",
    );
    text += &tool.render(
        "figure7.png",
        "Linear and intrinsic, regular and sparse",
        &meshes,
        &arguments,
    )?;
    text += "\n| mesh | vertices | linear, to the fine linear surface: largest | intrinsic, to the fine intrinsic one: largest | outcome | iterations |\n|---|---|---|---|---|---|\n";
    for (label, f) in [("regular", &regular), ("sparse, irregular", &sparse)] {
        let _ = writeln!(
            text,
            "| {label} | {} | {} | {} | {} | {} |",
            f.case.positions.len(),
            short(to_mesh(&f.linear, &fine.linear, &fine.case.triangles).max),
            short(to_mesh(&f.run.positions, &fine.run.positions, &fine.case.triangles).max),
            f.run.outcome(),
            f.run.iterations()
        );
    }
    text.push('\n');
    Ok(text)
}

fn figure_8(tool: &Tool) -> io::Result<String> {
    let mut rows = String::new();
    let mut shown: Vec<PathBuf> = Vec::new();
    for inner in ["uniform", "conformal"] {
        let [coarse, fine] = ["500", "13308"].map(|n| {
            let case = tool.generate(&format!("tetra{n}"), &["tetra-thing", "--vertices", n])?;
            let run = tool.fair(&case, inner, &["--inner-fairness", inner])?;
            io::Result::Ok((case, run))
        });
        let (coarse, fine) = (coarse?, fine?);
        let distance = to_mesh(&coarse.1.positions, &fine.1.positions, &fine.0.triangles);
        let _ = writeln!(
            rows,
            "| {inner} | {} / {} | {} / {} | {} | {} |",
            coarse.1.outcome(),
            fine.1.outcome(),
            coarse.1.iterations(),
            fine.1.iterations(),
            short(distance.max),
            short(distance.rms)
        );
        if inner == "uniform" {
            shown = vec![coarse.1.file, fine.1.file];
        }
    }
    let meshes = [(shown[0].as_path(), "500"), (shown[1].as_path(), "13308")];
    let mut text = String::from(
        "## Figure 8: the tetra thing\n\n\
        Six fixed circles on the edges of a tetrahedron, with the normals of tubes along the edges, inside a closed surface of genus 3.\n\
        Above flat-shaded, in the middle reflection lines, below mean curvature.\n\n",
    );
    let arguments = [
        "--view",
        "1,0.7,0.8",
        "--shade",
        "flat,reflection,curvature",
        "--size",
        "180x180",
    ];
    text += &tool.render(
        "figure8.png",
        "The tetra thing of 500 and 13,308 vertices",
        &meshes,
        &arguments,
    )?;
    text += "\nDistances of the 500 vertices to the surface of 13,308:\n\n\
        | weights | outcome, 500 / 13,308 | iterations | largest distance | rms |\n|---|---|---|---|---|\n";
    text += &rows;
    text.push('\n');
    Ok(text)
}

/// The section on scans.
pub fn scans(tool: &Tool, scans: &[Scan]) -> io::Result<String> {
    let mut text = String::from("## Figures 9 and 10: features of scans removed\n\n");
    if scans.is_empty() {
        text += "Not in this run: give scans with `./reproduce.sh --scan NAME MESH FREE-VERTICES VIEW`, the free vertices a list of\n\
            numbers from 0, the view as `fairmesh render --view` has it.\n\n";
        return Ok(text);
    }
    text += "The scans are not part of the project; `--scan` names them. Boundary normals are fitted. H is in one over the scan's unit.\n\n";
    let mut rows = String::from(
        "| scan | weights | free vertices | outcome | iterations | s | smallest angle | H inside | H on the boundary |\n\
        |---|---|---|---|---|---|---|---|---|\n",
    );
    for (k, scan) in scans.iter().enumerate() {
        let case = tool.scan(&format!("scan{k}"), &scan.mesh, &scan.free);
        for inner in ["uniform", "conformal"] {
            let run = tool.fair(&case, inner, &["--inner-fairness", inner])?;
            let ([low, high], [least, most]) = (run.curvature("h_inside"), run.curvature("h_boundary"));
            let _ = writeln!(
                rows,
                "| {} | {inner} | {} | {} | {} | {:.3} | {:.1} | {} to {} | {} to {} |",
                scan.name,
                run.number(&["free_vertices"]),
                run.outcome(),
                run.iterations(),
                run.seconds(),
                run.number(&["quality", "worst_angle"]),
                short(low),
                short(high),
                short(least),
                short(most)
            );
            if inner == "conformal" {
                let free = case.free_file.display().to_string();
                let meshes = [(case.file.as_path(), "before"), (run.file.as_path(), "after")];
                let arguments = [
                    "--view",
                    &scan.view,
                    "--around",
                    &free,
                    "--shade",
                    "flat,reflection",
                    "--size",
                    "220x220",
                ];
                let picture = format!("scan{}.png", k + 1);
                let _ = writeln!(text, "{}:\n", scan.name);
                text += &tool.render(&picture, &scan.name, &meshes, &arguments)?;
                text.push('\n');
            }
        }
    }
    text += &rows;
    text.push('\n');
    Ok(text)
}
