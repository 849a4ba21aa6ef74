//! The options of the C interface. Made of the library's schemas by src/declarations: do not edit.

use std::ffi::c_void;

use super::callback::fairmesh_progress_fn;
use super::choices::{chosen, count};
use super::loop_choice::{fairmesh_join, fairmesh_loop_filter};
use super::status::CallResult;
use super::types::*;
use super::views::{Argument, Array, FieldPath, field, field_named, indices_in};
use fairmesh::{
    BridgeOptions, Cap, Creases, Discretization, FillOptions, InnerFairness, InteriorNormals, Intersections, OnFailure, Options, OutputPrecision,
    RemeshOptions, Rim, RoundOptions,
};

/// The value of the option `sharp` at which only edges that are certain go on, in degrees.
pub const FAIRMESH_SHARP_AUTO: f64 = 20.0;

/// The value of the option `continuity` at which curvature is continued where it is certain.
pub const FAIRMESH_CONTINUITY_AUTO: f64 = -1.0;

/// The value of the option `relax_rim` at which as many rings may move as are advised.
pub const FAIRMESH_RELAX_AUTO: u64 = 4294967295;

/// The lists of `Options`, checked.
pub(crate) type OptionsLists = [Array; 1];

/// What is asked. Fill it by `fairmesh_options_init`, then change fields: every default exists once, in the library.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_options {
    /// `sizeof(fairmesh_options)`.
    pub struct_size: u32,
    /// A `fairmesh_interior_normals`: normals of fixed vertices inside the region that have none given. Default: the surface passes smoothly.
    pub interior_normals: u32,
    /// A `fairmesh_inner_fairness`: how vertices are distributed within the surface. Default: uniform; where nothing leads to a sound surface so, as conformal (`fallback_weights` of the report counts such vertices).
    pub inner_fairness: u32,
    /// A `fairmesh_discretization`: how normals and mean curvature are discretized. Default: second order.
    pub discretization: u32,
    /// A `fairmesh_output_precision`: the precision of what the result will be written in; moved positions are rounded to it, and the report is of the rounded surface. Default: double.
    pub output_precision: u32,
    /// Worker threads, at most 1024; 0 (default): as many as the machine has. Any number gives the same bits.
    pub threads: u32,
    /// A `fairmesh_intersections`: whether the final surface is checked for self-intersections. Default: it is; that takes about a tenth of the run, at most a fifth.
    pub intersections: u32,
    /// Zero.
    pub reserved: u32,
    /// Normals at the boundary vertices. Default: fitted to the surroundings.
    pub boundary_normals: fairmesh_boundary_normals,
    /// How far the surface continues the mean curvature of its surroundings: from 0 (tangent planes alone, G1) to 1 (curvature, too, G2), part of the way between those surfaces, where `Delta_B^2 H = 0`. Only as far as the surroundings are smooth enough to tell their curvature; the report says how far. Default auto, -1: 1 along loops where the curvature is certain, 0 along others. For the fast solver. Auto is 0 with the paper's, for another target, while rounding, and along loops with given normals or moved by edits that have no given curvature.
    pub continuity: f64,
    /// The same for single boundary loops, each named by a vertex on it, in place of `continuity`. Of several numbers for one loop the last one holds. A loop with 0 has tangent planes alone, and `Delta_B H` is zero along it. Default: none.
    pub loop_continuity: fairmesh_loop_continuity,
    /// Where that curvature comes from. Default: fitted to the surroundings.
    pub boundary_curvature: fairmesh_boundary_curvature,
    /// What `Delta_B H` has to be. Default: zero.
    pub target: fairmesh_target,
    /// Stop when the step norm (rms normal step + rms tangential step, over the diagonal of the component's bounding box) is below this. Default 1e-8; 1e-6 is enough for interactive use. At least 1e-15, a few roundings, and less than 1. What the mesh allows may be a hundred times that, which the outcome says.
    pub tolerance: f64,
    /// At most this many nonlinear iterations for each component of the region. Default 500. At least 1.
    pub max_iterations: u64,
    /// Edges that are sharp however little they bend, as marked by hand: pairs of vertices. Where they reach the boundary from outside, creases arrive, too, whatever `sharp` is; inside they say which edges are to lie on one that goes on. Default: none. Two indices side by side.
    pub marked_edges: fairmesh_indices,
    /// Called with the progress; may be NULL, the default.
    pub progress: fairmesh_progress_fn,
    /// Handed to `progress`.
    pub user_data: *mut c_void,
    /// Creases of the surroundings of at least so many degrees that reach the boundary go on through the region, if another one fits there: vertices are placed along them, and each side is a surface of its own. Default auto: those that are certain. 0: none. Not for fairing in steps.
    pub sharp: f64,
}

impl fairmesh_options {
    /// The library's defaults.
    pub(crate) fn standard() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            interior_normals: fairmesh_interior_normals::Smooth as u32,
            inner_fairness: fairmesh_inner_fairness::Uniform as u32,
            discretization: fairmesh_discretization::SecondOrder as u32,
            output_precision: fairmesh_output_precision::Double as u32,
            threads: 0,
            intersections: fairmesh_intersections::Check as u32,
            reserved: 0,
            boundary_normals: fairmesh_boundary_normals::default(),
            continuity: -1.0,
            loop_continuity: fairmesh_loop_continuity::default(),
            boundary_curvature: fairmesh_boundary_curvature::default(),
            target: fairmesh_target::default(),
            tolerance: 1e-8,
            max_iterations: 500,
            marked_edges: fairmesh_indices::default(),
            progress: None,
            user_data: core::ptr::null_mut(),
            sharp: 20.0,
        }
    }

    /// Where an option is in this argument.
    pub(crate) fn place(argument: Argument, option: &str) -> Option<FieldPath> {
        field_named!(argument, option, Self: interior_normals inner_fairness discretization output_precision threads intersections boundary_normals continuity loop_continuity boundary_curvature target tolerance max_iterations marked_edges progress user_data sharp)
    }

    /// What needs no arrays and has no values of its own; all else as it is by default.
    pub(crate) fn read_options(&self, argument: Argument) -> CallResult<Options> {
        Ok(Options {
            interior_normals: chosen(InteriorNormals::from_number(self.interior_normals), self.interior_normals, "fairmesh_interior_normals", field!(argument, Self.interior_normals))?,
            continuity: self.continuity,
            inner_fairness: chosen(InnerFairness::from_number(self.inner_fairness), self.inner_fairness, "fairmesh_inner_fairness", field!(argument, Self.inner_fairness))?,
            discretization: chosen(Discretization::from_number(self.discretization), self.discretization, "fairmesh_discretization", field!(argument, Self.discretization))?,
            tolerance: self.tolerance,
            max_iterations: count(self.max_iterations),
            output_precision: chosen(OutputPrecision::from_number(self.output_precision), self.output_precision, "fairmesh_output_precision", field!(argument, Self.output_precision))?,
            threads: self.threads as usize,
            intersections: chosen(Intersections::from_number(self.intersections), self.intersections, "fairmesh_intersections", field!(argument, Self.intersections))?,
            sharp: self.sharp,
            ..Options::default()
        })
    }

    /// The lists of indices, checked and not read.
    pub(crate) fn lists(&self, argument: Argument) -> CallResult<OptionsLists> {
        Ok([
            indices_in(&self.marked_edges, 2, field!(argument, Self.marked_edges))?,
        ])
    }

    /// Reads them.
    pub(crate) fn read_lists(lists: &OptionsLists, into: &mut Options) -> CallResult {
        into.marked_edges = lists[0].rows::<2>()?.into_owned();
        Ok(())
    }
}

/// The lists of `FillOptions`, checked.
pub(crate) type FillOptionsLists = [Array; 1];

/// What hole filling does. Fill it by `fairmesh_fill_options_init`. How patches are faired is in a `fairmesh_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_fill_options {
    /// `sizeof(fairmesh_fill_options)`.
    pub struct_size: u32,
    /// A `fairmesh_on_failure`: what a loop gets whose patch is no success. Default: the best surface there is.
    pub on_failure: u32,
    /// Not 0: the patches are faired. Default: yes.
    pub fair: u32,
    /// Not 0: the loops of the list `loops` only, also where it is empty: then nothing is filled but groups of loops that are joined.
    pub only_listed: u32,
    /// Which of them get one patch together. Default: none.
    pub join: fairmesh_join,
    /// Pairs of vertices of the boundary that the triangulation shall have an edge between, before it is refined. On one loop a guide divides what is triangulated, as across a long tear; between two loops that are joined it is where their patch is cut open. No vertex is in two of them. The patch is faired as a whole: it has no crease there. Default: none. Two indices side by side.
    pub guides: fairmesh_indices,
    /// How dense the new vertices are, Liepa's factor as in CGAL: at the default, the square root of 2, edges are as long as those of the mesh beside the boundary; at twice that, half as long, away from the boundary, whose edges stay. Between 0.1 and 10.
    pub density: f64,
    /// At most this many new vertices in all. Where they do not suffice, patches become coarser away from their boundaries. Smaller loops are served first. Default 200000. No loop of n edges gets more than 1000 + n^2 of them, times the square of a density above 1: a round hole takes a tenth.
    pub max_new_vertices: u64,
    /// For boundaries that are noise: this many rings of vertices around a loop, its own counted, may move onto the surface that the mesh has there on average, before it is filled. 0 (default): none. 4294967295 (auto): as many as are advised around loops that are rough, none around others, nor where triangles would be folded or intersect.
    pub relax_rim: u64,
    /// No vertex of these rings moves further than this. Default: the mean length of the edges around the loop. 0 stands for the default.
    pub relax_within: f64,
    /// Holes of more edges stay open. Default: UINT64_MAX.
    pub max_edges: u64,
    /// These loops only, as `fairmesh_boundary_loops` numbers them, outer boundaries included; NULL with count 0 (default): all holes. With a count, `max_edges` and `filter` are not read.
    pub loops: fairmesh_indices,
    /// Which holes, if `loops` does not say it. All zero (default): all of them.
    pub filter: fairmesh_loop_filter,
    /// A `fairmesh_cap`: what closes a loop that lies in a plane, to a thousandth of its diagonal, as where a part was cut off. Default: a fair patch.
    pub cap: u32,
    /// Zero.
    pub reserved: u32,
}

impl fairmesh_fill_options {
    /// The library's defaults.
    pub(crate) fn standard() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            on_failure: fairmesh_on_failure::Best as u32,
            fair: 1,
            only_listed: 0,
            join: fairmesh_join::default(),
            guides: fairmesh_indices::default(),
            density: 1.4142135623730951,
            max_new_vertices: 200000,
            relax_rim: 0,
            relax_within: 0.0,
            max_edges: u64::MAX,
            loops: fairmesh_indices::default(),
            filter: fairmesh_loop_filter::default(),
            cap: fairmesh_cap::Fair as u32,
            reserved: 0,
        }
    }

    /// Where an option is in this argument.
    pub(crate) fn place(argument: Argument, option: &str) -> Option<FieldPath> {
        field_named!(argument, option, Self: on_failure fair only_listed join guides density max_new_vertices relax_rim relax_within max_edges loops filter cap)
    }

    /// What needs no arrays and has no values of its own; all else as it is by default.
    pub(crate) fn read_fill_options(&self, argument: Argument) -> CallResult<FillOptions> {
        Ok(FillOptions {
            density: self.density,
            max_new_vertices: count(self.max_new_vertices),
            on_failure: chosen(OnFailure::from_number(self.on_failure), self.on_failure, "fairmesh_on_failure", field!(argument, Self.on_failure))?,
            cap: chosen(Cap::from_number(self.cap), self.cap, "fairmesh_cap", field!(argument, Self.cap))?,
            fair: self.fair != 0,
            ..FillOptions::default()
        })
    }

    /// The lists of indices, checked and not read.
    pub(crate) fn lists(&self, argument: Argument) -> CallResult<FillOptionsLists> {
        Ok([
            indices_in(&self.guides, 2, field!(argument, Self.guides))?,
        ])
    }

    /// Reads them.
    pub(crate) fn read_lists(lists: &FillOptionsLists, into: &mut FillOptions) -> CallResult {
        into.guides = lists[0].rows::<2>()?.into_owned();
        Ok(())
    }

    /// What needs no arrays and has no values of its own; all else as it is by default.
    pub(crate) fn read_rim(&self, _: Argument) -> CallResult<Rim> {
        Ok(Rim {
            relax: count(self.relax_rim),
            within: (self.relax_within != 0.0).then_some(self.relax_within),
            ..Rim::default()
        })
    }
}

/// What a bridge shall be. Fill it by `fairmesh_bridge_options_init`. How dense it is, and what becomes of one that is not fair, is in a `fairmesh_fill_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_bridge_options {
    /// `sizeof(fairmesh_bridge_options)`.
    pub struct_size: u32,
    /// Not 0: holes that the strip leaves beside it are filled, and all new vertices, the strip's included, faired together. Default: no.
    pub fill: u32,
    /// How long the chains shall be: each is made longer or shorter about its middle along its loop, to the vertices where that is met best. Default: they are as given. 0 stands for the default.
    pub width: f64,
}

impl fairmesh_bridge_options {
    /// The library's defaults.
    pub(crate) fn standard() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            fill: 0,
            width: 0.0,
        }
    }

    /// Where an option is in this argument.
    pub(crate) fn place(argument: Argument, option: &str) -> Option<FieldPath> {
        field_named!(argument, option, Self: fill width)
    }

    /// What needs no arrays and has no values of its own; all else as it is by default.
    pub(crate) fn read_bridge_options(&self, _: Argument) -> CallResult<BridgeOptions> {
        Ok(BridgeOptions {
            width: (self.width != 0.0).then_some(self.width),
            fill: self.fill != 0,
            ..BridgeOptions::default()
        })
    }
}

/// The lists of `RoundOptions`, checked.
pub(crate) type RoundOptionsLists = [Array; 2];

/// What rounding does. Fill it by `fairmesh_round_options_init`; then set `width` or `radius`. How blends are faired is in a `fairmesh_options`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_round_options {
    /// `sizeof(fairmesh_round_options)`.
    pub struct_size: u32,
    /// A `fairmesh_creases`: which creases are rounded. Default: all.
    pub creases: u32,
    /// How far from a crease its blend reaches, along the surface on both sides. 0 (default): `radius` says it.
    pub width: f64,
    /// The radius of the ball that touches both sides where the blend begins, in place of `width`. 0 (default): the width holds.
    pub radius: f64,
    /// How many times as far as at its beginning the blend of a chain that is not closed reaches at its end; in between that changes evenly. A chain begins with the first of its `edges`, as it is named; else at the end whose vertex has the smaller number. 1 (default): everywhere alike.
    pub taper: f64,
    /// Edges that bend by more than so many degrees are creases. 0 (default): the widest gap between the bends of the mesh tells.
    pub angle: f64,
    /// Edges that are rounded, and no others: pairs of vertices; they are creases however little they bend. Default: none, all creases are. Two indices side by side.
    pub edges: fairmesh_indices,
    /// Blends that would have more vertices than about so many are refused: a slip of the width, most likely. Default 1000000.
    pub max_blend_vertices: u64,
    /// Labels of all triangles, one for each, as the numbers of their materials: lines between labels stay where they are, inside flat faces, too. Default: none, all have the same.
    pub labels: fairmesh_indices,
}

impl fairmesh_round_options {
    /// The library's defaults.
    pub(crate) fn standard() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            creases: fairmesh_creases::All as u32,
            width: 0.0,
            radius: 0.0,
            taper: 1.0,
            angle: 0.0,
            edges: fairmesh_indices::default(),
            max_blend_vertices: 1000000,
            labels: fairmesh_indices::default(),
        }
    }

    /// Where an option is in this argument.
    pub(crate) fn place(argument: Argument, option: &str) -> Option<FieldPath> {
        field_named!(argument, option, Self: creases width radius taper angle edges max_blend_vertices labels)
    }

    /// What needs no arrays and has no values of its own; all else as it is by default.
    pub(crate) fn read_round_options(&self, argument: Argument) -> CallResult<RoundOptions> {
        Ok(RoundOptions {
            width: self.width,
            radius: self.radius,
            taper: self.taper,
            angle: self.angle,
            creases: chosen(Creases::from_number(self.creases), self.creases, "fairmesh_creases", field!(argument, Self.creases))?,
            max_blend_vertices: count(self.max_blend_vertices),
            ..RoundOptions::default()
        })
    }

    /// The lists of indices, checked and not read.
    pub(crate) fn lists(&self, argument: Argument) -> CallResult<RoundOptionsLists> {
        Ok([
            indices_in(&self.edges, 2, field!(argument, Self.edges))?,
            indices_in(&self.labels, 1, field!(argument, Self.labels))?,
        ])
    }

    /// Reads them.
    pub(crate) fn read_lists(lists: &RoundOptionsLists, into: &mut RoundOptions) -> CallResult {
        into.edges = lists[0].rows::<2>()?.into_owned();
        into.labels = lists[1].list()?.into_owned();
        Ok(())
    }
}

/// What remeshing does. Fill it by `fairmesh_remesh_options_init`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fairmesh_remesh_options {
    /// `sizeof(fairmesh_remesh_options)`.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// How dense the vertices are, as in hole filling: at the default, the square root of 2, edges are as long as those beside the region; at twice that, half as long, away from the boundary, whose edges stay. Between 0.1 and 10.
    pub density: f64,
    /// At most this many vertices inside the region. Default 200000.
    pub max_vertices: u64,
    /// Called with the progress; may be NULL, the default. Where it stops the call, the status is CANCELLED.
    pub progress: fairmesh_progress_fn,
    /// Handed to `progress`.
    pub user_data: *mut c_void,
}

impl fairmesh_remesh_options {
    /// The library's defaults.
    pub(crate) fn standard() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            reserved: 0,
            density: 1.4142135623730951,
            max_vertices: 200000,
            progress: None,
            user_data: core::ptr::null_mut(),
        }
    }

    /// Where an option is in this argument.
    pub(crate) fn place(argument: Argument, option: &str) -> Option<FieldPath> {
        field_named!(argument, option, Self: density max_vertices progress user_data)
    }

    /// What needs no arrays and has no values of its own; all else as it is by default.
    pub(crate) fn read_remesh_options(&self, _: Argument) -> CallResult<RemeshOptions> {
        Ok(RemeshOptions {
            density: self.density,
            max_vertices: count(self.max_vertices),
            ..RemeshOptions::default()
        })
    }
}
