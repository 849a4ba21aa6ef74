//! `include/fairmesh_openmesh.hpp` and its sisters as C++ programs see it: against the installed package, with GCC's sanitizers, and the
//! example by CMake. Needs a C++ compiler, make, pkg-config and CMake.

#[path = "../../../tests/common/command.rs"]
mod command;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use command::run;

/// GCC worries about vectors of OpenMesh that have no value yet.
const STRICT: [&str; 7] = [
    "-Wall",
    "-Wextra",
    "-pedantic",
    "-Werror",
    "-Wno-maybe-uninitialized",
    "-O1",
    "-g",
];

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn root() -> PathBuf {
    here().join("../..").canonicalize().unwrap()
}

fn work() -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("openmesh");
    fs::create_dir_all(&path).unwrap();
    path
}

/// Where `make install` has put fairmesh.
fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let prefix = work().join("prefix");
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
        let _ = fs::remove_dir_all(&prefix);
        run(Command::new("make")
            .current_dir(root())
            .arg("install")
            .arg(format!("PREFIX={}", prefix.display()))
            .arg(format!("CARGO={}", env!("CARGO")))
            .arg(format!("OUT={}", target.join("release").display()))
            .env("CARGO_TARGET_DIR", target));
        prefix
    })
}

fn pkg_config(what: &str) -> Vec<String> {
    let said = run(Command::new("pkg-config")
        .args([what, "fairmesh", "openmesh"])
        .env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig")));
    said.split_whitespace().map(str::to_owned).collect()
}

fn compiler(source: &str) -> Command {
    let mut command = Command::new("c++");
    command
        .arg("-std=c++17")
        .args(STRICT)
        .args(pkg_config("--cflags"));
    command.arg(here().join("tests/cpp").join(source));
    command
}

/// Compiles and links tests of the adapter with these options more, and runs them.
fn adapter(source: &str, kind: &str, options: &[&str]) {
    let program = work().join(format!("{source}{kind}"));
    let library = prefix().join("lib");
    let mut command = compiler(&format!("{source}.cpp"));
    command.args(options).args(pkg_config("--libs"));
    command.arg(format!("-Wl,-rpath,{}", library.display()));
    run(command.arg("-o").arg(&program));
    let said = run(Command::new(&program).env("ASAN_OPTIONS", "detect_leaks=1"));
    assert!(said.contains(&format!("{source}: passed")), "{said}");
}

#[test]
fn everything_is_kept_and_honoured() {
    adapter("adapter", "", &[]);
}

#[test]
fn holes_are_filled_and_loops_joined() {
    adapter("filling", "", &[]);
}

#[test]
fn bridges_are_made_and_boundaries_trimmed() {
    adapter("bridging", "", &[]);
}

/// The program that docs/openmesh.md begins with is compiled by its own command and run; the other pieces of code are compiled with what stands
/// before its `main`.
#[test]
fn the_guide_compiles_and_its_program_runs() {
    let guide = fs::read_to_string(root().join("docs/openmesh.md")).unwrap();
    let blocks = |language: &str| -> Vec<String> {
        let fence = format!("```{language}\n");
        guide
            .split(&fence)
            .skip(1)
            .map(|rest| rest.split("\n```").next().unwrap().to_owned())
            .collect()
    };
    let (code, shell) = (blocks("cpp"), blocks("sh"));
    let program = &code[0];
    let lines = |word: &str| -> String {
        let lines = shell[0].lines().filter(|line| line.starts_with(word));
        lines.map(|line| line.to_owned() + "\n").collect()
    };
    let at = work().join("guide");
    fs::create_dir_all(at.join("docs")).unwrap();
    fs::copy(root().join("docs/dented.ply"), at.join("docs/dented.ply")).unwrap();
    fs::write(at.join("smooth.cpp"), program).unwrap();
    let home = "$HOME/.local";
    let exports = lines("export").replace(home, &prefix().display().to_string());
    let script = format!("set -e\n{exports}{}{}", lines("c++"), lines("./smooth"));
    let said = run(Command::new("bash").current_dir(&at).args(["-c", &script]));
    assert!(said.contains("converged after"), "{said}");
    // OpenMesh writes six digits.
    let off = |p: &[f64; 3]| (p.iter().map(|x| x * x).sum::<f64>().sqrt() - 1.0).abs();
    let written = vertices(&at.join("whole.off"));
    assert!(written.len() > 400 && written.iter().all(|p| off(p) < 1e-6));

    let (head, _) = program.split_once("int main").unwrap();
    let mut pieces = head.replace(
        "#include <fairmesh_openmesh_fill.hpp>",
        "#include <fairmesh_openmesh_bridge.hpp>\n#include <fairmesh_openmesh_rim.hpp>",
    );
    assert!(code.len() > 4);
    for (k, piece) in code.iter().enumerate().skip(1) {
        pieces += &format!("void piece_{k}(Mesh &mesh) {{\n{piece}\n}}\n");
    }
    let file = at.join("pieces.cpp");
    fs::write(&file, pieces).unwrap();
    run(Command::new("c++")
        .args([
            "-std=c++17",
            "-Wall",
            "-Wno-unused-variable",
            "-Wno-maybe-uninitialized",
            "-Werror",
            "-c",
            "-o",
        ])
        .arg(at.join("pieces.o"))
        .arg(file)
        .args(pkg_config("--cflags")));
}

#[test]
fn the_sanitizers_have_nothing_to_say() {
    for source in ["adapter", "filling", "bridging"] {
        let options = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
        adapter(source, "-sanitized", &options);
    }
}

#[test]
fn other_meshes_are_refused_with_a_clear_message() {
    let compile = |more: &[&str]| {
        compiler("refused.cpp")
            .arg("-fsyntax-only")
            .args(more)
            .output()
            .unwrap()
    };
    assert!(compile(&[]).status.success());
    for (which, message) in [
        ("-DPOLY", "fairmesh::fair needs a triangle mesh of OpenMesh"),
        ("-DINTEGERS", "fairmesh::fair needs points of floats or doubles"),
        ("-DCONSTANT", "the OpenMesh mesh must not be const"),
    ] {
        let output = compile(&[which]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            !output.status.success() && said.contains(message),
            "{which}: {said}"
        );
    }
}

/// Vertices of an OFF or PLY file, in text.
fn vertices(file: &Path) -> Vec<[f64; 3]> {
    let text = fs::read_to_string(file).unwrap();
    let (skip, count) = if text.starts_with("ply") {
        let count = text
            .lines()
            .find_map(|l| l.strip_prefix("element vertex "))
            .unwrap();
        (
            1 + text.lines().position(|l| l == "end_header").unwrap(),
            count.trim().parse().unwrap(),
        )
    } else {
        let counts = text.lines().nth(1).unwrap();
        (2, counts.split_whitespace().next().unwrap().parse().unwrap())
    };
    let numbers = |line: &str| -> [f64; 3] {
        let mut words = line.split_whitespace();
        std::array::from_fn(|_| words.next().unwrap().parse().unwrap())
    };
    text.lines().skip(skip).take(count).map(numbers).collect()
}

/// The piece of a sphere with a dent becomes a sphere, selected both ways.
#[test]
fn the_example_is_built_by_cmake_and_runs() {
    let build = work().join("cmake-example");
    let _ = fs::remove_dir_all(&build);
    run(Command::new("cmake")
        .arg("-S")
        .arg(root().join("examples/openmesh"))
        .arg("-B")
        .arg(&build)
        .arg("-DCMAKE_BUILD_TYPE=Release")
        .arg(format!("-DCMAKE_PREFIX_PATH={}", prefix().display())));
    run(Command::new("cmake").arg("--build").arg(&build));
    let dented = root().join("docs/dented.ply");
    let before = vertices(&dented);
    for (out, words) in [
        ("by-property.off", &["property", "free"][..]),
        ("by-sphere.off", &["sphere", "0", "0", "0.8", "0.37"]),
    ] {
        let out = work().join(out);
        let said = run(Command::new(build.join("fair_region"))
            .arg(&dented)
            .arg(&out)
            .args(words));
        assert!(said.contains("converged"), "{said}");
        let after = vertices(&out);
        assert_eq!(after.len(), before.len());
        // OpenMesh writes floats.
        let far = |(a, b): &(&[f64; 3], &[f64; 3])| (0..3).any(|k| (a[k] - b[k]).abs() > 1e-3);
        let moved = after.iter().zip(&before).filter(far).count();
        assert!(moved >= 100, "{moved}");
        for p in &after {
            let r = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((r - 1.0).abs() < 3e-7, "{p:?}");
        }
    }
    // A property that does not exist.
    let mut wrong = Command::new(build.join("fair_region"));
    wrong
        .arg(&dented)
        .arg(work().join("none.off"))
        .args(["property", "nothing"]);
    assert_eq!(wrong.output().unwrap().status.code(), Some(1));
}
