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
const STRICT: &str = "-std=c++17 -Wall -Wextra -pedantic -Werror -Wno-maybe-uninitialized -O1 -g";
const SANITIZED: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.join("../..").canonicalize().unwrap()
}

fn work(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("openmesh").join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    path
}

/// Where `make install` has put fairmesh.
fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let prefix = work("prefix");
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

/// Compiles a file of `tests/cpp`.
fn compiler(source: &str) -> Command {
    let mut command = Command::new("c++");
    command.args(STRICT.split(' ')).args(pkg_config("--cflags"));
    command.arg(root().join("bindings/openmesh-sys/tests/cpp").join(source));
    command
}

fn pkg_config(what: &str) -> Vec<String> {
    let said = run(Command::new("pkg-config")
        .args([what, "fairmesh", "openmesh"])
        .env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig")));
    said.split_whitespace().map(str::to_owned).collect()
}

/// Compiles and links tests of the adapter under the sanitizers, and runs them.
fn adapter(name: &str) {
    let (program, library) = (work(name), prefix().join("lib"));
    run(compiler(&format!("{name}.cpp"))
        .args(SANITIZED)
        .args(pkg_config("--libs"))
        .arg(format!("-Wl,-rpath,{}", library.display()))
        .arg("-o")
        .arg(&program));
    let said = run(Command::new(&program).env("ASAN_OPTIONS", "detect_leaks=1"));
    assert!(said.contains(&format!("{name}: passed")), "{said}");
}

#[test]
fn everything_is_kept_and_honoured() {
    adapter("adapter");
}

#[test]
fn holes_are_filled_and_loops_joined() {
    adapter("filling");
}

#[test]
fn bridges_are_made_and_boundaries_trimmed() {
    adapter("bridging");
}

#[test]
fn other_meshes_are_refused_with_a_clear_message() {
    let compile = |define: &str| {
        let output = compiler("refused.cpp")
            .args(["-fsyntax-only", define])
            .output()
            .unwrap();
        (
            output.status.success(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    };
    assert!(compile("-DNOTHING").0);
    for (which, message) in [
        ("-DPOLY", "fairmesh::fair needs a triangle mesh of OpenMesh"),
        ("-DINTEGERS", "fairmesh::fair needs points of floats or doubles"),
        ("-DCONSTANT", "the OpenMesh mesh must not be const"),
    ] {
        let (compiles, said) = compile(which);
        assert!(!compiles && said.contains(message), "{which}: {said}");
    }
}

/// The vertices of an OFF file, which OpenMesh writes as floats, are on the unit sphere.
fn is_on_sphere(file: &Path, bar: f64) -> bool {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text.lines().skip(1);
    let count = lines.next().unwrap().split(' ').next().unwrap().parse().unwrap();
    let off = |line: &str| {
        let numbers = line.split_whitespace().map(|word| word.parse::<f64>().unwrap());
        (numbers.map(|x| x * x).sum::<f64>().sqrt() - 1.0).abs()
    };
    count > 400 && lines.take(count).all(|line| off(line) < bar)
}

/// The program that docs/openmesh.md begins with is compiled by its own command and run; the other pieces of code are compiled with what stands
/// before its `main`.
#[test]
fn the_guide_compiles_and_its_program_runs() {
    let guide = fs::read_to_string(root().join("docs/openmesh.md")).unwrap();
    let blocks = |language: &str| -> Vec<String> {
        let fence = format!("```{language}\n");
        let begins = guide.split(&fence).skip(1);
        begins
            .map(|rest| rest.split("\n```").next().unwrap().to_owned())
            .collect()
    };
    let (code, shell) = (blocks("cpp"), blocks("sh"));
    let at = work("guide");
    fs::create_dir_all(at.join("docs")).unwrap();
    fs::copy(root().join("docs/dented.ply"), at.join("docs/dented.ply")).unwrap();
    fs::write(at.join("smooth.cpp"), &code[0]).unwrap();
    let is_run = |line: &&str| {
        ["export", "c++", "./smooth"]
            .iter()
            .any(|word| line.starts_with(word))
    };
    let lines: Vec<&str> = shell[0].lines().filter(is_run).collect();
    let script = lines
        .join(" && ")
        .replace("$HOME/.local", &prefix().display().to_string());
    let said = run(Command::new("bash").current_dir(&at).args(["-c", &script]));
    assert!(said.contains("converged after"), "{said}");
    assert!(is_on_sphere(&at.join("whole.off"), 1e-6));

    let (head, _) = code[0].split_once("int main").unwrap();
    let mut pieces =
        String::from("#include <fairmesh_openmesh_bridge.hpp>\n#include <fairmesh_openmesh_rim.hpp>\n");
    pieces += head;
    assert!(code.len() > 4);
    for (k, piece) in code.iter().enumerate().skip(1) {
        pieces += &format!("void piece_{k}(Mesh &mesh) {{\n{piece}\n}}\n");
    }
    fs::write(at.join("pieces.cpp"), pieces).unwrap();
    let options = "-std=c++17 -Wall -Wno-unused -Wno-maybe-uninitialized -Werror -fsyntax-only pieces.cpp";
    run(Command::new("c++")
        .current_dir(&at)
        .args(options.split(' '))
        .args(pkg_config("--cflags")));
}

/// The piece of a sphere with a dent becomes a sphere, selected both ways.
#[test]
fn the_example_is_built_by_cmake_and_runs() {
    let build = work("cmake-example");
    let _ = fs::remove_dir_all(&build);
    run(Command::new("cmake")
        .args(["-DCMAKE_BUILD_TYPE=Release", "-S"])
        .arg(root().join("examples/openmesh"))
        .arg("-B")
        .arg(&build)
        .arg(format!("-DCMAKE_PREFIX_PATH={}", prefix().display())));
    run(Command::new("cmake").arg("--build").arg(&build));
    let out = work("example.off");
    let example = |words: &str| {
        let mut command = Command::new(build.join("fair_region"));
        command
            .arg(root().join("docs/dented.ply"))
            .arg(&out)
            .args(words.split(' '));
        command
    };
    for words in ["property free", "sphere 0 0 0.8 0.37"] {
        let said = run(&mut example(words));
        assert!(
            said.contains("converged") && is_on_sphere(&out, 3e-7),
            "{words}: {said}"
        );
    }
    // A property that does not exist.
    let wrong = example("property nothing").output().unwrap();
    assert_eq!(wrong.status.code(), Some(1));
}
