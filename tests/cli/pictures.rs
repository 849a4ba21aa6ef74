//! Pictures, distances and reports: what they show and what they say.

use std::f64::consts::PI;
use std::fs;
use std::io::BufReader;
use std::path::Path;

use crate::common::{cap, directory, expect, obj, write_lists};

/// A picture's pixels, as red, green and blue, and its size.
struct Shown {
    rgb: Vec<u8>,
    size: [usize; 2],
}

fn shown(path: &Path) -> Shown {
    let file = BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut rgb).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    Shown {
        rgb,
        size: [info.width as usize, info.height as usize],
    }
}

impl Shown {
    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let at = 3 * (y * self.size[0] + x);
        [self.rgb[at], self.rgb[at + 1], self.rgb[at + 2]]
    }
}

/// A sphere about the origin as OFF.
fn sphere(radius: f64, round: usize) -> String {
    let rows = round / 2;
    let mut text = format!("OFF\n{} {} 0\n", round * (rows - 1) + 2, 2 * round * (rows - 1));
    for i in 1..rows {
        let (r, z) = (PI * i as f64 / rows as f64).sin_cos();
        for j in 0..round {
            let (y, x) = (2.0 * PI * j as f64 / round as f64).sin_cos();
            text += &format!("{} {} {}\n", radius * r * x, radius * r * y, radius * z);
        }
    }
    let poles = round * (rows - 1);
    text += &format!("0 0 {radius}\n0 0 {}\n", -radius);
    for j in 0..round {
        let next = (j + 1) % round;
        text += &format!(
            "3 {poles} {j} {next}\n3 {} {} {}\n",
            poles + 1,
            poles - round + next,
            poles - round + j
        );
        for i in 0..rows - 2 {
            let [a, b] = [i * round + j, i * round + next];
            text += &format!("3 {a} {} {b}\n3 {b} {} {}\n", a + round, a + round, b + round);
        }
    }
    text
}

#[test]
fn concentric_spheres_are_as_far_as_their_radii_differ() {
    let directory = directory("pictures-spheres");
    fs::write(directory.join("inner.off"), sphere(1.0, 64)).unwrap();
    fs::write(directory.join("outer.off"), sphere(1.25, 48)).unwrap();
    let args = [
        "render",
        "inner.off",
        "outer.off",
        "-o",
        "d.png",
        "--shade",
        "distance",
        "--size",
        "100x90",
        "--json",
        "d.json",
    ];
    let (out, _) = expect(&directory, &args, 0);
    assert!(out.starts_with("outer.off against inner.off:\n"), "{out}");
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(directory.join("d.json")).unwrap()).unwrap();
    let found = &report["distances"][0];
    for way in ["to_first", "from_first"] {
        let figure = |name: &str| found[way][name].as_f64().unwrap();
        for name in ["largest", "largest_bound", "rms", "mean"] {
            // The facets lie inside the spheres, by less than 0.003 of the radius.
            assert!((figure(name) - 0.25).abs() < 0.005, "{way} {name}: {found}");
        }
        assert!(figure("mean") <= figure("rms") && figure("rms") <= figure("largest"));
        assert!(figure("largest_bound") <= 1.0101 * figure("largest"), "{found}");
    }
    let diagonal = found["diagonal"].as_f64().unwrap();
    assert!((diagonal - 12f64.sqrt()).abs() < 1e-9, "{found}");
    // Two tiles, the scale and the captions; the second sphere is painted by what is nearly the largest distance.
    let picture = shown(&directory.join("d.png"));
    assert!(
        picture.size[0] > 200 && picture.size[1] == 90 + 24,
        "{:?}",
        picture.size
    );
    let [red, green, blue] = picture.at(150, 45);
    assert!(red > 2 * green && red > 2 * blue, "{red} {green} {blue}");
    let [red, _, blue] = picture.at(50, 45);
    assert!(blue > red);
    // A mesh and itself, of another format.
    let (out, _) = expect(
        &directory,
        &[
            "render",
            "inner.off",
            "inner.off",
            "-o",
            "d.png",
            "--shade",
            "distance",
            "--json",
            "-",
        ],
        0,
    );
    let report: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert!(report["distances"][0]["to_first"]["largest"].as_f64().unwrap() < 1e-12);
}

/// Exactly this message, with exit code 2.
fn refused(directory: &Path, args: &[&str], message: &str) {
    let (out, err) = expect(directory, args, 2);
    assert_eq!((out.as_str(), err.trim_end()), ("", message), "{args:?}");
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let directory = directory("pictures-refused");
    fs::write(directory.join("a.obj"), obj(&cap())).unwrap();
    fs::write(
        directory.join("nan.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n",
    )
    .unwrap();
    let render = |more: &[&'static str], message: &str| {
        let mut args = vec!["render", "a.obj", "-o", "a.png"];
        args.extend(more);
        refused(&directory, &args, message);
    };
    render(
        &["--shade", "distance"],
        "fairmesh: --shade distance: one mesh has nothing to be measured against; name the other one, too",
    );
    render(
        &["--json", "a.json"],
        "fairmesh: --json: nothing is measured without --shade distance",
    );
    render(
        &["a.obj", "--shade", "curvature,distance", "--range", "0,1"],
        "fairmesh: --range: curvature and distance have a scale each; make a picture of each",
    );
    render(
        &["nan.obj", "--shade", "distance"],
        "fairmesh: nan.obj: vertex 2 has a coordinate that is not finite",
    );
    assert!(!directory.join("a.png").exists() && !directory.join("a.json").exists());
}

#[test]
fn before_and_after_are_on_one_sheet() {
    let directory = directory("pictures-sheet");
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    let fair = [
        "fair",
        "cap.obj",
        "-o",
        "fair.obj",
        "--free",
        "free.txt",
        "--picture",
    ];
    let with = |more: &[&'static str]| [&fair[..], more].concat();
    let (out, _) = expect(&directory, &with(&["sheet.png"]), 0);
    assert!(out.starts_with("converged"), "{out}");
    let sheet = shown(&directory.join("sheet.png"));
    // Two columns and the scale; two lines of text, and three rows with captions.
    assert_eq!(sheet.size, [2 * 520 + 93, 48 + 3 * (440 + 24)]);
    // Before and after differ in the middle of what has changed; the last picture has it in orange.
    assert_ne!(sheet.at(260, 48 + 220), sheet.at(520 + 260, 48 + 220));
    let [red, green, blue] = sheet.at(520 + 260, 48 + 2 * 464 + 220);
    assert!(red > green && green > blue, "{red} {green} {blue}");
    // Another view, with the mesh and the report on stdout.
    let to_stdout = [
        "fair",
        "cap.obj",
        "-o",
        "-",
        "--format",
        "obj",
        "--free",
        "free.txt",
        "--picture",
        "other.png",
        "--view",
        "top",
        "--up",
        "0,1,0",
    ];
    let (mesh, _) = expect(&directory, &to_stdout, 0);
    assert_eq!(mesh, fs::read_to_string(directory.join("fair.obj")).unwrap());
    assert_eq!(shown(&directory.join("other.png")).size, sheet.size);

    refused(
        &directory,
        &with(&["sheet.jpg"]),
        "fairmesh: --picture sheet.jpg: only .png is written; let the name end so",
    );
    refused(
        &directory,
        &with(&["-"]),
        "fairmesh: --picture -: name a file; stdout is for the mesh or the report",
    );
    refused(
        &directory,
        &with(&["none/sheet.png"]),
        "fairmesh: none/sheet.png: cannot write: no file can be made in 'none': it does not exist",
    );
    refused(
        &directory,
        &with(&["sheet.png", "--view", "above"]),
        "fairmesh: --view above: give x,y,z or front, back, left, right, top, bottom, corner",
    );
    refused(
        &directory,
        &[
            "fair", "cap.obj", "-o", "fair.obj", "--free", "free.txt", "--up", "0,1,0",
        ],
        "fairmesh: --up: no picture is made; give --picture or --report, too",
    );
}

#[test]
fn several_meshes_have_a_picture_each() {
    let directory = directory("pictures-several");
    for name in ["a.obj", "b.obj"] {
        fs::write(directory.join(name), obj(&cap())).unwrap();
    }
    fs::create_dir(directory.join("more")).unwrap();
    fs::write(directory.join("more/a.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    let fair = ["fair", "a.obj", "b.obj", "--free", "free.txt"];
    expect(
        &directory,
        &[&fair[..], &["-o", "out/", "--picture", "shown/"]].concat(),
        0,
    );
    expect(
        &directory,
        &[&fair[..], &["--in-place", "--picture", "placed/"]].concat(),
        0,
    );
    for name in ["shown/a.png", "shown/b.png", "placed/a.png", "placed/b.png"] {
        assert_eq!(shown(&directory.join(name)).size[1], 48 + 3 * 464);
    }
    refused(
        &directory,
        &[&fair[..], &["-o", "out/", "--picture", "one.png"]].concat(),
        "fairmesh: --picture one.png: several meshes need a directory; make it before, or end its name in /",
    );
    refused(
        &directory,
        &[
            "fair",
            "a.obj",
            "more/a.obj",
            "--in-place",
            "--free",
            "free.txt",
            "--picture",
            "shown/",
        ],
        "fairmesh: --picture: a.obj and more/a.obj would both be shown in shown/a.png; do them one by one",
    );
}

#[test]
fn a_hole_that_is_filled_and_a_bridge_are_shown() {
    let directory = directory("pictures-filled");
    let open: String = obj(&cap())
        .lines()
        .enumerate()
        .filter(|(k, _)| !(320..324).contains(k))
        .map(|(_, line)| format!("{line}\n"))
        .collect();
    fs::write(directory.join("open.obj"), open).unwrap();
    expect(
        &directory,
        &["fill", "open.obj", "-o", "filled.obj", "--picture", "filled.png"],
        0,
    );
    assert_eq!(shown(&directory.join("filled.png")).size[1], 48 + 3 * 464);
    // Nothing is left to be filled.
    expect(
        &directory,
        &["fill", "filled.obj", "-o", "same.obj", "--picture", "same.png"],
        0,
    );
    assert_eq!(shown(&directory.join("same.png")).size[1], 48 + 3 * 464);
}

/// The elements of a page in their order, each closed where it has to be; panics where the page is no well-formed XML.
fn elements(page: &str) -> Vec<String> {
    let body = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    let (mut open, mut all): (Vec<&str>, Vec<String>) = (Vec::new(), Vec::new());
    for piece in body.split('<').skip(1) {
        let (tag, text) = piece
            .split_once('>')
            .unwrap_or_else(|| panic!("not closed: <{piece}"));
        assert!(!text.contains('>'), "{text}");
        for entity in text.split('&').skip(1).chain(tag.split('&').skip(1)) {
            let name = entity.split(';').next().unwrap();
            assert!(["amp", "lt", "gt", "quot", "#39"].contains(&name), "&{entity}");
        }
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None => {
                let name = tag.split([' ', '/']).next().unwrap();
                assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
                all.push(name.to_owned());
                if !tag.ends_with('/') {
                    open.push(name);
                }
            }
        }
    }
    assert!(open.is_empty(), "{open:?}");
    all
}

#[test]
fn a_report_is_one_page_that_says_what_was_done() {
    let directory = directory("pictures-report");
    let odd = "a & <b>'s.obj";
    fs::write(directory.join(odd), obj(&cap())).unwrap();
    write_lists(&directory);
    let args = [
        "fair",
        odd,
        "-o",
        "fair.obj",
        "--free",
        "free.txt",
        "--report",
        "report.html",
        "--continuity",
        "g2",
    ];
    expect(&directory, &args, 0);
    let page = fs::read_to_string(directory.join("report.html")).unwrap();
    let elements = elements(&page);
    let count = |name: &str| elements.iter().filter(|e| *e == name).count();
    assert_eq!(
        (count("img"), count("figure"), count("svg"), count("script")),
        (6, 6, 1, 0)
    );
    // Nothing is asked from elsewhere.
    for outside in ["http", "src=\"/", "url(", "@import", "<link", "<script", "href"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert_eq!(
        page.matches(" src=\"data:image/png;base64,iVBORw0KGgo").count(),
        6
    );
    assert_eq!(page.matches(" alt=\"").count(), 6);
    let name = "a &amp; &lt;b&gt;&#39;s.obj";
    for said in [
        &format!("<title>fair: {name}</title>"),
        "<p class=\"outcome good\">converged: tolerance met, and the surface is sound</p>",
        "fairmesh fair &#39;a &amp; &lt;b&gt;&#39;\\&#39;&#39;s.obj&#39; -o fair.obj --free free.txt",
        "kink across the boundary",
        "moved at most",
        "continuous curvature",
        "self-intersections</th><td>none found",
        "prefers-color-scheme:dark",
        concat!("<footer>fairmesh ", env!("CARGO_PKG_VERSION")),
    ] {
        assert!(page.contains(said), "{said}");
    }
    // Letters of pictures may spell anything.
    let text: String = page.lines().filter(|line| !line.contains("base64")).collect();
    assert!(!text.contains("<b>") && !text.contains("NaN"));

    refused(
        &directory,
        &[
            "fair",
            odd,
            "-o",
            "fair.obj",
            "--free",
            "free.txt",
            "--report",
            "report.pdf",
        ],
        "fairmesh: --report report.pdf: only .html is written; let the name end so",
    );
}

#[test]
fn a_report_of_holes_names_each() {
    let directory = directory("pictures-report-holes");
    expect(
        &directory,
        &["generate", "sphere-hole", "--vertices", "400", "-o", "open.ply"],
        0,
    );
    let args = [
        "fill", "open.ply", "-o", "-", "--format", "ply", "--report", "r.html", "--json", "r.json", "--quiet",
    ];
    let output = crate::common::fairmesh(&directory, &args);
    assert_eq!(output.status.code(), Some(0));
    let page = fs::read_to_string(directory.join("r.html")).unwrap();
    elements(&page);
    for said in [
        "<p class=\"outcome good\">1 filled</p>",
        "loop 0",
        "triangles that are gone</th><td>0<",
        "after: mean curvature",
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("moved at most"));
}
