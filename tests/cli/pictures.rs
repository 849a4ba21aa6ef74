//! Pictures, distances and reports: what they show and what they say.

use std::f64::consts::PI;
use std::fs;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::common::{cap, directory, expect, is_free, obj, sheet, write_lists};
use crate::tier::tier;

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
    fs::write(directory.join("inner.off"), sphere(1.0, 48)).unwrap();
    fs::write(directory.join("outer.off"), sphere(1.25, 40)).unwrap();
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
            // The facets lie inside the spheres, by less than 0.004 of the radius.
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
}

#[test]
fn a_mesh_has_no_distance_from_itself() {
    let directory = directory("pictures-same");
    fs::write(directory.join("inner.off"), sphere(1.0, 48)).unwrap();
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

/// What makes the cap's dent fair.
const FAIR: [&str; 6] = ["fair", "cap.obj", "-o", "fair.obj", "--free", "free.txt"];

/// `FAIR` with a picture.
fn with_picture(more: &[&'static str]) -> Vec<&'static str> {
    [&FAIR[..], &["--picture"], more].concat()
}

#[test]
fn before_and_after_are_on_one_sheet() {
    let directory = directory("pictures-sheet");
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    let (out, _) = expect(&directory, &with_picture(&["sheet.png"]), 0);
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
}

#[test]
fn sheets_that_cannot_be_made_are_refused() {
    let directory = directory("pictures-no-sheet");
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    refused(
        &directory,
        &with_picture(&["sheet.jpg"]),
        "fairmesh: --picture sheet.jpg: only .png is written; let the name end so",
    );
    refused(
        &directory,
        &with_picture(&["-"]),
        "fairmesh: --picture -: name a file; stdout is for the mesh or the report",
    );
    refused(
        &directory,
        &with_picture(&["none/sheet.png"]),
        "fairmesh: none/sheet.png: cannot write: no file can be made in 'none': it does not exist",
    );
    refused(
        &directory,
        &with_picture(&["sheet.png", "--view", "above"]),
        "fairmesh: --view above: give x,y,z or front, back, left, right, top, bottom, corner",
    );
    refused(
        &directory,
        &[&FAIR[..], &["--up", "0,1,0"]].concat(),
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
    let mut made = vec!["shown/a.png", "shown/b.png"];
    if tier(false, true) {
        expect(
            &directory,
            &[&fair[..], &["--in-place", "--picture", "placed/"]].concat(),
            0,
        );
        made.extend(["placed/a.png", "placed/b.png"]);
    }
    for name in made {
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
    let open: String = obj(&sheet())
        .lines()
        .enumerate()
        .filter(|(k, _)| !(244..246).contains(k))
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
        3,
    );
    assert_eq!(shown(&directory.join("same.png")).size[1], 48 + 3 * 464);
}

/// A mesh that would be lost beside another one has a camera of its own; others are shown in one scale. A turntable has the same cameras.
#[test]
fn each_mesh_fills_its_picture_where_it_would_be_lost_among_the_others() {
    let directory = directory("pictures-frames");
    for (name, radius) in [("one.off", 1.0), ("half.off", 0.5), ("small.off", 0.01)] {
        fs::write(directory.join(name), sphere(radius, 24)).unwrap();
    }
    let covered = |other: &str, more: &[&str]| {
        let args = ["render", "one.off", other, "-o", "two.png", "--size", "100x100"];
        expect(&directory, &[&args[..], more].concat(), 0);
        let shown = shown(&directory.join("two.png"));
        [0, 100].map(|left| {
            let backdrop = shown.at(left, 0);
            (left..left + 100)
                .filter(|&x| shown.at(x, 50) != backdrop)
                .count()
        })
    };
    let [one, half] = covered("half.off", &[]);
    assert!(
        one > 80 && (half as f64 / one as f64 - 0.5).abs() < 0.05,
        "{one}, {half}"
    );
    let [one, small] = covered("small.off", &[]);
    assert!(one > 80 && small.abs_diff(one) < 2, "{one}, {small}");
    let [one, small] = covered("small.off", &["--turntable", "2"]);
    assert!(one > 80 && small.abs_diff(one) < 2, "{one}, {small}");
    let [one, small] = covered("small.off", &["--shade", "distance"]);
    assert!(one > 80 && small < 4, "{one}, {small}");
}

/// The elements of a page in their order, each closed where it has to be; panics where the page is no well-formed XML.
fn elements(page: &str) -> Vec<String> {
    let body = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    // A program is no text.
    let (before, rest) = body.split_once("<script>").unwrap();
    let body = format!("{before}<script>{}", &rest[rest.find("</script>").unwrap()..]);
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
        (6, 6, 1, 1)
    );
    // Nothing is asked from elsewhere.
    for outside in ["http", "src=\"/", "url(", "@import", "<link", "<script ", "href"] {
        assert!(!page.contains(outside), "{outside}");
    }
    // Each picture has its depths, for the place under the pointer.
    for part in [
        "src=\"data:image/png;base64,iVBORw0KGgo",
        "data-depths=\"data:image/png;base64,iVBORw0KGgo",
        "alt=\"",
    ] {
        assert_eq!(page.matches(&format!(" {part}")).count(), 6, "{part}");
    }
    let name = "a &amp; &lt;b&gt;&#39;s.obj";
    for said in [
        &format!("<title>fair: {name}</title>"),
        "<p class=\"outcome good\">converged: tolerance met, and the surface is sound</p>",
        "fairmesh fair &#39;a &amp; &lt;b&gt;&#39;\\&#39;&#39;s.obj&#39; -o fair.obj --free free.txt",
        "kink across the boundary",
        "triangles that changed",
        "moved at most",
        "continuous curvature",
        "self-intersections</th><td>none found",
        "prefers-color-scheme:dark",
        concat!("<footer>fairmesh ", env!("CARGO_PKG_VERSION")),
    ] {
        assert!(page.contains(said), "{said}");
    }
    // What is seen first: the verdict and the pictures; numbers are folded away.
    let place = |what: &str| elements.iter().position(|e| e == what).unwrap();
    assert!(place("p") < place("img") && place("img") < place("ul") && place("ul") < place("details"));
    assert!(place("details") < place("table") && place("details") < place("svg"));
    // Letters of pictures may spell anything.
    let text: String = page.lines().filter(|line| !line.contains("base64")).collect();
    assert!(!text.contains("<b>") && !text.contains("NaN"));
}

#[test]
fn a_report_is_html_only() {
    let directory = directory("pictures-no-report");
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    refused(
        &directory,
        &[&FAIR[..], &["--report", "report.pdf"]].concat(),
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
        "<p class=\"outcome good\">holes: 1 filled</p>",
        "loop 0",
        "triangles that are gone</th><td>0<",
        "after: mean curvature",
    ] {
        assert!(page.contains(said), "{said}");
    }
    assert!(!page.contains("moved at most"));
}

/// Four squares of eight by eight pixels as JPEG: red, green; blue, white.
const JPEG: &str = "\
    ffd8ffe000104a46494600010100000100010000ffdb0043000d090a0b0a080d0b0a0b0e0e0d0f13201513121213271c1e17\
    202e2931302e292d2c333a4a3e333646372c2d405741464c4e525352323e5a615a50604a51524fffdb0043010e0e0e131113\
    261515264f352d354f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f4f\
    4f4f4f4f4f4f4f4fffc00011080010001003012200021101031101ffc4001600010101000000000000000000000000000607\
    08ffc40014100100000000000000000000000000000000ffc40014010100000000000000000000000000000000ffc4002211\
    00010203090000000000000000000000110012056171030613141521234151ffda000c03010002110311003f003e5c9a3459\
    16bbd97672127aa4d2396bace1ecc6199229e2ffd9";

/// A picture of the same four squares, a pixel each, as PNG.
fn four_pixels() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer
        .write_image_data(&[255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255])
        .unwrap();
    writer.finish().unwrap();
    bytes
}

/// The colour names of a picture's quarters: upper left, upper right, lower left, lower right.
fn quarters(shown: &Shown, left: usize) -> [&'static str; 4] {
    let side = shown.size[1];
    let at = |x: usize, y: usize| {
        let [red, green, blue] = shown.at(left + x * side / 4, y * side / 4).map(|byte| byte > 100);
        match (red, green, blue) {
            (true, false, false) => "red",
            (false, true, false) => "green",
            (false, false, true) => "blue",
            (true, true, true) => "white",
            _ => "another",
        }
    };
    [at(1, 1), at(3, 1), at(1, 3), at(3, 3)]
}

/// Flags that show a mesh of the plane z = 0 from above.
const ABOVE: [&str; 8] = [
    "--view",
    "top",
    "--up",
    "0,1,0",
    "--size",
    "80x80",
    "--caption",
    "",
];

/// A directory with the four squares as PNG and as JPEG, and `quad.mtl`, which names them.
fn with_textures(test: &str) -> PathBuf {
    let directory = directory(test);
    let digits = JPEG.as_bytes().chunks(2);
    let jpeg: Vec<u8> = digits
        .map(|two| u8::from_str_radix(std::str::from_utf8(two).unwrap(), 16).unwrap())
        .collect();
    fs::create_dir(directory.join("my maps")).unwrap();
    fs::write(directory.join("my maps/four.png"), four_pixels()).unwrap();
    fs::write(directory.join("four.jpg"), jpeg).unwrap();
    fs::write(
        directory.join("quad.mtl"),
        "newmtl plain\nKd 0 0 1\nnewmtl four\nmap_Kd -s 1 1 1 my maps/four.png\n",
    )
    .unwrap();
    directory
}

/// The vertices of a square in OBJ.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A square in OBJ with its lower left and its upper right texture coordinates.
fn quad([a, b, c, d]: [f64; 4], library: &str) -> String {
    format!(
        "mtllib {library}\n{SQUARE}vt {a} {b}\nvt {c} {b}\nvt {c} {d}\nvt {a} {d}\nusemtl four\nf 1/1 2/2 3/3 4/4\n"
    )
}

/// How a square in PLY with a texture begins.
const TEXTURED_PLY: &str = "ply\nformat ascii 1.0\ncomment TextureFile four.jpg\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

/// A square in PLY with texture coordinates of its face.
fn quad_of_faces() -> String {
    format!(
        "{TEXTURED_PLY}element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n\
         0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n"
    )
}

/// The colours of a mesh with its texture.
fn painted(directory: &Path, name: &str, text: &str) -> [&'static str; 4] {
    fs::write(directory.join(name), text).unwrap();
    let args = [&["render", name, "-o", "t.png", "--shade", "texture"], &ABOVE[..]].concat();
    expect(directory, &args, 0);
    quarters(&shown(&directory.join("t.png")), 0)
}

/// The four squares as they lie in their pictures.
const AS_THEY_LIE: [&str; 4] = ["red", "green", "blue", "white"];

#[test]
fn textures_of_obj_lie_as_their_coordinates_say() {
    let directory = with_textures("pictures-textured-obj");
    let painted = |text: &str| painted(&directory, "quad.obj", text);
    let whole = quad([0.0, 0.0, 1.0, 1.0], "quad.mtl");
    assert_eq!(painted(&whole), AS_THEY_LIE);
    // Repeated, and turned around.
    assert_eq!(painted(&quad([5.0, -2.0, 6.0, -1.0], "quad.mtl")), AS_THEY_LIE);
    assert_eq!(
        painted(&quad([1.0, 1.0, 0.0, 0.0], "quad.mtl")),
        ["white", "blue", "green", "red"]
    );
    // A material of one colour.
    let plain = whole.replace("usemtl four", "usemtl plain");
    assert_eq!(painted(&plain), ["blue"; 4]);
}

#[test]
fn textures_of_ply_lie_as_their_coordinates_say() {
    let directory = with_textures("pictures-textured-ply");
    assert_eq!(painted(&directory, "faces.ply", &quad_of_faces()), AS_THEY_LIE);
    let of_vertices = format!(
        "{TEXTURED_PLY}property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
         0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n"
    );
    assert_eq!(painted(&directory, "vertices.ply", &of_vertices), AS_THEY_LIE);
}

#[test]
fn textures_that_are_not_there_are_told() {
    let directory = with_textures("pictures-no-texture");
    let wrong = |name: &str, text: &str, message: &str| {
        fs::write(directory.join(name), text).unwrap();
        let args = ["render", name, "-o", "w.png", "--shade", "texture"];
        refused(&directory, &args, &format!("fairmesh: {message}"));
    };
    let needless = |name: &str, text: &str, message: &str| {
        wrong(
            name,
            text,
            &format!("{message}; --shade flat or colors needs none"),
        );
    };
    needless(
        "a.obj",
        &quad([0.0; 4], "none.mtl"),
        "a.obj: its materials none.mtl cannot be read in .: No such file or directory (os error 2)",
    );
    needless(
        "a.obj",
        &format!("{SQUARE}f 1 2 3 4\n"),
        "a.obj: it names no materials (mtllib), and so no texture",
    );
    needless(
        "a.ply",
        &quad_of_faces().replace("four.jpg", "lost.png"),
        "a.ply: the texture lost.png was not found in .; put it there, or correct its name in a.ply",
    );
    needless(
        "a.obj",
        &format!("mtllib quad.mtl\n{SQUARE}usemtl four\nf 1 2 3 4\n"),
        "a.obj: its faces have no texture coordinates",
    );
    needless("a.off", &sphere(1.0, 4), "a.off: OFF has no textures");
    fs::write(directory.join("four.jpg"), "GIF89a").unwrap();
    wrong(
        "faces.ply",
        &quad_of_faces(),
        "./four.jpg: only PNG and JPEG are read as textures; convert it",
    );
    assert!(!directory.join("w.png").exists());
}

#[test]
fn colours_are_those_of_the_file() {
    let directory = directory("pictures-coloured");
    // A square of four quarters, of vertices of their own.
    let colours = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]];
    let corners = [(0, 1), (1, 1), (0, 0), (1, 0)];
    let square =
        |k: usize| [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| (corners[k].0 + x, corners[k].1 + y));
    let faces = |first: usize| (0..4).map(move |k| [0, 1, 2, 3].map(|i| 4 * k + i + first));
    let mut obj = String::new();
    let mut off = "COFF\n16 4 0\n".to_owned();
    let mut ply = "ply\nformat ascii 1.0\nelement vertex 16\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
                   property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        .to_owned();
    for (k, [r, g, b]) in colours.into_iter().enumerate() {
        for (x, y) in square(k) {
            obj += &format!("v {x} {y} 0 {} {} {}\n", r / 255, g / 255, b / 255);
            off += &format!("{x} {y} 0 {r} {g} {b} 255\n");
            ply += &format!("{x} {y} 0\n");
        }
    }
    for [a, b, c, d] in faces(1) {
        obj += &format!("f {a} {b} {c} {d}\n");
    }
    for ([a, b, c, d], [red, green, blue]) in faces(0).zip(colours) {
        off += &format!("4 {a} {b} {c} {d}\n");
        ply += &format!("4 {a} {b} {c} {d} {red} {green} {blue}\n");
    }
    for (name, text) in [("a.obj", &obj), ("a.off", &off), ("a.ply", &ply)] {
        fs::write(directory.join(name), text).unwrap();
        let args = [&["render", name, "-o", "c.png", "--shade", "colors"], &ABOVE[..]].concat();
        expect(&directory, &args, 0);
        let shown = shown(&directory.join("c.png"));
        assert_eq!(quarters(&shown, 0), ["red", "green", "blue", "white"], "{name}");
    }
    fs::write(directory.join("b.off"), sphere(1.0, 6)).unwrap();
    refused(
        &directory,
        &["render", "b.off", "-o", "b.png", "--shade", "colors"],
        "fairmesh: b.off: it has no colours; --shade flat needs none, texture takes those of its pictures",
    );
}

#[test]
fn a_turntable_has_as_many_frames_as_asked() {
    let directory = directory("pictures-turning");
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    let render = |output: &str, more: &[&str]| {
        let args = ["render", "cap.obj", "-o", output, "--size", "60x50"];
        expect(&directory, &[&args[..], more].concat(), 0);
        fs::read(directory.join(output)).unwrap()
    };
    let still = render("still.png", &["--caption", ""]);
    let gif = render("turning.gif", &["--turntable", "5", "--caption", ""]);
    assert!(gif.starts_with(b"GIF89a"));
    // Every frame has its own size and palette; it is repeated without end.
    let frames = gif
        .windows(9)
        .filter(|w| w[..5] == [0x2c, 0, 0, 0, 0] && w[5..] == [60, 0, 50, 0]);
    assert_eq!(frames.count(), 5);
    assert!(gif.windows(11).any(|w| w == b"NETSCAPE2.0"));
    let png = render("turning.png", &["--turntable", "7", "--shade", "curvature"]);
    let mut reader = png::Decoder::new(std::io::Cursor::new(&png)).read_info().unwrap();
    let control = *reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (7, 0));
    let mut frames = Vec::new();
    for _ in 0..7 {
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        frames.push(pixels);
    }
    assert!(frames.windows(2).all(|two| two[0] != two[1]));
    assert!(still.starts_with(b"\x89PNG"));

    let wrong = |output: &str, more: &[&str], message: &str| {
        let args = ["render", "cap.obj", "-o", output];
        refused(
            &directory,
            &[&args[..], more].concat(),
            &format!("fairmesh: {output}: {message}"),
        );
        assert!(!directory.join(output).exists());
    };
    wrong(
        "a.gif",
        &[],
        "GIF is written with --turntable only; let the name end in .png",
    );
    let only = "only PNG is written, and GIF with --turntable; let the name end in .png";
    wrong("a.jpg", &[], only);
    wrong("a.webp", &["--turntable", "5"], only);
    let args = ["render", "cap.obj", "-o", "a.png", "--turntable", "1"];
    let (_, err) = expect(&directory, &args, 2);
    assert!(err.contains("2..=360"), "{err}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_picture_that_cannot_be_written_is_told_with_what_was() {
    let directory = directory("pictures-full");
    fs::write(directory.join("cap.obj"), obj(&cap())).unwrap();
    write_lists(&directory);
    let both = [("--picture", "full.png"), ("--report", "full.html")];
    for &(flag, name) in tier(&both[..1], &both) {
        std::os::unix::fs::symlink("/dev/full", directory.join(name)).unwrap();
        let output = format!("{name}.obj");
        let args = ["fair", "cap.obj", "-o", &output, "--free", "free.txt", flag, name];
        let (_, err) = expect(&directory, &args, 5);
        assert_eq!(
            err,
            format!(
                "fairmesh: {name}: cannot write: No space left on device (os error 28); the result was written to {output}\n"
            )
        );
        assert!(directory.join(output).exists());
    }
    // Of several meshes the other one is not concerned.
    fs::copy(directory.join("cap.obj"), directory.join("second.obj")).unwrap();
    fs::create_dir(directory.join("seen")).unwrap();
    std::os::unix::fs::symlink("/dev/full", directory.join("seen/cap.png")).unwrap();
    let both = [
        "fair",
        "cap.obj",
        "second.obj",
        "-o",
        "out/",
        "--free",
        "free.txt",
    ];
    let (told, err) = expect(&directory, &[&both[..], &["--picture", "seen"]].concat(), 5);
    assert!(told.contains("written, not told"), "{told}");
    assert!(
        told.ends_with("2 files: 1 as asked, 1 written with a reservation, 0 not written\n"),
        "{told}"
    );
    assert_eq!(err.lines().count(), 1, "{err}");
    assert!(directory.join("seen/second.png").exists());
    assert!(directory.join("out/cap.obj").exists() && directory.join("out/second.obj").exists());
}

#[test]
fn what_is_not_finite_elsewhere_in_the_file_does_not_count() {
    let directory = directory("pictures-not-finite");
    let text = obj(&cap()).replace("f 1 2 17 16\n", "v nan 0 0\nf 1 2 17 226\n");
    assert!(text.contains("226"));
    fs::write(directory.join("cap.obj"), text).unwrap();
    write_lists(&directory);
    let shown = ["--report", "a.html", "--picture", "a.png"];
    let args = [&FAIR[..], tier(&shown[..2], &shown)].concat();
    expect(&directory, &args, 0);
    let page = fs::read_to_string(directory.join("a.html")).unwrap();
    assert!(page.contains("moved at most</th><td>0.09981 (at"));
}

#[test]
fn curvature_is_no_advice_where_the_surroundings_are_rough() {
    let directory = directory("pictures-rough");
    write_lists(&directory);
    for (amplitude, is_advised) in [(0.0, true), (0.012, false)] {
        let noise = |v: usize| amplitude * (((v * 7_919 + 13) % 101) as f64 / 50.0 - 1.0);
        let moved = |(v, [x, y, z]): (usize, [f64; 3])| [x, y, z + if is_free(v) { 0.0 } else { noise(v) }];
        let positions: Vec<[f64; 3]> = cap().into_iter().enumerate().map(moved).collect();
        fs::write(directory.join("cap.obj"), obj(&positions)).unwrap();
        let (told, _) = expect(
            &directory,
            &[&FAIR[..], &["--continuity", "g1", "--report", "r.html"]].concat(),
            0,
        );
        let page = fs::read_to_string(directory.join("r.html")).unwrap();
        assert!(page.contains("Look at the reflection lines"), "{told}");
        assert_eq!(page.contains("--continuity g2"), is_advised, "{told}");
    }
}
