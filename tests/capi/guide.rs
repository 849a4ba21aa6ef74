//! The code of docs/c-api.md: its program is compiled by its own commands and run, the other pieces go on from it.

use std::fs;
use std::process::Command;

use crate::command::run;
use crate::programs::{STRICT, functions_of_header, needs, pkg_config, prefix, root, work};

/// The pieces of code in this language.
fn blocks(language: &str) -> Vec<String> {
    let guide = fs::read_to_string(root().join("docs/c-api.md")).unwrap();
    let fence = format!("```{language}\n");
    let blocks = guide.split(&fence).skip(1);
    blocks
        .map(|rest| rest.split("\n```").next().unwrap().to_owned() + "\n")
        .collect()
}

/// The lines of the commands that begin so, with the place where the tests have installed everything.
fn commands(word: &str) -> Vec<String> {
    let here = prefix().display().to_string();
    let all = blocks("sh").concat().replace("$HOME/.local", &here);
    let lines = all.lines().filter(|line| line.starts_with(word));
    lines.map(str::to_owned).collect()
}

fn bash(script: &str, at: &std::path::Path) -> String {
    run(Command::new("bash")
        .current_dir(at)
        .env_remove("LD_LIBRARY_PATH")
        .args(["-c", script]))
}

#[test]
fn the_program_of_the_guide_is_built_by_its_commands_and_runs() {
    let exports = commands("export");
    assert_eq!(exports.len(), 3);
    let compile = commands("cc ");
    assert_eq!(compile.len(), 3);
    let at = work().join("guide");
    fs::create_dir_all(&at).unwrap();
    fs::write(at.join("program.c"), &blocks("c")[0]).unwrap();
    for (k, line) in compile.iter().enumerate() {
        // Only a program that does not know where the library is needs to be told when it runs.
        let needed: Vec<&String> = exports
            .iter()
            .filter(|export| k == 0 || !export.contains("LD_LIBRARY_PATH"))
            .collect();
        let needed: String = needed.into_iter().map(|line| line.to_owned() + "\n").collect();
        let said = bash(&format!("set -e\n{needed}{line}\n./program"), &at);
        assert!(said.contains("converged"), "{said}");
    }
}

#[test]
fn pieces_of_the_guide_go_on_from_its_program() {
    let code = blocks("c");
    let (head, main) = code[0].split_once("int main(void) {").unwrap();
    let (begins, _) = main.split_once("    if (fairmesh_fair(").unwrap();
    let pieces = &code[1..];
    assert!(pieces.len() > 11, "{}", pieces.len());
    let (mut text, mut calls) = (head.to_owned(), String::new());
    for (k, piece) in pieces.iter().enumerate() {
        text += &format!(
            "static void piece_{k}(fairmesh_mesh mesh, fairmesh_selection selection, fairmesh_points_out out, fairmesh_report report, \
             fairmesh_error error) {{\n(void)mesh, (void)selection, (void)out, (void)report, (void)error;\n{{\n{piece}}}\n}}\n"
        );
        calls += &format!("    piece_{k}(mesh, selection, out, report, error);\n");
    }
    text += &format!("int main(void) {{{begins}    error.status = 0;\n{calls}    return 0;\n}}\n");
    let (file, program) = (work().join("pieces.c"), work().join("pieces"));
    fs::write(&file, text).unwrap();
    run(Command::new("cc")
        .arg("-std=c99")
        .args(STRICT)
        .arg("-Wno-maybe-uninitialized")
        .args(pkg_config(&["--cflags"]))
        .arg(&file)
        .arg("-o")
        .arg(&program)
        .args(pkg_config(&["--libs"]))
        .args(["-lm", &format!("-Wl,-rpath,{}", prefix().join("lib").display())]));
    let said = run(&mut Command::new(&program));
    assert!(said.contains("option tolerance is 2"), "{said}");
    assert!(said.contains("796 triangles and 1 loops are left"), "{said}");
}

/// The first page of the header is a program.
#[test]
fn the_first_page_of_the_header_compiles_and_runs() {
    let header = fs::read_to_string(root().join("include/fairmesh.h")).unwrap();
    let page = header.lines().take_while(|line| !line.starts_with("#ifndef"));
    let program: Vec<&str> = page.filter_map(|line| line.strip_prefix(" *     ")).collect();
    assert!(program.len() > 20, "{program:?}");
    let text = format!(
        "#include <fairmesh.h>\n#include <stdio.h>\n#include <stdlib.h>\n\
         /* An octahedron without a face. */\n\
         static double xyz[] = {{1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 1}};\n\
         static const uint32_t corners[] = {{1, 0, 4, 2, 1, 4, 3, 2, 4, 0, 3, 4, 1, 2, 5, 2, 3, 5, 3, 0, 5}};\n\
         static const unsigned char is_free[] = {{0, 0, 0, 0, 1, 0}};\n\
         int main(void) {{\nsize_t vertex_count = 6, triangle_count = 7;\n{}\n\
         printf(\"%u\\n\", (unsigned)info.triangle_count);\nfree(points.data);\nfree(triangles.data);\n\
         return info.is_success ? 0 : 3;\n}}\n",
        program.join("\n")
    );
    let (source, made) = (work().join("first_page.c"), work().join("first_page"));
    fs::write(&source, text).unwrap();
    run(Command::new("cc")
        .arg("-std=c99")
        .args(STRICT)
        .args(pkg_config(&["--cflags"]))
        .arg(&source)
        .arg("-o")
        .arg(&made)
        .args(pkg_config(&["--libs"]))
        .args(["-lm", &format!("-Wl,-rpath,{}", prefix().join("lib").display())]));
    let said = run(&mut Command::new(made));
    assert_eq!(said.lines().count(), 2, "{said}");
}

/// What programmers looked for in vain before: the pieces of code that have it are compiled and run above.
#[test]
fn the_guide_has_what_programs_need() {
    let guide = fs::read_to_string(root().join("docs/c-api.md")).unwrap();
    let needed = [
        "fairmesh_fill_holes(",
        "fairmesh_remesh(",
        "options.target.kind = ",
        "export PKG_CONFIG_PATH=",
        "export CMAKE_PREFIX_PATH=",
        "export LD_LIBRARY_PATH=",
        "**`error` may be NULL** in every call",
    ];
    for words in needed {
        assert!(guide.contains(words), "{words}");
    }
}

/// Doxygen stops at the first comment that it cannot make sense of, and every function has its place on the page.
#[test]
fn the_reference_is_made_without_warnings() {
    needs("doxygen", "doxygen");
    let out = work().join("reference");
    fs::create_dir_all(&out).unwrap();
    let told = fs::read_to_string(root().join("packaging/Doxyfile")).unwrap();
    let config = out.join("Doxyfile");
    fs::write(
        &config,
        told.replace("target/doxygen", &out.display().to_string()),
    )
    .unwrap();
    run(Command::new("doxygen").current_dir(root()).arg(&config));
    let page = fs::read_to_string(out.join("html/fairmesh_8h.html")).unwrap();
    for function in functions_of_header() {
        assert!(page.contains(&function), "{function} is not in the reference");
    }
}

#[test]
fn the_guide_in_cpp_compiles_and_runs() {
    let code = blocks("cpp");
    assert_eq!(code.len(), 1);
    let (file, program) = (work().join("guide.cpp"), work().join("guide-cpp"));
    fs::write(&file, &code[0]).unwrap();
    run(Command::new("c++")
        .arg("-std=c++17")
        .args(STRICT)
        .args(pkg_config(&["--cflags"]))
        .arg(&file)
        .arg("-o")
        .arg(&program)
        .args(pkg_config(&["--libs"]))
        .arg(format!("-Wl,-rpath,{}", prefix().join("lib").display())));
    let said = run(&mut Command::new(&program));
    assert!(said.contains("triangles"), "{said}");
}
