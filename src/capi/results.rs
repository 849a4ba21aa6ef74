//! What results hold, and how it is read out of them.

use std::borrow::Cow;

use super::report;
use super::status::{CallResult, Failure, fairmesh_status as Status};
use super::structs::refuse;
use super::types::*;
use fairmesh::{LoopReport, Parents, Remeshed, Report, Solution};

use fairmesh_list as List;

/// Lists of a kind in a result.
pub(crate) enum Lists {
    /// One, whatever its index.
    One(Vec<u32>),
    /// One for each of several things, which are called so.
    Each(&'static str, Vec<Vec<u32>>),
}

/// What a handle of a result stands for. It never changes. What a result does not have is none, or empty.
#[derive(Default)]
pub(crate) struct Content {
    pub info: fairmesh_info,
    pub positions: Option<Vec<[f64; 3]>>,
    pub triangles: Option<Vec<[u32; 3]>>,
    /// Mean and Gaussian curvature at free vertices.
    pub curvatures: Option<[Vec<(u32, f64)>; 2]>,
    pub vectors: Option<(fairmesh_vectors, Vec<[f64; 3]>)>,
    /// All but those that stand in reports.
    pub lists: Vec<(List, Lists)>,
    /// What became of the fairing, or what there is none of.
    pub reports: Vec<Result<Report, &'static str>>,
    pub loops: Vec<fairmesh_loop>,
    pub fill_reports: Vec<fairmesh_fill_report>,
    pub suggestions: Vec<fairmesh_join_suggestion>,
    pub bumps: Vec<fairmesh_bump>,
    pub creases: Vec<fairmesh_crease>,
    pub bridge: Option<fairmesh_bridge_report>,
}

/// A result lacks something.
pub(crate) fn not_available(what: &str) -> Failure {
    Failure::new(Status::NotAvailable, format_args!("this result has no {what}"))
}

/// One of several things, which are called so.
pub(crate) fn entry<'a, T>(list: &'a [T], index: u64, what: &str) -> CallResult<&'a T> {
    let found = usize::try_from(index).ok().and_then(|k| list.get(k));
    found.ok_or_else(|| match list.len() {
        0 => not_available(what),
        count => {
            let why = format_args!("there is no {what} {index}: there are {count}");
            Failure::new(Status::NotAvailable, why)
        }
    })
}

/// One component in a report.
pub(crate) fn component_of(report: &Report, component: u64) -> CallResult<fairmesh_component> {
    entry(&report.components, component, "component").map(report::component)
}

/// One attempt at the surface of a component in a report.
pub(crate) fn attempt_of(report: &Report, component: u64, attempt: u64) -> CallResult<fairmesh_attempt> {
    let of = entry(&report.components, component, "component")?;
    entry(&of.attempts, attempt, "attempt").map(report::attempt)
}

/// One boundary loop of a component in a report, whose curvature was to be continued.
pub(crate) fn continuity_of(report: &Report, component: u64, number: u64) -> CallResult<fairmesh_continuity> {
    let of = entry(&report.components, component, "component")?;
    entry(&of.continuity, number, "loop of continuous curvature").map(report::continuity)
}

/// One sharp edge in a report.
pub(crate) fn sharp_edge_of(report: &Report, number: u64) -> CallResult<fairmesh_sharp_edge> {
    entry(&report.sharp_edges, number, "sharp edge")?;
    Ok(report::sharp_edge(&report.sharp_edges, number as usize))
}

/// One of its ends.
pub(crate) fn crease_end_of(report: &Report, edge: u64, number: u64) -> CallResult<fairmesh_crease_end> {
    let of = entry(&report.sharp_edges, edge, "sharp edge")?;
    entry(&of.ends, number, "end of this sharp edge").map(report::crease_end)
}

/// Numbers of loops and the like as entries of a list.
pub(crate) fn as_list(numbers: &[usize]) -> Vec<u32> {
    numbers.iter().map(|n| *n as u32).collect()
}

impl Content {
    /// Of this kind and these sizes.
    pub(crate) fn new(kind: fairmesh_result_kind, sizes: fairmesh_info) -> Self {
        let kind = kind as u32;
        Self {
            info: fairmesh_info {
                kind,
                is_success: 1,
                ..sizes
            },
            ..Self::default()
        }
    }

    /// With whether there is nothing to be said of it.
    pub(crate) fn judged(mut self, is_success: bool) -> Self {
        self.info.is_success = u32::from(is_success);
        self
    }

    /// With a list, whatever index it is asked for with.
    pub(crate) fn one(mut self, which: List, list: Vec<u32>) -> Self {
        self.lists.push((which, Lists::One(list)));
        self
    }

    /// With a list for each of several things, which are called so.
    pub(crate) fn each(mut self, which: List, what: &'static str, lists: Vec<Vec<u32>>) -> Self {
        self.lists.push((which, Lists::Each(what, lists)));
        self
    }

    /// A mesh of which the first so many vertices and triangles are old ones; `parents` are those of the new vertices.
    pub(crate) fn mesh(
        kind: fairmesh_result_kind,
        positions: Vec<[f64; 3]>,
        triangles: Vec<[u32; 3]>,
        parents: &[Parents],
        [vertices, faces]: [usize; 2],
    ) -> Self {
        let sizes = fairmesh_info {
            vertex_count: positions.len() as u64,
            triangle_count: triangles.len() as u64,
            new_vertex_count: (positions.len() - vertices) as u64,
            new_triangle_count: (triangles.len() - faces) as u64,
            ..fairmesh_info::default()
        };
        let weights = parents.iter().map(|of| of.weights).collect();
        let parents = parents.iter().flat_map(|of| of.vertices).collect();
        Self {
            positions: Some(positions),
            triangles: Some(triangles),
            vectors: Some((fairmesh_vectors::ParentWeights, weights)),
            ..Self::new(kind, sizes).one(List::Parents, parents)
        }
    }

    /// With what became of each patch.
    pub(crate) fn with_patches(mut self, patches: Vec<LoopReport>) -> Self {
        self.info.loop_count = patches.len() as u64;
        self.fill_reports = patches.iter().map(report::filled_loop).collect();
        let (mut pairs, mut outside, mut joined) = (Vec::new(), Vec::new(), Vec::new());
        for of in patches {
            joined.push(as_list(&of.loops));
            pairs.push(of.self_intersections.into_flattened());
            outside.push(of.outside);
            let report = of.fairing.ok_or("report of this loop: it was not faired");
            self.reports.push(report);
        }
        self.each(List::Intersections, "filled loop", pairs)
            .each(List::OutsideVertices, "filled loop", outside)
            .each(List::JoinedLoops, "filled loop", joined)
    }

    pub(crate) fn report(&self, index: u64) -> CallResult<&Report> {
        let report = entry(&self.reports, index, "report")?;
        report.as_ref().map_err(|why| not_available(why))
    }

    pub(crate) fn positions(&self) -> CallResult<&[[f64; 3]]> {
        self.positions
            .as_deref()
            .ok_or_else(|| not_available("positions"))
    }

    /// Numbers at some vertices.
    pub(crate) fn scalars(&self, which: u32) -> CallResult<&[(u32, f64)]> {
        let curvatures = self.curvatures.as_ref();
        let curvatures = curvatures.ok_or_else(|| not_available("numbers per vertex"))?;
        let of = curvatures.get(which as usize).map(Vec::as_slice);
        of.ok_or_else(|| unknown(which, "fairmesh_scalars"))
    }

    pub(crate) fn vectors(&self, which: u32) -> CallResult<&[[f64; 3]]> {
        match (which, &self.vectors) {
            (_, Some((kind, vectors))) if *kind as u32 == which => Ok(vectors),
            (0, _) => Err(not_available("boundary normals")),
            (1, _) => Err(not_available("parents")),
            _ => Err(unknown(which, "fairmesh_vectors")),
        }
    }

    pub(crate) fn list(&self, which: u32, index: u64) -> CallResult<Cow<'_, [u32]>> {
        let found = self.lists.iter().find(|(list, _)| *list as u32 == which);
        match found {
            Some((_, Lists::One(list))) => return Ok(list.into()),
            Some((_, Lists::Each(what, lists))) => return entry(lists, index, what).map(Cow::from),
            None => {}
        }
        let of_report: fn(&Report) -> &[u32] = match which {
            0 => report::poor,
            1 => |of| &of.quality.flipped,
            2 => |of| &of.quality.needles,
            3 => |of| &of.suspicious_normals,
            5 => |of| report::intersections(of).as_flattened(),
            6 => report::creased,
            7 => return Ok(report::sharp_vertices(&self.report(index)?.sharp_edges).into()),
            16 | 32 | 33 | 48..=50 | 64..=66 | 80 | 96 | 112 | 113 | 128 | 144 | 145 | 160 | 161 => {
                return Err(not_available("such list"));
            }
            _ => return Err(unknown(which, "fairmesh_list")),
        };
        self.report(index).map(|report| of_report(report).into())
    }
}

impl From<Solution> for Content {
    fn from(of: Solution) -> Self {
        let sizes = fairmesh_info {
            vertex_count: of.positions.len() as u64,
            boundary_vertex_count: of.boundary_normals.len() as u64,
            ..fairmesh_info::default()
        };
        let is_success = of.report.outcome.is_success();
        let (boundary, normals) = of.boundary_normals.into_iter().unzip();
        Self {
            positions: Some(of.positions),
            curvatures: Some([of.mean_curvature, of.gaussian_curvature]),
            vectors: Some((fairmesh_vectors::BoundaryNormals, normals)),
            reports: vec![Ok(of.report)],
            ..Self::new(fairmesh_result_kind::Faired, sizes)
                .judged(is_success)
                .one(List::BoundaryVertices, boundary)
        }
    }
}

impl From<Remeshed> for Content {
    fn from(of: Remeshed) -> Self {
        let kept = [of.kept_vertices.len(), of.kept_triangles.len()];
        let kind = fairmesh_result_kind::Remeshed;
        Self::mesh(kind, of.positions, of.triangles, &of.parents, kept)
            .one(List::FreeVertices, of.free)
            .one(List::KeptVertices, of.kept_vertices)
            .one(List::KeptTriangles, of.kept_triangles)
    }
}

fn unknown(which: u32, of: &str) -> Failure {
    refuse!(super::views::Argument(2).itself() => BadEnum, "{which} is no {of}")
}
