//! Which creases `fairmesh round` rounds, where numbers of vertices, places or a region say it.

use std::collections::BTreeMap;
use std::path::Path;

use clap::Args;
use fairmesh::{CreaseChain, RoundOptions, find_creases};

use crate::explain;
use crate::failure::Failure;
use crate::formats::MeshFile;
use crate::normals::{dot, sub};
use crate::region::RegionSteps;
use crate::sharp_edges::{MarkedChain, marked_chain};

/// Flags that choose.
#[derive(Debug, Args)]
pub struct CreaseArgs {
    /// Only edges from each of these vertices to the next one are rounded, however little
    /// they bend; may be given several times
    #[arg(long, value_name = "A,B,...", value_parser = marked_chain, verbatim_doc_comment)]
    edges: Vec<MarkedChain>,
    /// Only the crease nearest to this place is rounded, from corner to corner; it begins at
    /// the end that is nearer to there. May be given several times
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true, verbatim_doc_comment)]
    near: Vec<[f64; 3]>,
    #[command(flatten)]
    region: RegionSteps,
}

fn place(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let place = numbers.ok().and_then(|numbers| numbers.try_into().ok());
    place.ok_or_else(|| "expected X,Y,Z, with commas and without blanks".to_owned())
}

impl CreaseArgs {
    /// The edges that are named so; none if nothing is, and all creases are meant. Of a region they are the creases between two of its faces.
    pub fn edges(
        &self,
        mesh: &MeshFile,
        input: &Path,
        options: &RoundOptions,
    ) -> Result<Vec<[u32; 2]>, Failure> {
        let mut edges: Vec<[u32; 2]> = self.edges.iter().flat_map(MarkedChain::edges).collect();
        if self.near.is_empty() && self.region.is_empty() {
            return Ok(edges);
        }
        let geometry = &mesh.geometry;
        let found = find_creases(&geometry.positions, &geometry.triangles, options);
        let (mut chains, angle) = found.map_err(|error| explain::refusal(input, mesh, &error))?;
        chains.retain(|chain| chain.is_rounded);
        if chains.is_empty() {
            return Err(Failure::new(format!(
                "{}: no such edge bends by more than {angle:.3} degrees; --angle says from how many degrees on",
                input.display()
            )));
        }
        for place in &self.near {
            let distance = |chain: &&CreaseChain| distance(&geometry.positions, chain, place);
            let nearest = chains.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
            edges.extend(
                nearest
                    .into_iter()
                    .flat_map(|chain| steps_from(&geometry.positions, chain, place)),
            );
        }
        if !self.region.is_empty() {
            edges.extend(self.in_region(mesh, input, &chains, options)?);
        }
        Ok(edges)
    }

    fn in_region(
        &self,
        mesh: &MeshFile,
        input: &Path,
        chains: &[CreaseChain],
        options: &RoundOptions,
    ) -> Result<Vec<[u32; 2]>, Failure> {
        let geometry = &mesh.geometry;
        let region = self.region.find(mesh, input, None, options.fairing.coincident)?;
        let number = places(&geometry.positions);
        let side = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|v| number[v as usize]);
            [a.min(b), a.max(b)]
        };
        let mut sides: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for t in region.selected.in_triangles(geometry).elements {
            let [a, b, c] = geometry.triangles[t as usize];
            for [a, b] in [[a, b], [b, c], [c, a]] {
                *sides.entry(side(a, b)).or_default() += 1;
            }
        }
        let is_inside = |&[a, b]: &[u32; 2]| sides.get(&side(a, b)).is_some_and(|&count| count > 1);
        let edges: Vec<[u32; 2]> = chains.iter().flat_map(steps).filter(is_inside).collect();
        match edges.is_empty() {
            true => Err(Failure::new(format!(
                "{}: no edge that bends enough lies between two of these faces",
                self.region.told()
            ))),
            false => Ok(edges),
        }
    }
}

/// The edges of a crease.
fn steps(chain: &CreaseChain) -> impl Iterator<Item = [u32; 2]> {
    chain.vertices.windows(2).map(|step| [step[0], step[1]])
}

/// The same, from the end that is nearer to a place.
fn steps_from(positions: &[[f64; 3]], chain: &CreaseChain, place: &[f64; 3]) -> Vec<[u32; 2]> {
    let edges = steps(chain);
    let away = |v: Option<&u32>| {
        let to = v.map(|&v| sub(positions[v as usize], *place));
        to.map(|to| dot(to, to))
    };
    match away(chain.vertices.last()) < away(chain.vertices.first()) {
        true => edges.map(|[a, b]| [b, a]).collect(),
        false => edges.collect(),
    }
}

/// Per vertex the first one at the same place.
fn places(positions: &[[f64; 3]]) -> Vec<u32> {
    let mut first = BTreeMap::new();
    // -0 is where 0 is.
    let bits = |p: &[f64; 3]| p.map(|c| (c + 0.0).to_bits());
    (0..)
        .zip(positions)
        .map(|(v, p)| *first.entry(bits(p)).or_insert(v))
        .collect()
}

/// The squared distance of a crease from a place.
fn distance(positions: &[[f64; 3]], chain: &CreaseChain, place: &[f64; 3]) -> f64 {
    let of_edge = |[a, b]: [u32; 2]| {
        let [a, b] = [a, b].map(|v| positions[v as usize]);
        let (along, away) = (sub(b, a), sub(*place, a));
        let part = (dot(away, along) / dot(along, along)).clamp(0.0, 1.0);
        let rest = [0, 1, 2].map(|k| away[k] - part * along[k]);
        dot(rest, rest)
    };
    steps(chain).map(of_edge).fold(f64::INFINITY, f64::min)
}
