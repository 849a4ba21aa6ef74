//! The guides in docs/guides: their commands run as they stand, print what is shown, and do what the page says.
//!
//! Those that need other programs than this one are in `long`, and run as a step of `./test.sh long`.
#![allow(unreachable_pub, reason = "nothing of a test is reachable from outside")]

#[path = "../common/document.rs"]
#[allow(dead_code, reason = "the other documents use the rest")]
mod document;
mod long;
mod mesh;
mod runner;

use std::path::Path;

use mesh::{Mesh, off_cylinder, off_sphere};

/// Every guide, with the test that runs it.
const GUIDES: [(&str, fn()); 13] = [
    ("a-folder-of-scans", a_folder_of_scans),
    ("blender-headless", long::blender_headless),
    ("c-program", long::c_program),
    ("close-small-holes", close_small_holes),
    ("compare-in-a-picture", compare_in_a_picture),
    ("erase-and-fill", erase_and_fill),
    ("join-tubes", join_tubes),
    ("meshlab-script", long::meshlab_script),
    ("python-textured-obj", long::python_textured_obj),
    ("remove-a-bump", remove_a_bump),
    ("round-edges", round_edges),
    ("sharp-edges", sharp_edges),
    ("what-to-take-when", what_to_take_when),
];

#[test]
fn every_guide_has_its_test_and_its_place_in_the_list() {
    let names: Vec<&str> = GUIDES.iter().map(|(name, _)| *name).collect();
    assert_eq!(runner::guides(), names);
    let list = std::fs::read_to_string(runner::root().join("docs/guides/README.md")).unwrap();
    for name in names {
        assert!(list.contains(&format!("({name}.md)")), "{name}");
    }
}

/// A picture that is not empty; it stands in the guide of this name, or in none.
fn assert_picture(path: &Path, guide: Option<&str>) {
    let bytes = std::fs::read(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    assert!(
        bytes.starts_with(b"\x89PNG") && bytes.len() > 5_000,
        "{}",
        path.display()
    );
    let Some(guide) = guide else {
        return;
    };
    let shown = runner::root().join(format!("docs/guides/{guide}.png"));
    if std::env::var_os("FAIRMESH_WRITE_DOCS").is_some() {
        std::fs::write(&shown, bytes).unwrap();
    }
    assert!(shown.exists(), "{}", shown.display());
}

#[test]
fn remove_a_bump() {
    let folder = runner::run("remove-a-bump");
    let read = |name: &str| Mesh::read(&folder.join(name));
    assert!(read("part.stl").largest(off_sphere) > 0.04);
    let smooth = read("smooth.stl");
    assert!(smooth.largest(off_sphere) < 1e-5);
    assert_eq!(smooth.triangles.len(), read("plain.stl").triangles.len());
    assert_picture(&folder.join("bump.png"), Some("remove-a-bump"));
}

/// The hill is forgotten with the noise.
#[test]
fn what_to_take_when() {
    let folder = runner::run("what-to-take-when");
    let top = |name: &str| Mesh::read(&folder.join(name)).largest(|p| p[2]);
    assert!(top("clean.ply") > 0.64 && top("faired.ply") < 0.63);
    assert_picture(&folder.join("cheek.png"), Some("what-to-take-when"));
}

#[test]
fn close_small_holes() {
    let folder = runner::run("close-small-holes");
    let [scan, closed] = ["scan.ply", "closed.ply"].map(|name| Mesh::read(&folder.join(name)));
    let [mut before, mut after] = [scan.holes(), closed.holes()];
    before.sort_unstable();
    after.sort_unstable();
    assert_eq!(after, before[2..]);
    assert!(closed.largest(off_sphere) < 1e-3);
}

#[test]
fn erase_and_fill() {
    let folder = runner::run("erase-and-fill");
    let read = |name: &str| Mesh::read(&folder.join(name));
    assert!(read("spoiled.ply").largest(off_sphere) > 0.02);
    let mended = read("mended.ply");
    assert!(mended.largest(off_sphere) < 1e-4);
    assert_eq!(mended.holes().len(), 1, "only the outer edge of the cap is open");
    assert_picture(&folder.join("ball.png"), None);
}

#[test]
fn sharp_edges() {
    let folder = runner::run("sharp-edges");
    let read = |name: &str| Mesh::read(&folder.join(name));
    let rod = read("rod.ply");
    let half = rod.largest(|p| p[2].abs());
    let off_rod = |p: [f64; 3]| (p[0].hypot(p[1]) - 1.0).abs().min((p[2].abs() - half).abs());
    assert!(rod.largest(off_rod) < 1e-6);
    for name in ["mended.ply", "faired.ply"] {
        assert!(read(name).largest(off_rod) < 1e-4, "{name}");
        assert!(read(name).holes().is_empty());
    }
    assert!(read("lump.ply").largest(off_rod) > 0.02);
    assert_picture(&folder.join("mended.png"), None);
}

#[test]
fn round_edges() {
    let folder = runner::run("round-edges");
    let read = |name: &str| Mesh::read(&folder.join(name));
    for name in ["rounded.obj", "folds.obj", "one.obj", "smooth.obj", "pin.ply"] {
        assert!(read(name).holes().is_empty(), "{name}");
    }
    // The edge where x and y are 0 is a cylinder now, from face to face; others are where they were.
    let from_axis = |p: [f64; 3]| {
        let is_near = p[0] < 0.2 && p[1] < 0.2 && (0.01..0.99).contains(&p[2]);
        if is_near {
            ((p[0] - 0.2).hypot(p[1] - 0.2) - 0.2).abs()
        } else {
            0.0
        }
    };
    assert!(read("one.obj").largest(from_axis) < 1e-3);
    // The ends of the rod stay where they were.
    let height = |name: &str| read(name).largest(|p| p[2].abs());
    assert!((height("pin.ply") - height("rod.ply")).abs() < 1e-9);
    assert_picture(&folder.join("bracket.png"), None);
}

#[test]
fn join_tubes() {
    let folder = runner::run("join-tubes");
    let [tubes, joined] = ["tubes.ply", "joined.ply"].map(|name| Mesh::read(&folder.join(name)));
    assert_eq!([tubes.holes().len(), joined.holes().len()], [4, 2]);
    assert!(joined.largest(off_cylinder) < 1e-3);
    assert_picture(&folder.join("blend/blend.png"), None);
}

#[test]
#[ignore = "full tier: large pictures"]
fn compare_in_a_picture() {
    let folder = runner::run("compare-in-a-picture");
    assert_picture(&folder.join("compare.png"), None);
    assert_picture(&folder.join("both.png"), Some("compare-in-a-picture"));
    let [before, after] = ["before.ply", "after.ply"].map(|name| Mesh::read(&folder.join(name)));
    assert!(before.largest(off_sphere) > 0.05 && after.largest(off_sphere) < 1e-5);
}

#[test]
fn a_folder_of_scans() {
    let folder = runner::run("a-folder-of-scans");
    for name in ["ball1.ply", "ball2.ply", "ball3.ply"] {
        let filled = Mesh::read(&folder.join("filled").join(name));
        assert!(filled.holes().is_empty(), "{name}");
        assert!(filled.largest(off_sphere) < 1e-3, "{name}");
    }
    assert!(!folder.join("filled/notes.ply").exists());
}
