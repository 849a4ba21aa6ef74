//! The command line: help, errors, exit codes, report.

use std::fs;
use std::path::Path;

use crate::common::*;

/// A directory with `cap.obj` and the lists of its region.
fn prepared(test: &str) -> std::path::PathBuf {
    let directory = directory(test);
    write_lists(&directory);
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    directory
}

/// Expects a refusal in one line that begins like this.
fn refused(directory: &Path, args: &[&str], message: &str) {
    let (out, err) = expect(directory, args, 2);
    assert_eq!(out, "");
    assert_eq!(err.lines().count(), 1, "{err}");
    assert!(
        err.starts_with(&format!("fairmesh: {message}")),
        "{err:?} should be {message:?}"
    );
}

#[test]
fn help_tells_what_a_stranger_needs() {
    let directory = directory("help");
    let (out, _) = expect(&directory, &["fair", "--help"], 0);
    let told = [
        "Examples:",
        "--free <FILE>",
        "--selection <NAME>",
        "Exit codes: 0",
        "byte for byte",
        "'setup'",
    ];
    told.into_iter()
        .for_each(|told| assert!(out.contains(told), "{told}\n{out}"));
    let (out, _) = expect(&directory, &["--help"], 0);
    assert!(out.contains("fair") && out.contains("demo"));
    let (out, _) = expect(&directory, &["--version"], 0);
    assert_eq!(out, format!("fairmesh {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn wrong_usage_exits_with_2() {
    let directory = prepared("usage");
    for args in [
        &["fair", "cap.obj"][..],
        &[
            "fair",
            "cap.obj",
            "-o",
            "x.obj",
            "--free",
            "free.txt",
            "--faces",
            "faces.txt",
        ],
        &["fair", "cap.obj", "-o", "x.obj", "--inner-fairness", "best"],
        &["fair", "cap.obj", "-o", "x.obj", "--interior-normals", "best"],
        &["fair", "cap.obj", "-o", "x.obj", "--continuity", "g3"],
        &["fair", "cap.obj", "-o", "x.obj", "--continuity", "1.01"],
        &["fair", "cap.obj", "-o", "x.obj", "--continuity-at", "3"],
        &[
            "fair",
            "cap.obj",
            "-o",
            "x.obj",
            "--boundary-curvature",
            "free.txt",
        ],
        &["unfair"],
    ] {
        expect(&directory, args, 2);
    }
    assert!(!directory.join("x.obj").exists());
}

/// Expects that the cap is not faired with these flags, and why in one line.
fn not_faired(directory: &Path, more: &[&str], message: &str) {
    refused(
        directory,
        &[&["fair", "cap.obj", "-o", "out.obj"], more].concat(),
        message,
    );
    assert!(!directory.join("out.obj").exists());
}

/// The same with each of these texts as `bad.txt`.
fn none_is_taken(directory: &Path, more: &[&str], texts: &[(&str, &str)]) {
    for (text, message) in texts {
        fs::write(directory.join("bad.txt"), text).unwrap();
        not_faired(directory, more, message);
    }
}

#[test]
fn a_region_that_is_wrong_is_told_in_one_line() {
    let directory = prepared("input-region");
    not_faired(
        &directory,
        &[],
        "cap.obj: nothing says which vertices may move; say a place",
    );
    not_faired(
        &directory,
        &["--selection", "flags"],
        "cap.obj: there is no property 'flags'",
    );
    not_faired(&directory, &["--free", "none.txt"], "none.txt: cannot read:");
    let vertices = [
        ("# one\n1\n\n2x\n", "bad.txt:4: index: '2x' is not a whole number"),
        ("1 2\n", "bad.txt:1: '2' is more than this line should have"),
        (
            "0\n225\n",
            "bad.txt:2: index 225 is out of range: the mesh has 225 vertices, counted from 0",
        ),
    ];
    none_is_taken(&directory, &["--free", "bad.txt"], &vertices);
    let faces = [
        (
            "-1\n",
            "bad.txt:1: index -1 is out of range: the mesh has 196 faces, counted from 0",
        ),
        ("# nothing\n", "bad.txt: the file names no faces"),
    ];
    none_is_taken(&directory, &["--faces", "bad.txt"], &faces);
}

#[test]
fn normals_that_are_wrong_are_told_in_one_line() {
    let texts = [
        ("4 0 1\n", "bad.txt:1: normal has 2 of 3 numbers"),
        (
            "4 0 1 2\n5 0 0 0\n",
            "bad.txt:2: the normal of vertex 5 is zero or not finite",
        ),
        (
            "4 0 1 inf\n",
            "bad.txt:1: the normal of vertex 4 is zero or not finite",
        ),
    ];
    let flags = ["--free", "free.txt", "--normals", "bad.txt"];
    none_is_taken(&prepared("input-normals"), &flags, &texts);
}

#[test]
fn curvatures_that_are_wrong_are_told_in_one_line() {
    let texts = [
        (
            "# H\n4 0.5\n5\n",
            "bad.txt:3: the mean curvature of vertex 5 is missing",
        ),
        (
            "4 nan\n",
            "bad.txt:1: the mean curvature of vertex 4 is not finite",
        ),
        ("4 high\n", "bad.txt:1: mean curvature: 'high' is not a number"),
        ("4 0.5 1\n", "bad.txt:1: '1' is more than this line should have"),
        (
            "225 0.5\n",
            "bad.txt:1: index 225 is out of range: the mesh has 225 vertices, counted from 0",
        ),
    ];
    let flags = [
        "--free",
        "free.txt",
        "--continuity",
        "g2",
        "--boundary-curvature",
        "bad.txt",
    ];
    none_is_taken(&prepared("input-curvatures"), &flags, &texts);
}

#[test]
fn files_that_cannot_be_read_or_written_are_told_in_one_line() {
    let directory = prepared("input-files");
    not_faired(
        &directory,
        &["--free", "free.txt", "--json", "cap.obj"],
        "cap.obj: --json would overwrite the mesh",
    );
    not_faired(
        &directory,
        &["--free", "free.txt", "--json", "none/a.json"],
        "none/a.json: cannot write: no file can be made in 'none'",
    );
    let missing = ["fair", "none.ply", "-o", "out.ply"];
    refused(&directory, &missing, "none.ply: cannot read:");
    refused(
        &directory,
        &["fair", "cap.obj", "-o", "out.xyz"],
        "out.xyz: unknown file format",
    );
    let nowhere = ["fair", "cap.obj", "-o", "none/out.obj", "--free", "free.txt"];
    refused(
        &directory,
        &nowhere,
        "none/out.obj: cannot write: no file can be made in 'none': it does not exist",
    );
    let cut = "ply\nformat ascii 1.0\nelement vertex 2\n";
    fs::write(directory.join("cut.ply"), cut).unwrap();
    refused(
        &directory,
        &["fair", "cut.ply", "-o", "out.ply"],
        "cut.ply:4: the file ends within the header",
    );
    assert!(!directory.join("out.ply").exists());
}

#[test]
fn a_refusal_keeps_the_old_output() {
    let directory = prepared("keep");
    fs::write(directory.join("out.obj"), "precious").unwrap();
    fs::write(directory.join("one.txt"), "0\n").unwrap();
    refused(
        &directory,
        &["fair", "cap.obj", "-o", "out.obj", "--faces", "one.txt"],
        "cap.obj: no vertex is free",
    );
    assert_eq!(fs::read_to_string(directory.join("out.obj")).unwrap(), "precious");
    let mut names: Vec<_> = fs::read_dir(&directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    names.sort();
    assert_eq!(names, ["cap.obj", "faces.txt", "free.txt", "one.txt", "out.obj"]);
}

// From here on the solver is needed.

#[test]
fn the_report_is_told_and_written() {
    let directory = prepared("report");
    let args = [
        "fair",
        "cap.obj",
        "-o",
        "out.obj",
        "--faces",
        "faces.txt",
        "--json",
        "report.json",
    ];
    let (out, err) = expect(&directory, &args, 0);
    assert!(
        out.starts_with("converged: tolerance met, and the surface is sound\n"),
        "{out}"
    );
    assert_eq!(err, "", "no progress bar without a terminal");
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(directory.join("report.json")).unwrap()).unwrap();
    assert_eq!(json["outcome"], "converged");
    assert_eq!(
        json["free_vertices"],
        (0..SIDE * SIDE).filter(|&v| is_free(v)).count()
    );
    assert_eq!(json["quality"]["flipped"]["count"], 0);
    assert_eq!(json["quality"]["needles"]["list"], serde_json::json!([]));
    assert!(json["quality"]["worst_triangle"].as_u64().unwrap() < quads().len() as u64);
    assert!(json["quality"]["worst_angle"].as_f64().unwrap() > 1.0);
    // The unit sphere, with outward normals.
    for end in 0..2 {
        assert!((json["quality"]["h_inside"][end].as_f64().unwrap() + 1.0).abs() < 0.01);
    }
    assert_eq!(json["least_bending"], false);
    assert!(json["reason"].is_null());
    let seconds = |key: &str| json["seconds"][key].as_f64().unwrap();
    assert!(seconds("setup") <= seconds("solve"));
    let parts = seconds("read") + seconds("solve") + seconds("write");
    assert!(parts <= seconds("total") + 1e-9);
    let (out, err) = expect(&directory, &[&args[..], &["--quiet"]].concat(), 0);
    assert_eq!((out, err), (String::new(), String::new()));
}

#[test]
fn what_was_tried_is_told_on_demand() {
    let directory = prepared("attempts");
    let args = [
        "fair", "cap.obj", "-o", "out.obj", "--free", "free.txt", "--json", "out.json",
    ];
    let (brief, _) = expect(&directory, &args, 0);
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(directory.join("out.json")).unwrap()).unwrap();
    assert!(json["member_weight"].is_null());
    let attempt = &json["components"][0]["attempts"][0];
    assert_eq!(
        (&attempt["name"], &attempt["end"]),
        (&"direct".into(), &"sound".into())
    );
    assert_eq!(attempt["iterations"], json["iterations"]);
    assert_eq!(attempt["free_vertices"], json["free_vertices"]);
    assert!(!brief.contains("attempts:"));
    let (verbose, _) = expect(&directory, &[&args[..], &["--verbose"]].concat(), 0);
    let row = format!(
        "  attempts:            direct, {} free vertices: sound after ",
        attempt["free_vertices"]
    );
    assert!(verbose.contains(&row), "{verbose}");
    assert!(verbose.contains("\n  bending energy: "), "{verbose}");
    expect(&directory, &[&args[..], &["--verbose", "--quiet"]].concat(), 2);
}

#[test]
fn too_few_iterations_exit_with_3_and_write() {
    let directory = prepared("limit");
    let args = [
        "fair",
        "cap.obj",
        "-o",
        "out.obj",
        "--free",
        "free.txt",
        "--max-iterations",
        "1",
        "--json",
        "report.json",
    ];
    let (out, _) = expect(&directory, &args, 3);
    assert!(
        out.starts_with(
            "iteration limit: the iterations ran out; the best surface so far is returned\n  what to do:"
        ),
        "{out}"
    );
    let json = fs::read_to_string(directory.join("report.json")).unwrap();
    assert!(json.contains("\"outcome\": \"iteration_limit\""));
    assert_ne!(
        fs::read(directory.join("out.obj")).unwrap(),
        fs::read(directory.join("cap.obj")).unwrap()
    );
}

#[test]
fn the_papers_scheme_takes_its_flags_and_tells_its_levels() {
    let directory = prepared("paper");
    let file = ["fair", "cap.obj", "-o", "out.obj", "--free", "free.txt"];
    let solver = ["--solver", "paper"];
    let fair = |more: &[&str], code: i32| expect(&directory, &[&file[..], more].concat(), code);
    let flags = [
        ["--paper-levels", "1"],
        ["--paper-damping", "0.8"],
        ["--paper-estimate", "conjugate-gradients"],
        ["--paper-estimate-iterations", "20"],
        ["--paper-defect", "1e-5"],
    ];
    let json = ["--json", "report.json"];
    let (out, _) = fair(&[&solver, flags.as_flattened(), &json].concat(), 0);
    assert!(out.contains("levels:"), "{out}");
    let json = fs::read_to_string(directory.join("report.json")).unwrap();
    assert!(json.contains("\"updates\""), "{json}");
    for flag in flags {
        let (_, err) = fair(&flag, 2);
        assert!(err.contains("is for --solver paper only"), "{err}");
    }
    let (_, err) = fair(&[&solver[..], &["--max-iterations", "1"]].concat(), 2);
    assert!(err.contains("--paper-max-updates"), "{err}");
    let (_, err) = fair(&[&solver[..], &["--paper-damping", "2"]].concat(), 2);
    assert!(err.contains("damping"), "{err}");
    let (out, _) = fair(&[&solver[..], &["--paper-max-updates", "1"]].concat(), 3);
    assert!(out.starts_with("iteration limit:"), "{out}");
}

#[test]
fn the_defaults_have_words() {
    let directory = prepared("words_of_defaults");
    let fair = |more: &[&str]| {
        let args = ["fair", "cap.obj", "-o", "out.obj", "--free", "free.txt"];
        expect(&directory, &[&args[..], more].concat(), 0);
        fs::read(directory.join("out.obj")).unwrap()
    };
    let plain = fair(&[]);
    for more in [
        ["--normals", "fitted"],
        ["--continuity", "auto"],
        ["--target", "harmonic"],
        ["--inner-fairness", "uniform"],
        ["--interior-normals", "smooth"],
        ["--discretization", "second-order"],
        ["--intersections", "check"],
        ["--solver", "fast"],
    ] {
        assert_eq!(fair(&more), plain, "{more:?}");
    }
    assert_eq!(fair(&["--continuity", "g2"]), fair(&["--continuity", "1"]));
}

#[test]
fn continuity_is_told() {
    let directory = prepared("continuity");
    let args = ["fair", "cap.obj", "-o", "out.obj", "--free", "free.txt"];
    let (out, _) = expect(&directory, &[&args[..], &["--continuity", "g1"]].concat(), 0);
    assert!(!out.contains("continuity"), "{out}");
    let (out, _) = expect(&directory, &args, 0);
    let told = out
        .lines()
        .find(|line| line.contains(" more: g1, as H jumps by "));
    assert!(told.is_some_and(|line| line.ends_with(" only")), "{out}");
    let (out, _) = expect(&directory, &[&args[..], &["--continuity", "g2"]].concat(), 0);
    assert!(
        out.contains("  continuity:          loop of vertex ") && out.contains(" reached, jump of H "),
        "{out}"
    );
}

#[test]
fn the_demo_makes_its_three_files() {
    let directory = directory("demo");
    let (out, _) = expect(&directory, &["demo", "deep/demo"], 0);
    for name in ["start.ply", "result.ply", "blend.png"] {
        assert!(out.contains(name), "{out}");
    }
    let png = fs::read(directory.join("deep/demo/blend.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let start = fs::read(directory.join("deep/demo/start.ply")).unwrap();
    assert!(String::from_utf8_lossy(&start).contains("element vertex 920\n"));
    assert!(String::from_utf8_lossy(&start).contains("element face 1746\n"));
    // The command that it names makes its result.
    fs::remove_file(directory.join("deep/demo/result.ply")).unwrap();
    let again = out
        .lines()
        .find_map(|line| line.strip_prefix("  fairmesh "))
        .unwrap();
    let args: Vec<&str> = again.split(' ').collect();
    let (out, _) = expect(&directory, &args, 0);
    assert!(out.starts_with("converged:"), "{out}");
    let result = fs::read(directory.join("deep/demo/result.ply")).unwrap();
    assert_eq!(result.len(), start.len());
}

/// Also where the directory has a name that a shell would take apart.
#[test]
#[cfg(unix)]
fn the_demo_names_a_command_that_a_shell_understands() {
    let directory = directory("demo-quoted");
    let (out, _) = expect(&directory, &["demo", "it's a demo"], 0);
    let result = directory.join("it's a demo/result.ply");
    let made = fs::read(&result).unwrap();
    fs::remove_file(&result).unwrap();
    let again = out
        .lines()
        .find_map(|line| line.strip_prefix("  fairmesh "))
        .unwrap();
    let line = format!("'{}' {again}", env!("CARGO_BIN_EXE_fairmesh"));
    let ran = std::process::Command::new("sh")
        .args(["-c", &line])
        .current_dir(&directory)
        .output()
        .unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    assert_eq!(fs::read(&result).unwrap().len(), made.len());
}

#[test]
fn loops_that_do_not_exist_are_named_with_what_lists_them() {
    let directory = prepared("flags");
    let fill = ["fill", "cap.obj", "-o", "x.obj", "--loop", "5"];
    refused(
        &directory,
        &fill,
        "--loop 5: cap.obj has 1 boundary loops, counted from 0; 'fairmesh holes' lists them",
    );
}

#[test]
fn what_is_generated_is_faired_and_shown() {
    let directory = directory("generate");
    let list = ["--free", "free.txt", "--normals", "normals.txt"];
    let make = |output: &str, start: &str, code: i32| {
        let mut args = vec!["generate", "sphere-cap", "-o", output, "--vertices", "300"];
        args.extend(["--triangulation", "irregular", "--seed", "5", "--start", start]);
        args.extend(list);
        expect(&directory, &args, code)
    };
    let (out, _) = make("cap.off", "noise", 0);
    assert!(out.contains("the unit sphere about the origin"), "{out}");
    let first = fs::read(directory.join("cap.off")).unwrap();
    make("cap.off", "noise", 0);
    assert_eq!(first, fs::read(directory.join("cap.off")).unwrap());
    let mut args = vec!["fair", "cap.off", "-o", "fair.off"];
    args.extend(list);
    expect(&directory, &args, 0);
    let text = fs::read_to_string(directory.join("fair.off")).unwrap();
    let mut lines = text.lines().skip(1);
    let count: usize = lines
        .next()
        .unwrap()
        .split_whitespace()
        .next()
        .unwrap()
        .parse()
        .unwrap();
    let positions: Vec<[f64; 3]> = lines
        .take(count)
        .map(|line| {
            let words: Vec<f64> = line.split_whitespace().map(|w| w.parse().unwrap()).collect();
            [words[0], words[1], words[2]]
        })
        .collect();
    assert_eq!(positions.len(), count);
    assert!(off_sphere(&positions) < 1e-7);

    let mut args = vec![
        "render", "cap.off", "fair.off", "-o", "both.png", "--view", "-1,0,1",
    ];
    args.extend(["--shade", "flat,reflection,curvature", "--size", "60x50"]);
    expect(&directory, &args, 0);
    let [width, height] = size_of_png(&directory.join("both.png"));
    assert!(width > 2 * 60 && height > 3 * 50, "{width} x {height}");
    args.extend([
        "--caption",
        "",
        "--caption",
        "",
        "--range",
        "-1.1,-0.9",
        "--around",
        "free.txt",
    ]);
    expect(&directory, &args, 0);
    assert_eq!(size_of_png(&directory.join("both.png"))[1], 3 * 50);
}

/// Expects a refusal that says this.
fn refused_for(directory: &Path, args: &[&str], what: &str) {
    let (_, err) = expect(directory, args, 2);
    assert!(err.contains(what), "{args:?}: {err}");
}

#[test]
fn what_cannot_be_generated_is_refused() {
    let directory = directory("generate-refused");
    let generate = |kind: &str, more: &[&str], what: &str| {
        let args = [&["generate", kind, "-o", "a.ply"], more].concat();
        refused_for(&directory, &args, what);
    };
    generate("saddle", &["--exact", "b.ply"], "no exact surface");
    generate(
        "tetra-thing",
        &["--raise", "0,0,1,1,1"],
        "--raise: there are no exact normals",
    );
    generate("cylinder", &["--raise", "0,0,1,1"], "expected 5 numbers");
    generate("cylinder", &["--cut", "0,0,0,-1"], "the radius -1 is not above 0");
    generate("cylinder", &["--cut", "0,0,0,9"], "--cut: nothing is left");
    generate("cylinder", &["--angle", "3"], "--angle");
    generate(
        "sphere-cap",
        &["--angle", "160"],
        "--angle 160: give 1 to 150 degrees",
    );
    generate(
        "sphere-hole",
        &["--angle", "171"],
        "--angle 171: give 1 to 170 degrees",
    );
    generate("cylinder", &["--free", "a.ply"], "two different files");
    generate("cylinder", &["--noise=-1"], "--noise");
    generate("cone", &[], "cone");
    generate("cylinder", &["--c", "-1"], "only revolution");
    generate("cylinder", &["--phi0", "1"], "only revolution");
    generate("torus", &["--angle", "150"], "--angle 150: give 6 to 143 degrees");
    generate("torus", &["--semi-axes", "1,1,1"], "only ellipsoid");
    generate(
        "ellipsoid",
        &["--semi-axes", "1,0,1"],
        "three numbers from 0.1 to 10",
    );
    generate("revolution", &["--f0", "nan"], "--f0 NaN");
    generate("revolution", &["--length", "9"], "crosses itself");
    generate("revolution", &["--f0", "1.6", "--c", "0"], "nearer to the axis");
    assert_eq!(fs::read_dir(&directory).unwrap().count(), 0);
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let directory = directory("render-refused");
    expect(
        &directory,
        &["generate", "cylinder-blend", "--vertices", "118", "-o", "a.obj"],
        0,
    );
    let render = |more: &[&'static str], what: &str| {
        let mut args = vec!["render", "a.obj", "-o", "a.png"];
        args.extend(more);
        refused_for(&directory, &args, what);
    };
    render(&["--view", "1,2"], "--view 1,2");
    render(&["--size", "10x10"], "--size 10x10");
    render(&["--range", "2,1"], "--range 2,1");
    render(&["--caption", "a", "--caption", "b"], "--caption");
    render(&["--up", "0,0,0"], "--up");
    refused_for(&directory, &["render", "none.ply", "-o", "a.png"], "none.ply");
    assert!(!directory.join("a.png").exists());
}

#[test]
fn coordinates_are_shown_where_they_are_asked_for() {
    let directory = prepared("axes");
    let plain = ["render", "cap.obj", "-o", "plain.png", "--size", "200x200"];
    expect(&directory, &plain, 0);
    let axes = [
        "render", "cap.obj", "-o", "axes.png", "--size", "200x200", "--axes",
    ];
    expect(&directory, &axes, 0);
    let [plain, axes] = ["plain.png", "axes.png"].map(|name| fs::read(directory.join(name)).unwrap());
    assert_ne!(plain, axes);
    let turning = ["render", "cap.obj", "-o", "t.gif", "--axes", "--turntable", "4"];
    expect(&directory, &turning, 2);
}
