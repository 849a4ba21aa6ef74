//! What results hold, and how it is read out of them.

use super::report;
use super::status::{CallResult, Failure, fairmesh_status as Status};
use super::types::*;
use fairmesh::{BoundaryLoop, Bridged, Carried, Erased, Filled, JoinSuggestion, Parents, Remeshed};
use fairmesh::{LoopReport, Report, Roughness, SelectedRegion, Solution, Trimmed};

/// How many, and which by its number.
type Numbered<'a, T> = (usize, Box<dyn Fn(usize) -> T + 'a>);

/// What a handle of a result stands for. It never changes.
#[allow(clippy::large_enum_variant, reason = "one per handle")]
pub(crate) enum Content {
    Faired(Solution),
    Loops {
        loops: Vec<BoundaryLoop>,
        /// Per loop, where it was asked for; otherwise empty.
        roughness: Vec<Option<Roughness>>,
    },
    Filled {
        filled: Filled,
        vertices: usize,
        triangles: usize,
    },
    Remeshed(Remeshed),
    /// Pairs of intersecting triangles.
    Intersections(Vec<[u32; 2]>),
    Bridged {
        bridged: Bridged,
        vertices: usize,
        triangles: usize,
    },
    Joins(Vec<JoinSuggestion>),
    Erased {
        erased: Erased,
        vertices: usize,
    },
    Trimmed {
        trimmed: Trimmed,
        vertices: usize,
        triangles: usize,
    },
    /// Per point its place on a triangle.
    Carried(Vec<Option<Carried>>),
    /// Per triangle the number of its component.
    Components {
        of: Vec<u32>,
        vertices: usize,
    },
    Region {
        region: SelectedRegion,
        vertices: usize,
    },
}

fn not_available(what: &str) -> Failure {
    Failure::new(Status::NotAvailable, format_args!("this result has no {what}"))
}

/// The entry of a list, if there is one.
fn entry<'a, T>(list: &'a [T], index: u64, what: &str) -> CallResult<&'a T> {
    usize::try_from(index)
        .ok()
        .and_then(|k| list.get(k))
        .ok_or_else(|| {
            let why = format_args!("there is no {what} {index}: there are {}", list.len());
            Failure::new(Status::NotAvailable, why)
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

impl Content {
    pub(crate) fn info(&self) -> fairmesh_info {
        let mut info = fairmesh_info {
            struct_size: size_of::<fairmesh_info>() as u32,
            kind: fairmesh_result_kind::Faired as u32,
            vertex_count: 0,
            triangle_count: 0,
            new_vertex_count: 0,
            new_triangle_count: 0,
            loop_count: 0,
            boundary_vertex_count: 0,
            dropped_count: 0,
            component_count: 0,
            cleaned_count: 0,
            dropped_area: 0.0,
        };
        match self {
            Self::Faired(solution) => {
                info.vertex_count = solution.positions.len() as u64;
                info.boundary_vertex_count = solution.boundary_normals.len() as u64;
            }
            Self::Loops { loops, .. } => {
                info.kind = fairmesh_result_kind::Loops as u32;
                info.loop_count = loops.len() as u64;
            }
            Self::Filled {
                filled,
                vertices,
                triangles,
            } => {
                info.kind = fairmesh_result_kind::Filled as u32;
                info.vertex_count = filled.positions.len() as u64;
                info.triangle_count = filled.triangles.len() as u64;
                info.new_vertex_count = (filled.positions.len() - vertices) as u64;
                info.new_triangle_count = (filled.triangles.len() - triangles) as u64;
                info.loop_count = filled.loops.len() as u64;
            }
            Self::Bridged {
                bridged,
                vertices,
                triangles,
            } => {
                info.kind = fairmesh_result_kind::Bridged as u32;
                info.vertex_count = bridged.positions.len() as u64;
                info.triangle_count = bridged.triangles.len() as u64;
                info.new_vertex_count = (bridged.positions.len() - vertices) as u64;
                info.new_triangle_count = (bridged.triangles.len() - triangles) as u64;
                info.loop_count = 1 + bridged.rest.len() as u64;
            }
            Self::Intersections(_) => info.kind = fairmesh_result_kind::Intersections as u32,
            Self::Joins(joins) => {
                info.kind = fairmesh_result_kind::Joins as u32;
                info.loop_count = joins.len() as u64;
            }
            Self::Erased { erased, vertices } => {
                info.kind = fairmesh_result_kind::Erased as u32;
                info.vertex_count = *vertices as u64;
                info.triangle_count = erased.kept.len() as u64;
                info.loop_count = erased.loops.len() as u64;
                info.dropped_count = erased.dropped as u64;
                info.cleaned_count = erased.cleaned as u64;
            }
            Self::Trimmed {
                trimmed,
                vertices,
                triangles,
            } => {
                info.kind = fairmesh_result_kind::Trimmed as u32;
                info.vertex_count = *vertices as u64;
                info.triangle_count = trimmed.kept.len() as u64;
                info.dropped_count = (triangles - trimmed.kept.len()) as u64;
                info.dropped_area = trimmed.area;
            }
            Self::Carried(points) => {
                info.kind = fairmesh_result_kind::Carried as u32;
                info.new_vertex_count = points.len() as u64;
            }
            Self::Components { of, vertices } => {
                info.kind = fairmesh_result_kind::Components as u32;
                info.vertex_count = *vertices as u64;
                info.triangle_count = of.len() as u64;
                info.component_count = of.iter().max().map_or(0, |last| u64::from(*last) + 1);
            }
            Self::Region { region, vertices } => {
                info.kind = fairmesh_result_kind::Region as u32;
                info.vertex_count = *vertices as u64;
                info.triangle_count = region.triangles.len() as u64;
            }
            Self::Remeshed(mesh) => {
                info.kind = fairmesh_result_kind::Remeshed as u32;
                info.vertex_count = mesh.positions.len() as u64;
                info.triangle_count = mesh.triangles.len() as u64;
                info.new_vertex_count = (mesh.positions.len() - mesh.kept_vertices.len()) as u64;
                info.new_triangle_count = (mesh.triangles.len() - mesh.kept_triangles.len()) as u64;
            }
        }
        info
    }

    pub(crate) fn report(&self, index: u64) -> CallResult<&Report> {
        match self {
            Self::Faired(solution) => entry(std::slice::from_ref(&solution.report), index, "report"),
            Self::Bridged { bridged, .. } if index == 1 + bridged.rest.len() as u64 => bridged
                .whole
                .as_ref()
                .ok_or_else(|| not_available("report of all that is new together: it was not faired so")),
            Self::Filled { .. } | Self::Bridged { .. } => self
                .patch(index)?
                .fairing
                .as_ref()
                .ok_or_else(|| not_available("report of this loop: it was not faired")),
            _ => Err(not_available("report")),
        }
    }

    pub(crate) fn level(&self, index: u64) -> CallResult<fairmesh_level> {
        let report = self.report(0)?;
        entry(&report.levels, index, "level").map(report::level)
    }

    pub(crate) fn component(&self, index: u64, component: u64) -> CallResult<fairmesh_component> {
        component_of(self.report(index)?, component)
    }

    pub(crate) fn attempt(&self, index: u64, component: u64, attempt: u64) -> CallResult<fairmesh_attempt> {
        attempt_of(self.report(index)?, component, attempt)
    }

    pub(crate) fn continuity(
        &self,
        index: u64,
        component: u64,
        number: u64,
    ) -> CallResult<fairmesh_continuity> {
        continuity_of(self.report(index)?, component, number)
    }

    pub(crate) fn boundary_loop(&self, index: u64) -> CallResult<fairmesh_loop> {
        match self {
            Self::Loops { loops, roughness } => {
                let of = entry(loops, index, "loop")?;
                let rough = roughness.get(index as usize).copied().flatten();
                Ok(report::boundary_loop(of, rough.as_ref()))
            }
            _ => Err(not_available("boundary loops")),
        }
    }

    pub(crate) fn filled_loop(&self, index: u64) -> CallResult<fairmesh_fill_report> {
        self.patch(index).map(report::filled_loop)
    }

    /// What became of a loop; of a bridge first the strip, then the holes beside it.
    fn patch(&self, index: u64) -> CallResult<&LoopReport> {
        match self {
            Self::Filled { filled, .. } => entry(&filled.loops, index, "loop"),
            Self::Bridged { bridged, .. } if index == 0 => Ok(&bridged.strip),
            Self::Bridged { bridged, .. } => entry(&bridged.rest, index - 1, "hole beside the strip"),
            _ => Err(not_available("filled loops")),
        }
    }

    pub(crate) fn bridge(&self) -> CallResult<fairmesh_bridge_report> {
        match self {
            Self::Bridged { bridged, .. } => Ok(report::bridge(bridged)),
            _ => Err(not_available("bridge")),
        }
    }

    pub(crate) fn bump(&self, index: u64) -> CallResult<fairmesh_bump> {
        match self {
            Self::Region { region, .. } => entry(&region.bumps, index, "bump").map(report::bump),
            _ => Err(not_available("bumps")),
        }
    }

    pub(crate) fn suggestion(&self, index: u64) -> CallResult<fairmesh_join_suggestion> {
        match self {
            Self::Joins(joins) => entry(joins, index, "group").map(report::suggestion),
            _ => Err(not_available("groups of loops")),
        }
    }

    pub(crate) fn positions(&self) -> CallResult<&[[f64; 3]]> {
        match self {
            Self::Faired(solution) => Ok(&solution.positions),
            Self::Filled { filled, .. } => Ok(&filled.positions),
            Self::Bridged { bridged, .. } => Ok(&bridged.positions),
            Self::Remeshed(mesh) => Ok(&mesh.positions),
            _ => Err(not_available("positions")),
        }
    }

    pub(crate) fn triangles(&self) -> CallResult<&[[u32; 3]]> {
        match self {
            Self::Filled { filled, .. } => Ok(&filled.triangles),
            Self::Bridged { bridged, .. } => Ok(&bridged.triangles),
            Self::Remeshed(mesh) => Ok(&mesh.triangles),
            _ => Err(not_available("triangles: they are those given")),
        }
    }

    /// Numbers at some vertices, of so many in all.
    pub(crate) fn scalars(&self, which: u32) -> CallResult<(&[(u32, f64)], usize)> {
        let Self::Faired(solution) = self else {
            return Err(not_available("numbers per vertex"));
        };
        let vertices = solution.positions.len();
        match which {
            0 => Ok((&solution.mean_curvature, vertices)),
            1 => Ok((&solution.gaussian_curvature, vertices)),
            _ => Err(unknown(which, "fairmesh_scalars")),
        }
    }

    fn parents(&self) -> CallResult<&[Parents]> {
        match self {
            Self::Filled { filled, .. } => Ok(&filled.parents),
            Self::Bridged { bridged, .. } => Ok(&bridged.parents),
            Self::Remeshed(mesh) => Ok(&mesh.parents),
            _ => Err(not_available("parents")),
        }
    }

    /// Vectors by their number, and how many.
    pub(crate) fn vectors(&self, which: u32) -> CallResult<Numbered<'_, [f64; 3]>> {
        match which {
            0 => match self {
                Self::Faired(solution) => {
                    let normals = &solution.boundary_normals;
                    Ok((normals.len(), Box::new(|k| normals[k].1)))
                }
                _ => Err(not_available("boundary normals")),
            },
            1 => {
                if let Self::Carried(points) = self {
                    let weights = |of: Carried| of.parents.weights;
                    return Ok((
                        points.len(),
                        Box::new(move |k| points[k].map_or([0.0; 3], weights)),
                    ));
                }
                let parents = self.parents()?;
                Ok((parents.len(), Box::new(|k| parents[k].weights)))
            }
            _ => Err(unknown(which, "fairmesh_vectors")),
        }
    }

    /// Indices by their number, and how many.
    pub(crate) fn list(&self, which: u32, index: u64) -> CallResult<Numbered<'_, u32>> {
        fn of(list: &[u32]) -> Numbered<'_, u32> {
            (list.len(), Box::new(|k| list[k]))
        }
        fn of_numbers(list: &[usize]) -> Numbered<'_, u32> {
            (list.len(), Box::new(|k| list[k] as u32))
        }
        fn of_pairs(list: &[[u32; 2]]) -> Numbered<'_, u32> {
            (2 * list.len(), Box::new(|k| list[k / 2][k % 2]))
        }
        match (which, self) {
            (0, _) => self.report(index).map(|r| of(report::poor(r))),
            (1, _) => self.report(index).map(|r| of(&r.quality.flipped)),
            (2, _) => self.report(index).map(|r| of(&r.quality.needles)),
            (3, _) => self.report(index).map(|r| of(&r.suspicious_normals)),
            (5, Self::Filled { .. } | Self::Bridged { .. }) => {
                self.patch(index).map(|l| of_pairs(&l.self_intersections))
            }
            (5, Self::Intersections(pairs)) => Ok(of_pairs(pairs)),
            (5, _) => self.report(index).map(|r| of_pairs(report::intersections(r))),
            (6, _) => self.report(index).map(|r| of(report::creased(r))),
            (16, Self::Faired(solution)) => {
                let normals = &solution.boundary_normals;
                Ok((normals.len(), Box::new(|k| normals[k].0)))
            }
            (32, Self::Loops { loops, .. }) => entry(loops, index, "loop").map(|l| of(&l.vertices)),
            (33, Self::Loops { loops, .. }) => entry(loops, index, "loop").map(|l| of(&l.touching)),
            (48, Self::Filled { .. } | Self::Bridged { .. }) => self.patch(index).map(|l| of(&l.outside)),
            (49, Self::Carried(points)) => {
                let corner = |of: Carried, k: usize| of.parents.vertices[k];
                let parent = move |k: usize| points[k / 3].map_or(u32::MAX, |of| corner(of, k % 3));
                Ok((3 * points.len(), Box::new(parent)))
            }
            (49, _) => {
                let parents = self.parents()?;
                Ok((3 * parents.len(), Box::new(|k| parents[k / 3].vertices[k % 3])))
            }
            (50, Self::Filled { .. } | Self::Bridged { .. }) => {
                self.patch(index).map(|l| of_numbers(&l.loops))
            }
            (50, Self::Joins(joins)) => entry(joins, index, "group").map(|join| of_numbers(&join.loops)),
            (64, Self::Remeshed(mesh)) => Ok(of(&mesh.free)),
            (65, Self::Remeshed(mesh)) => Ok(of(&mesh.kept_vertices)),
            (66, Self::Remeshed(mesh)) => Ok(of(&mesh.kept_triangles)),
            (66, Self::Erased { erased, .. }) => Ok(of(&erased.kept)),
            (66, Self::Trimmed { trimmed, .. }) => Ok(of(&trimmed.kept)),
            (80, Self::Erased { erased, .. }) => Ok(of_numbers(&erased.loops)),
            (112, Self::Bridged { bridged, .. }) => entry(&bridged.chains, index, "chain").map(|c| of(c)),
            (113, Self::Bridged { bridged, .. }) => entry(&bridged.sides, index, "side").map(|s| of(s)),
            (128, Self::Carried(points)) => Ok((
                points.len(),
                Box::new(|k| points[k].map_or(u32::MAX, |of| of.triangle)),
            )),
            (96, Self::Components { of: list, .. }) => Ok(of(list)),
            (144, Self::Region { region, .. }) => Ok(of(&region.triangles)),
            (145, Self::Region { region, .. }) => Ok(of_numbers(&region.counts)),
            (16 | 32 | 33 | 48 | 50 | 64..=66 | 80 | 96 | 112 | 113 | 128 | 144 | 145, _) => {
                Err(not_available("such list"))
            }
            _ => Err(unknown(which, "fairmesh_list")),
        }
    }
}

fn unknown(which: u32, of: &str) -> Failure {
    super::views::Argument(2)
        .itself()
        .refuse(Status::BadEnum, format_args!("{which} is no {of}"))
}
