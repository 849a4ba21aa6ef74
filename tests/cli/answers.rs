//! The library's answers (tests/answers.json): each flag arrives, and numbers of files and reports are those that are found.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::common::{directory, expect, fairmesh};
use serde_json::{Map, Value};

/// Numbers agree to this; files have all digits.
const NEAR: f64 = 1e-8;

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

fn words(list: &Value, between: &str) -> String {
    let words: Vec<String> = list.as_array().unwrap().iter().map(Value::to_string).collect();
    words.join(between)
}

fn rows(list: &Value) -> impl Iterator<Item = &Value> {
    list.as_array().unwrap().iter()
}

fn off(mesh: &Value, faces: &Value) -> String {
    let [v, f] = [&mesh["vertices"], faces].map(|list| list.as_array().unwrap().len());
    let mut text = format!("OFF\n{v} {f} 0\n");
    rows(&mesh["vertices"]).for_each(|p| _ = writeln!(text, "{}", words(p, " ")));
    rows(faces).for_each(|f| _ = writeln!(text, "3 {}", words(f, " ")));
    text
}

/// Writes a list beside the mesh, for the flag that takes it.
fn listed(directory: &Path, name: &str, lines: impl Iterator<Item = String>) -> String {
    let file = format!("{name}.txt");
    fs::write(
        directory.join(&file),
        lines.map(|line| line + "\n").collect::<String>(),
    )
    .unwrap();
    file
}

/// Each vertex with its number or vector.
fn by_vertex(directory: &Path, name: &str, given: &Value, values: &str) -> String {
    let pairs = rows(&given["vertices"]).zip(rows(&given[values]));
    let line = |(v, x): (&Value, &Value)| match x {
        Value::Array(_) => format!("{v} {}", words(x, " ")),
        _ => format!("{v} {x}"),
    };
    listed(directory, name, pairs.map(line))
}

/// What the option is on the command line; none: there is no flag for it.
fn flags(directory: &Path, call: &str, name: &str, value: &Value) -> Option<Vec<String>> {
    let flag = format!("--{}", name.replace('_', "-"));
    let text = match value {
        Value::String(text) => text.replace('_', "-"),
        other => other.to_string(),
    };
    let each = |flag: &str, word: fn(&Value) -> String| {
        rows(value)
            .flat_map(|x| [flag.to_owned(), word(x)])
            .collect::<Vec<_>>()
    };
    Some(match (call, name) {
        (_, "output_precision") | ("fill_holes", "max_iterations") => return None,
        ("fair", "free") => {
            let file = listed(directory, "free", rows(value).map(Value::to_string));
            vec![flag, file]
        }
        (_, "boundary_normals") if value.is_object() => {
            vec!["--normals".into(), by_vertex(directory, name, value, "vectors")]
        }
        (_, "boundary_normals") => vec!["--normals".into(), text],
        (_, "boundary_curvature") => vec![flag, by_vertex(directory, name, value, "values")],
        (_, "target") if value.is_number() => vec![format!("{flag}=constant={text}")],
        (_, "loop_continuity") => each("--continuity-at", |pair| words(pair, "=")),
        (_, "fair") => vec!["--no-fair".into()],
        (_, "fill") => vec![flag],
        (_, "loops") => each("--loop", Value::to_string),
        (_, "of_components") => each("--component", Value::to_string),
        (_, "guides") => each("--guide", |pair| words(pair, ",")),
        (_, "join") if value.is_array() => each(&flag, |group| words(group, ",")),
        (_, "join") if text == "none" => vec![],
        (_, "within") => {
            let flat = rows(value).map(|x| {
                if x.is_array() {
                    words(x, ",")
                } else {
                    x.to_string()
                }
            });
            vec![flag, flat.collect::<Vec<_>>().join(",")]
        }
        (_, "start") => vec!["--from".into(), words(value, ",")],
        (_, "end") => vec!["--to".into(), words(value, ",")],
        _ => vec![format!("{flag}={text}")],
    })
}

/// `fairmesh select` names regions by one flag each.
fn region(call: &str, options: &Map<String, Value>) -> Option<String> {
    let flag = match call {
        "select_component" | "select_patch" => format!("--{}-at", &call["select_".len()..]),
        _ => format!("--{}", call.strip_prefix("select_")?),
    };
    let names = [
        "centre", "low", "high", "point", "normal", "seed", "radius", "angle",
    ];
    let given = names.iter().filter_map(|&name| options.get(name));
    let given = given.map(|x| {
        if x.is_array() {
            words(x, ",")
        } else {
            x.to_string()
        }
    });
    Some(format!("{flag}={}", given.collect::<Vec<_>>().join(",")))
}

/// The arguments that the case is, if the command line can say it.
fn arguments(directory: &Path, case: &Value, mesh: &Value) -> Option<Vec<String>> {
    let (call, mut options) = (
        case["call"].as_str().unwrap(),
        case["options"].as_object().unwrap().clone(),
    );
    let faces = options.remove("faces").unwrap_or_else(|| mesh["faces"].clone());
    fs::write(directory.join("in.off"), off(mesh, &faces)).unwrap();
    let begin = |command: &str, output: &str| [command, "in.off", "-o", output].map(str::to_owned).to_vec();
    let mut all = match call {
        "fair" => begin("fair", "out.off"),
        "fill_holes" => begin("fill", "out.off"),
        "bridge" => begin("bridge", "out.off"),
        _ => {
            let mut all = begin("select", "out.txt");
            all.push(region(call, &options)?);
            return Some(all);
        }
    };
    if call == "fair" {
        options.entry("free").or_insert_with(|| mesh["free"].clone());
    }
    for (name, value) in &options {
        all.extend(flags(directory, call, name, value)?);
    }
    Some(all)
}

/// The vertices of `out.off`, and how many faces it has.
fn written(directory: &Path) -> (Vec<Vec<f64>>, usize) {
    let text = fs::read_to_string(directory.join("out.off")).unwrap();
    let mut rows = text.lines().skip(1).map(|line| {
        let words = line.split_whitespace().map(|word| word.parse().unwrap());
        words.collect::<Vec<f64>>()
    });
    let counts = rows.next().unwrap();
    (rows.take(counts[0] as usize).collect(), counts[1] as usize)
}

fn is_near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(a, b)| (a - b).abs() <= NEAR * b.abs().max(1.0))
}

fn check_report(name: &str, told: &Value, expected: &Value) {
    for (key, value) in expected.as_object().unwrap() {
        let found = match key.as_str() {
            "intersections_checked" => Value::Bool(!told["intersections"].is_null()),
            "level_count" => told["levels"].as_array().unwrap().len().into(),
            _ if told[key].is_null() => told["quality"][key].clone(),
            _ => told[key].clone(),
        };
        let same = match value {
            Value::Array(_) => is_near(&numbers(&found), &numbers(value)),
            Value::Number(x) => is_near(&[found.as_f64().unwrap()], &[x.as_f64().unwrap()]),
            _ => found == *value,
        };
        assert!(same, "{name}: {key} is {found}, not {value}");
    }
}

fn check(directory: &Path, case: &Value, told: &Value) {
    let (name, answer) = (case["name"].as_str().unwrap(), &case["answer"]);
    let (vertices, faces) = written(directory);
    for sample in rows(&answer["positions"]) {
        let found = &vertices[sample[0].as_u64().unwrap() as usize];
        assert!(
            is_near(found, &numbers(&sample[1])),
            "{name}: {found:?}, {sample}"
        );
    }
    if let Some(report) = answer.get("report") {
        check_report(name, told, report);
        for (found, expected) in rows(&told["components"][0]["continuity"]).zip(rows(&answer["continuity"])) {
            check_report(name, found, expected);
        }
    } else {
        assert_eq!(
            (vertices.len(), faces),
            (
                answer["vertex_count"].as_u64().unwrap() as usize,
                answer["face_count"].as_u64().unwrap() as usize
            ),
            "{name}"
        );
    }
    let loops = |of: &Value| of["loops"].as_array().cloned().unwrap_or_default();
    if case["call"] == "fill_holes" {
        for (found, expected) in loops(told).iter().zip(loops(answer)) {
            let is_open = expected["outcome"] == "left_open";
            assert_eq!(found["loops"], expected["loop_indices"], "{name}");
            assert_eq!(found["outcome"], expected["outcome"], "{name}");
            assert_eq!(found["edges"], expected["edge_count"], "{name}");
            assert!(is_open || found["vertices"] == expected["vertices"], "{name}");
            assert!(is_open || found["faces"] == expected["faces"], "{name}");
        }
        assert_eq!(loops(told).len(), loops(answer).len());
    }
    if case["call"] == "bridge" {
        assert_eq!(told["whole"], answer["whole"]);
        assert_eq!(told["strip"]["edges"], answer["strip"]["edge_count"]);
    }
}

fn cases(key: &str) -> (Value, Vec<Value>) {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/answers.json");
    let mut all: Value = serde_json::from_slice(&fs::read(file).unwrap()).unwrap();
    let cases = all["cases"]
        .take()
        .as_array()
        .unwrap()
        .iter()
        .filter(|case| case.get(key).is_some())
        .cloned()
        .collect();
    (all["meshes"].take(), cases)
}

#[test]
fn answers_are_those_of_the_library() {
    let directory = directory("answers");
    let (meshes, cases) = cases("answer");
    let mut left = Vec::new();
    for case in &cases {
        let name = case["name"].as_str().unwrap();
        let Some(mut all) = arguments(&directory, case, &meshes[case["mesh"].as_str().unwrap()]) else {
            left.push(name);
            continue;
        };
        all.extend(["--json", "-"].map(str::to_owned));
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        let ran = fairmesh(&directory, &all);
        let told: Value = serde_json::from_slice(&ran.stdout)
            .unwrap_or_else(|_| panic!("{all:?}: {}", String::from_utf8_lossy(&ran.stderr)));
        if all[0] == "select" {
            assert_eq!(told["faces"], case["answer"]["faces"], "{name}");
        } else {
            check(&directory, case, &told);
        }
    }
    // What has no flag of its own.
    assert_eq!(
        left,
        [
            "single",
            "failed",
            "failed, flat",
            "failed, open",
            "erase",
            "remesh",
            "finer",
            "coarser",
            "refill",
            "grow",
            "shrink",
        ]
    );
}

#[test]
fn refusals_are_those_of_the_library_and_name_the_flag() {
    let directory = directory("refusals");
    let (meshes, cases) = cases("error");
    // What a file names, or does not, is an error of the file.
    for case in (cases.iter()).filter(|case| case["name"] != "none" && case["name"] != "triangle") {
        let all = arguments(&directory, case, &meshes[case["mesh"].as_str().unwrap()]).unwrap();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        let (out, err) = expect(&directory, &all, 2);
        assert_eq!(out, "");
        let message = case["error"]["message"].as_str().unwrap();
        let told = match message
            .strip_prefix("option ")
            .and_then(|rest| rest.split_once(" is "))
        {
            // Some are refused before the mesh is read.
            Some((name, _)) if err.starts_with("error:") => format!("--{} ", name.replace('_', "-")),
            Some((name, rest)) => {
                let (value, range) = rest.split_once(": ").unwrap();
                format!("fairmesh: --{} {value}: {range}\n", name.replace('_', "-"))
            }
            None => message
                .trim_end_matches(" is named, but there are only 3")
                .to_owned(),
        };
        assert!(err.contains(&told), "{}: {err}", case["name"]);
    }
}
