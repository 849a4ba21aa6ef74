//! How far meshes are from the first one, both ways: for colours, as a table and as JSON.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use fairmesh::{DistanceTo, SurfaceDistance};
use serde_json::{Value, json};

use crate::explain;
use crate::failure::Failure;
use crate::figures::significant;
use crate::formats::Geometry;
use crate::picture::Refined;

/// Points that are painted are no farther apart, in diagonals.
const SPACING: f64 = 1.0 / 150.0;

/// A mesh against the first one.
pub struct Distances<'a> {
    first: &'a Path,
    other: &'a Path,
    /// Of the first one.
    diagonal: f64,
    /// Of the other one from the first.
    pub there: SurfaceDistance,
    /// The other one, with the vertices that `there` is of: enough to paint it by.
    pub painted: Refined,
    /// Of the first one from the other.
    back: SurfaceDistance,
}

/// Measures all meshes behind the first against it.
pub fn measured<'a>(paths: &'a [PathBuf], meshes: &[&Geometry]) -> Result<Vec<Distances<'a>>, Failure> {
    if meshes.len() < 2 {
        return Err(Failure::new(
            "--shade distance: one mesh has nothing to be measured against; name the other one, too",
        ));
    }
    let refused = |path: &Path, error| explain::plain_refusal(path.display(), &error);
    let surface = |k: usize| {
        DistanceTo::new(&meshes[k].positions, &meshes[k].triangles).map_err(|e| refused(&paths[k], e))
    };
    let first = surface(0)?;
    (1..meshes.len())
        .map(|k| {
            // First, as its errors name vertices of the file.
            let surface = surface(k)?;
            let other = meshes[k];
            let longest = other.bounds().diagonal() * SPACING;
            let painted = Refined::new(&other.positions, &other.triangles, |_| true, longest);
            let there =
                (first.of(&painted.positions, &painted.triangles)).map_err(|e| refused(&paths[k], e))?;
            Ok(Distances {
                first: &paths[0],
                other: &paths[k],
                diagonal: meshes[0].bounds().diagonal(),
                there,
                back: surface
                    .of(&meshes[0].positions, &meshes[0].triangles)
                    .map_err(|e| refused(&paths[0], e))?,
                painted,
            })
        })
        .collect()
}

impl Distances<'_> {
    /// Lines for people.
    pub fn readable(&self) -> String {
        let [first, other] = [self.first.display(), self.other.display()];
        let mut text = format!("{other} against {first}:\n");
        let mut row = |name: &str, cells: [String; 5]| {
            let [a, b, c, d, e] = cells;
            let line = format!("  {name:<24} {a:>10} {b:>10} {c:>10} {d:>12}  {e}");
            text += line.trim_end();
            text.push('\n');
        };
        row(
            "distance",
            ["largest", "rms", "mean", "of diagonal", "largest at"].map(str::to_owned),
        );
        let ways = [
            ("to the first mesh", &self.there),
            ("from the first mesh", &self.back),
        ];
        for (name, found) in ways {
            let at = found.largest_at.map(significant).join(", ");
            row(
                name,
                [
                    significant(found.largest),
                    significant(found.rms),
                    significant(found.mean),
                    format!("{} %", significant(100.0 * found.largest / self.diagonal)),
                    at,
                ],
            );
        }
        let largest = self.there.largest.max(self.back.largest);
        row(
            "both ways",
            [
                significant(largest),
                significant(self.there.rms.hypot(self.back.rms) / 2f64.sqrt()),
                significant(0.5 * (self.there.mean + self.back.mean)),
                format!("{} %", significant(100.0 * largest / self.diagonal)),
                String::new(),
            ],
        );
        let bound = self.there.largest_bound.max(self.back.largest_bound);
        if bound > 1.02 * largest && bound > 1e-9 * self.diagonal {
            let _ = writeln!(
                text,
                "  no point is farther than {}: the largest was not narrowed down further",
                significant(bound)
            );
        }
        text
    }

    /// The same for programs.
    pub fn json(&self) -> Value {
        let way = |found: &SurfaceDistance| {
            json!({ "largest": found.largest, "largest_bound": found.largest_bound, "largest_at": found.largest_at,
                "rms": found.rms, "mean": found.mean })
        };
        json!({ "first": self.first.display().to_string(), "other": self.other.display().to_string(),
            "diagonal": self.diagonal, "to_first": way(&self.there), "from_first": way(&self.back) })
    }
}
