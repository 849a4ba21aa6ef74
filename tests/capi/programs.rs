//! The C interface as C and C++ programs see it: installed by `make install`, found through pkg-config and CMake, linked
//! shared and static. Needs a C and C++ compiler, make, binutils, CMake, valgrind and abidiff.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::command::run;
use crate::interface::interface;

pub(crate) const STRICT: [&str; 8] = [
    "-Wall",
    "-Wextra",
    "-Wshadow",
    "-Wsign-conversion",
    "-pedantic",
    "-Werror",
    "-O1",
    "-g",
];

pub(crate) fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

pub(crate) fn work() -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("capi");
    fs::create_dir_all(&path).unwrap();
    path
}

/// A tool that is not there is an error, and says where it comes from.
pub(crate) fn needs(tool: &str, package: &str) {
    let found = Command::new(tool).arg("--version").output();
    let works = found.is_ok_and(|o| o.status.success());
    assert!(
        works,
        "{tool} is missing: apt-get install {package}, or run ./test.sh, which does"
    );
}

/// The target directory that this test was built in: the libraries are built beside it.
fn target() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .parent()
        .unwrap()
        .to_owned()
}

/// Where `make install` has put everything.
pub(crate) fn prefix() -> &'static Path {
    static PREFIX: OnceLock<PathBuf> = OnceLock::new();
    PREFIX.get_or_init(|| {
        let prefix = work().join("prefix");
        let _ = fs::remove_dir_all(&prefix);
        let _lock = hooks();
        run(Command::new("make")
            .current_dir(root())
            .arg("install")
            .arg(format!("PREFIX={}", prefix.display()))
            .arg(format!("CARGO={}", env!("CARGO")))
            .arg(format!("OUT={}", target().join("release").display()))
            .env("CARGO_TARGET_DIR", target()));
        // With debug information, for abidiff.
        fs::copy(
            target().join("release/libfairmesh.so"),
            work().join("libfairmesh.so"),
        )
        .unwrap();
        prefix
    })
}

/// The libraries in which tests can let things go wrong.
fn hooks() -> &'static Path {
    static HOOKS: OnceLock<PathBuf> = OnceLock::new();
    HOOKS.get_or_init(|| {
        run(Command::new(env!("CARGO"))
            .current_dir(root())
            .args([
                "build",
                "--release",
                "--locked",
                "-p",
                "fairmesh-capi",
                "--features",
                "hooks",
            ])
            .env("CARGO_TARGET_DIR", target()));
        let path = work().join("libfairmesh-hooks.a");
        fs::copy(target().join("release/libfairmesh.a"), &path).unwrap();
        path
    })
}

pub(crate) fn pkg_config(arguments: &[&str]) -> Vec<String> {
    let said = run(Command::new("pkg-config")
        .args(arguments)
        .arg("fairmesh")
        .env("PKG_CONFIG_PATH", prefix().join("lib/pkgconfig")));
    said.split_whitespace().map(str::to_owned).collect()
}

#[derive(Clone, Copy, PartialEq)]
enum Linked {
    Shared,
    Static,
}

/// Compiles and links a test program against the installed library.
fn compile(compiler: &str, standard: &str, source: &str, linked: Linked) -> PathBuf {
    let kind = if linked == Linked::Shared {
        "shared"
    } else {
        "static"
    };
    let name = format!(
        "{}-{standard}-{kind}",
        Path::new(source).file_stem().unwrap().to_str().unwrap()
    );
    let program = work().join(name);
    let mut command = Command::new(compiler);
    command
        .arg(format!("-std={standard}"))
        .args(STRICT)
        .args(pkg_config(&["--cflags"]));
    if compiler == "c++" {
        command.args(["-x", "c++"]);
    }
    command
        .arg(root().join(source))
        .args(["-x", "none", "-pthread", "-o"])
        .arg(&program);
    match linked {
        Linked::Shared => {
            let library = prefix().join("lib");
            command
                .args(pkg_config(&["--libs"]))
                .arg("-lm")
                .arg(format!("-Wl,-rpath,{}", library.display()));
        }
        Linked::Static => {
            let libs = pkg_config(&["--libs", "--static"]);
            command.args(
                libs.iter()
                    .map(|l| if l == "-lfairmesh" { "-l:libfairmesh.a" } else { l }),
            );
        }
    }
    run(&mut command);
    program
}

pub(crate) fn functions_of_header() -> BTreeSet<String> {
    let header = fs::read_to_string(root().join("include/fairmesh.h")).unwrap();
    let flat = header.replace("FAIRMESH_API\n", "FAIRMESH_API ");
    let lines = flat.lines().filter(|line| line.starts_with("FAIRMESH_API "));
    lines
        .map(|line| {
            line.split('(')
                .next()
                .unwrap()
                .rsplit([' ', '*'])
                .next()
                .unwrap()
                .to_owned()
        })
        .collect()
}

#[test]
fn every_function_is_called_from_every_language_shared_and_static() {
    for linked in [Linked::Shared, Linked::Static] {
        for (compiler, standard) in [("cc", "c99"), ("cc", "c11"), ("c++", "c++17")] {
            run(&mut Command::new(compile(
                compiler,
                standard,
                "tests/c/calls.c",
                linked,
            )));
        }
        run(&mut Command::new(compile(
            "c++",
            "c++17",
            "tests/cpp/wrapper.cpp",
            linked,
        )));
    }
    let calls = fs::read_to_string(root().join("tests/c/calls.c")).unwrap();
    let wrapper = fs::read_to_string(root().join("include/fairmesh.hpp")).unwrap();
    for function in functions_of_header() {
        assert!(
            calls.contains(&format!("{function}(")),
            "tests/c/calls.c does not call {function}"
        );
        let used = wrapper.contains(&function) || function == "fairmesh_version";
        assert!(used, "fairmesh.hpp does not use {function}");
    }
}

#[test]
fn every_function_is_fuzzed() {
    let files = fs::read_dir(root().join("fuzz")).unwrap();
    let paths = files.map(|file| file.unwrap().path());
    let sources = paths.filter(|path| path.extension().is_some_and(|e| e == "c" || e == "h"));
    let calls: String = sources.map(|path| fs::read_to_string(path).unwrap()).collect();
    for function in functions_of_header() {
        let is_called = calls.contains(&format!("{function}("));
        assert!(is_called, "no target in fuzz/ calls {function}");
    }
}

#[test]
fn exported_symbols_are_the_functions_of_the_header() {
    let symbols = |arguments: &[&str], library: &str| -> BTreeSet<String> {
        let said = run(Command::new("nm").args(arguments).arg(prefix().join(library)));
        said.lines()
            .filter_map(|l| l.split_whitespace().nth(2).map(str::to_owned))
            .collect()
    };
    let functions = functions_of_header();
    assert!(functions.len() > 25);
    assert_eq!(
        symbols(&["-D", "--defined-only"], "lib/libfairmesh.so"),
        functions
    );
    assert_eq!(symbols(&["-g", "--defined-only"], "lib/libfairmesh.a"), functions);
    let dynamic = run(Command::new("readelf")
        .arg("-d")
        .arg(prefix().join("lib/libfairmesh.so")));
    assert!(dynamic.contains(&format!("[libfairmesh.so.{}]", interface())));
}

/// `FAIRMESH_WRITE_ABI=1` writes the description anew: when structs have grown, or for a new major version.
#[test]
fn the_binary_interface_is_still_the_first_one() {
    needs("abidw", "abigail-tools");
    prefix();
    let (library, stored) = (
        work().join("libfairmesh.so"),
        root().join(format!("packaging/libfairmesh.so.{}.abi", interface())),
    );
    if std::env::var_os("FAIRMESH_WRITE_ABI").is_some() {
        run(Command::new("abidw")
            .args([
                "--no-corpus-path",
                "--no-comp-dir-path",
                "--no-show-locs",
                "--out-file",
            ])
            .args([&stored, &library]));
    }
    assert_eq!(abi_changes(&stored, &library), 0);
    // The comparison sees a function that is gone, and two fields that have changed places.
    let text = fs::read_to_string(&stored).unwrap();
    let gone = text.replace("fairmesh_result_free", "fairmesh_result_drop");
    let (defect, step) = ("name='defect'", "name='step'");
    let moved = text
        .replace(defect, "name=''")
        .replace(step, defect)
        .replace("name=''", step);
    let altered = work().join("altered.abi");
    for other in [gone, moved] {
        assert!(other != text);
        fs::write(&altered, other).unwrap();
        assert_ne!(abi_changes(&altered, &library), 0);
    }
}

/// What abidiff's exit code says, 0: nothing. New functions are no change.
fn abi_changes(stored: &Path, library: &Path) -> i32 {
    let output = Command::new("abidiff")
        .args(["--no-show-locs", "--no-added-syms"])
        .args([stored, library])
        .output()
        .unwrap();
    print!("{}", String::from_utf8_lossy(&output.stdout));
    output.status.code().unwrap()
}

#[test]
fn bad_inputs_are_told_exactly() {
    for (compiler, standard) in [("cc", "c11"), ("c++", "c++17")] {
        run(&mut Command::new(compile(
            compiler,
            standard,
            "tests/c/bad_inputs.c",
            Linked::Static,
        )));
    }
}

/// Their structs are shorter, and what lies behind them is theirs.
#[test]
fn programs_of_the_first_version_work() {
    for linked in [Linked::Shared, Linked::Static] {
        run(&mut Command::new(compile("cc", "c11", "tests/c/older.c", linked)));
    }
}

#[test]
fn threads_are_kept_apart() {
    run(&mut Command::new(compile(
        "cc",
        "c11",
        "tests/c/threads.c",
        Linked::Shared,
    )));
}

#[test]
fn allocations_that_fail_and_panics_become_a_status() {
    let program = work().join("memory");
    let mut command = Command::new("cc");
    command
        .arg("-std=c11")
        .args(STRICT)
        .arg("-I")
        .arg(root().join("include"));
    command
        .arg(root().join("tests/c/memory.c"))
        .arg(hooks())
        .arg("-o")
        .arg(&program);
    command.args(["-lgcc_s", "-lutil", "-lrt", "-lpthread", "-lm", "-ldl"]);
    run(&mut command);
    // Every allocation of a small mesh; some of larger ones, to see that the reserve is large enough.
    for arguments in [
        &["1"][..],
        &["29", "60", "1", "x"],
        &["29", "60", "2", "x"],
        &["499", "200", "2", "x"],
    ] {
        run(Command::new(&program).args(arguments));
    }
}

#[test]
fn examples_build_with_cmake() {
    needs("cmake", "cmake");
    for (example, program) in [("c", "smooth_dent"), ("cpp", "fill_hole")] {
        for kind in ["OFF", "ON"] {
            let build = work().join(format!("cmake-{example}-{kind}"));
            let _ = fs::remove_dir_all(&build);
            run(Command::new("cmake")
                .arg("-S")
                .arg(root().join("examples").join(example))
                .arg("-B")
                .arg(&build)
                .arg(format!("-DCMAKE_PREFIX_PATH={}", prefix().display()))
                .arg(format!("-DFAIRMESH_USE_STATIC={kind}")));
            run(Command::new("cmake").arg("--build").arg(&build));
            run(&mut Command::new(build.join(program)));
            let needed = run(Command::new("readelf").arg("-d").arg(build.join(program)));
            assert_eq!(needed.contains("libfairmesh"), kind == "OFF");
        }
    }
}

#[test]
fn the_calls_through_cmake_are_all() {
    needs("cmake", "cmake");
    let source = work().join("cmake-calls-source");
    fs::create_dir_all(&source).unwrap();
    let tests = root().join("tests");
    fs::write(
        source.join("CMakeLists.txt"),
        format!(
            "cmake_minimum_required(VERSION 3.13)\nproject(calls C CXX)\nfind_package(fairmesh REQUIRED)\n\
             add_executable(calls {0}/c/calls.c)\nset_target_properties(calls PROPERTIES C_STANDARD 11)\n\
             target_link_libraries(calls fairmesh::shared m)\n\
             add_executable(calls_static {0}/c/calls.c)\ntarget_link_libraries(calls_static fairmesh::static m)\n\
             add_executable(wrapper {0}/cpp/wrapper.cpp)\nset_target_properties(wrapper PROPERTIES CXX_STANDARD 17)\n\
             target_link_libraries(wrapper fairmesh::fairmesh)\n",
            tests.display()
        ),
    )
    .unwrap();
    let build = work().join("cmake-calls");
    let _ = fs::remove_dir_all(&build);
    let prefix = format!("-DCMAKE_PREFIX_PATH={}", prefix().display());
    run(Command::new("cmake")
        .arg("-S")
        .arg(&source)
        .arg("-B")
        .arg(&build)
        .arg(prefix));
    run(Command::new("cmake").arg("--build").arg(&build));
    for program in ["calls", "calls_static", "wrapper"] {
        run(&mut Command::new(build.join(program)));
    }
}

#[test]
fn valgrind_has_nothing_to_say() {
    needs("valgrind", "valgrind");
    for source in ["tests/c/calls.c", "tests/c/bad_inputs.c"] {
        let program = compile("cc", "c11", source, Linked::Static);
        run(Command::new("valgrind")
            .args([
                "-q",
                "--error-exitcode=9",
                "--leak-check=full",
                "--show-leak-kinds=all",
                "--errors-for-leak-kinds=all",
            ])
            .arg(format!(
                "--suppressions={}",
                prefix().join("share/fairmesh/valgrind/fairmesh.supp").display()
            ))
            .arg(program));
    }
}
