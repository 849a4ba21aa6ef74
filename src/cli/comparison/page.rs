//! A report as one page: what was asked, what was done, and how it looks. It needs nothing but itself.

use std::fmt::Write;
use std::path::Path;

use super::changes::Comparison;
use super::histogram::histogram;
use super::markup::{command_line, data_uri, escaped};
use super::sheet::{Picture, Sheet};
use crate::failure::Failure;
use crate::figures::significant;

/// What a command says of a mesh.
pub struct Story {
    /// As on the command line.
    pub command: &'static str,
    pub is_good: bool,
    /// In a sentence.
    pub outcome: String,
    /// What to do about it, or to look at next.
    pub advice: Vec<String>,
    /// Names and values.
    pub facts: Vec<(String, String)>,
    /// The report as it is printed.
    pub printed: String,
}

const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1c2126;--dim:#5a646e;--paper:#fff;--line:#d5dae0;--good:#0b6e4f;--reserved:#a04a00;--before:#d55e00;--after:#0072b2}
@media(prefers-color-scheme:dark){:root{--ink:#e6e9ec;--dim:#a3adb6;--paper:#16191d;--line:#3a424a;--good:#5fd3a8;--reserved:#ffab66;--before:#ff9248;--after:#56b4e9}}
body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);max-width:70rem;margin:2rem auto;padding:0 1rem;overflow-wrap:anywhere}
h1{font-size:1.6rem;margin:0}h2{font-size:1.2rem;margin:2rem 0 .5rem}
.outcome{box-shadow:inset .4rem 0 var(--reserved);padding:.3rem 1rem;font-size:1.1rem}.outcome.good{box-shadow:inset .4rem 0 var(--good)}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,24rem),1fr));gap:1rem}
figure{margin:0;position:relative}figure[data-depths] img{cursor:crosshair}img{max-width:100%;height:auto;box-shadow:0 0 0 1px var(--line)}figcaption{color:var(--dim)}
th{text-align:left;font-weight:normal;color:var(--dim);padding:.15rem 1.5rem .15rem 0;vertical-align:top;white-space:nowrap}td{padding:.15rem 0}
pre{overflow-x:auto;white-space:pre-wrap;box-shadow:0 0 0 1px var(--line);padding:.6rem;font-size:.85rem}
svg{max-width:44rem;width:100%;font-size:13px}svg text{fill:var(--ink)}.axis{stroke:var(--ink);fill:none}
.before{fill:var(--before);fill-opacity:.25;stroke:var(--before);stroke-dasharray:5 3}.after{fill:var(--after);fill-opacity:.3;stroke:var(--after)}
.mark{position:absolute;left:0;top:0;width:0;height:0;pointer-events:none}.mark::before,.mark::after{content:\"\";position:absolute;background:var(--before)}
.mark::before{left:-12px;top:-1px;width:24px;height:2px}.mark::after{left:-1px;top:-12px;width:2px;height:24px}
.place{font-size:.85rem;display:flex;flex-wrap:wrap;gap:.4rem;align-items:baseline;min-height:2rem}.place output{flex:1 1 14rem;font-variant-numeric:tabular-nums}
.place input{width:7rem}.place button,.place input{font:inherit}.place:not(.kept) button,.place:not(.kept) label{visibility:hidden}
.place output:empty::before{content:\"x,y,z under the pointer; a click keeps it\";color:var(--dim)}
.key{font-weight:bold}.key.b{color:var(--before)}.key.a{color:var(--after)}details{margin-top:2rem}summary{font-size:1.2rem;cursor:pointer}footer{color:var(--dim);margin-top:2rem}
";

/// What the pictures do under the pointer.
const PLACES: &str = include_str!("places.js");

/// The page about a mesh that was read from `input` and written to `output`.
pub fn page(
    story: &Story,
    [input, output]: [&Path; 2],
    comparison: &Comparison<'_>,
    sheet: &Sheet,
) -> Result<String, Failure> {
    let title = format!("{}: {}", story.command, input.display());
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n",
        title = escaped(&title)
    );
    let class = if story.is_good { "outcome good" } else { "outcome" };
    paragraph(&mut out, class, &story.outcome);
    out += "<div class=\"pair\">\n";
    for picture in sheet.pictures()? {
        figure(&mut out, &picture, input, radius(comparison))?;
    }
    out += "</div>\n";
    if !story.advice.is_empty() {
        heading(&mut out, "What to look at next");
        out += "<ul>\n";
        for line in &story.advice {
            let _ = writeln!(out, "<li>{}</li>", escaped(line));
        }
        out += "</ul>\n";
    }
    let _ = writeln!(out, "<details><summary>Numbers</summary>");
    heading(&mut out, "What was asked");
    let _ = writeln!(out, "<pre><code>{}</code></pre>", escaped(&command_line()));
    heading(&mut out, "What was done");
    let files = [("read", input), ("written", output)]
        .map(|(name, path)| (name.to_owned(), path.display().to_string()));
    table(
        &mut out,
        files.iter().chain(&measures(comparison)).chain(&story.facts),
    );
    if let Some(svg) = histogram(comparison) {
        heading(&mut out, "Mean curvature of what has changed");
        out += "<p>Shares of its area, <span class=\"key b\">before (dashed)</span> and <span class=\"key a\">after</span>, in one over \
                the unit of the file; negative where it is convex, seen from the side that the faces turn to. What lies beyond the axis is in \
                the first and the last bar.</p>\n";
        out += &svg;
    }
    heading(&mut out, "The report as it is printed");
    let _ = writeln!(out, "<pre>{}</pre>", escaped(story.printed.trim_end()));
    out += "</details>\n";
    let version = env!("CARGO_PKG_VERSION");
    let _ = writeln!(
        out,
        "<footer>fairmesh {version}</footer>\n<script>\n{PLACES}</script>\n</body>\n</html>"
    );
    Ok(out)
}

/// A picture in which each place can be pointed at.
fn figure(out: &mut String, picture: &Picture, input: &Path, radius: f64) -> Result<(), Failure> {
    let caption = escaped(&picture.caption);
    let alt = escaped(&format!("{}, in {}", picture.caption, input.display()));
    let png = data_uri(&picture.png);
    let Some(places) = &picture.places else {
        let _ = writeln!(
            out,
            "<figure><img src=\"{png}\" alt=\"{alt}\"/><figcaption>{caption}</figcaption></figure>"
        );
        return Ok(());
    };
    let depths = places
        .depths
        .png()
        .map_err(|why| Failure::new(format!("cannot make the picture: {why}")))?;
    let _ = writeln!(
        out,
        "<figure data-camera=\"{}\" data-depths=\"{}\"><img src=\"{png}\" alt=\"{alt}\"/><div class=\"mark\" hidden></div>\
         <figcaption>{caption}</figcaption><div class=\"place\"><output title=\"The place under the pointer: x,y,z as in the file. A click keeps it\">\
         </output> <label>radius <input type=\"number\" min=\"0\" step=\"any\" value=\"{}\"/></label>",
        escaped(&places.camera.to_string()),
        data_uri(&depths),
        significant(radius)
    );
    for (flag, what) in [
        ("ball", "faces in a ball"),
        ("bump", "the bump or dent there"),
        ("geodesic", "as far as the radius along the surface"),
    ] {
        let _ = write!(
            out,
            "<button data-flag=\"{flag}\" title=\"For the command line: {what}\" disabled>Copy as --{flag}</button>"
        );
    }
    out.push_str("</div></figure>\n");
    Ok(())
}

/// A radius to begin with: half of that of what has changed.
fn radius(of: &Comparison<'_>) -> f64 {
    let (surface, marked) = of.changed();
    0.25 * surface.bounds(|t| marked[t]).diagonal()
}

/// What a comparison of both meshes shows.
fn measures(of: &Comparison<'_>) -> Vec<(String, String)> {
    let count = |marked: &[bool]| marked.iter().filter(|&&is| is).count().to_string();
    let mut rows = match of.has_same_triangles() {
        true => vec![("triangles that changed", count(&of.new))],
        false => vec![
            ("triangles that are gone", count(&of.gone)),
            ("triangles that are new", count(&of.new)),
        ],
    };
    if let Some(moved) = &of.moved {
        let farthest = moved.farthest();
        let [x, y, z] = farthest.largest_at.map(significant);
        rows.push((
            "moved at most",
            format!("{} (at {x}, {y}, {z})", significant(farthest.largest)),
        ));
        rows.push((
            "moved on average",
            format!(
                "{} root mean square, {} mean, over the area, from each surface to the nearest point of the other",
                significant(moved.rms()),
                significant(moved.mean())
            ),
        ));
    }
    rows.into_iter()
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}

fn heading(out: &mut String, text: &str) {
    let _ = writeln!(out, "<h2>{}</h2>", escaped(text));
}

fn paragraph(out: &mut String, class: &str, text: &str) {
    let _ = writeln!(out, "<p class=\"{class}\">{}</p>", escaped(text));
}

fn table<'a>(out: &mut String, rows: impl Iterator<Item = &'a (String, String)>) {
    *out += "<table>\n<tbody>\n";
    for (name, value) in rows {
        let _ = writeln!(
            out,
            "<tr><th scope=\"row\">{}</th><td>{}</td></tr>",
            escaped(name),
            escaped(value)
        );
    }
    *out += "</tbody>\n</table>\n";
}
