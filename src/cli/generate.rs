//! `fairmesh generate`: the paper's inputs and exact surfaces as mesh files.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use fairmesh_shapes::{HarmonicProfile, OUTSIDE, Sampling, Shape, Surface, revolution_band, torus_patch};

use crate::answer::{say, say_aside};
use crate::failure::Failure;
use crate::formats::pipe_args::PipeArgs;
use crate::formats::pipes::is_piped;
use crate::formats::{self, Format};
use crate::output::Output;

/// What can be generated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ShapeKind {
    /// The paper's blend of three cylinders (Figs. 1, 2): 118, 920 and 13308 vertices exactly
    CylinderBlend,
    /// The paper's tetra thing (Fig. 8): 500 and 13308 vertices exactly
    TetraThing,
    /// A cap of the unit sphere, free within --angle degrees of the pole (60)
    SphereCap,
    /// The unit sphere between 40 degrees south and 50 degrees north
    SphereZone,
    /// The unit sphere but for a hole of --angle degrees half-angle (60)
    SphereHole,
    /// The cylinder of radius 1, free where |z| < 1
    Cylinder,
    /// The catenoid r = cosh z, free where |z| < 0.9
    Catenoid,
    /// An unduloid with neck 0.7 and bulge 1
    Unduloid,
    /// A surface of revolution with harmonic mean curvature that is not constant; with --phi0 or --p its Laplacian is harmonic
    Revolution,
    /// The image of a cap of the unit sphere, free within --angle degrees of the pole (50), on the ellipsoid of --semi-axes
    Ellipsoid,
    /// The outer side of the torus of radii 1 and 0.4, free where both angles are below --angle degrees (57.3)
    Torus,
    /// A wavy saddle over the unit disc; not a solution, the boundary is what matters
    Saddle,
}

/// How the vertices are distributed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Triangulation {
    /// Nearly equilateral triangles
    Regular,
    /// Vertices shaken, dropped and inserted at random: valences from 3 to about 11
    Irregular,
    /// Three times finer in a patch on one side
    Refined,
}

/// Where the free vertices are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Start {
    /// On the exact surface; blend and tetra thing, which have none, begin smooth
    Exact,
    /// On another surface over the same boundary: flat, straight or pinched
    Flat,
    /// As exact, with Gaussian noise of --noise edge lengths
    Noise,
    /// Anywhere in the bounding box
    Random,
}

/// The profile of a revolution: `r' = cos f`, `z' = sin f`, `f' = -2 H - sin f / r`, `H' = q / r`, `q' = r phi`, `phi' = p / r` by its
/// arc length, from `r = 1`, `z = 0`, `q = c` on.
#[derive(Debug, Args)]
struct ProfileArgs {
    /// Of revolution: direction of the profile at its beginning, where the radius
    /// is 1; 0 leads away from the axis, pi/2 along it (1)
    #[arg(
        long,
        value_name = "RADIANS",
        allow_negative_numbers = true,
        verbatim_doc_comment
    )]
    f0: Option<f64>,
    /// Of revolution: mean curvature H at the beginning (-1)
    #[arg(long, value_name = "H", allow_negative_numbers = true)]
    h0: Option<f64>,
    /// Of revolution: radius times dH/ds at the beginning; without --phi0 and --p
    /// the same all along the profile (0.5)
    #[arg(long, value_name = "C", allow_negative_numbers = true, verbatim_doc_comment)]
    c: Option<f64>,
    /// Of revolution: the Laplacian of H at the beginning (0)
    #[arg(long, value_name = "PHI", allow_negative_numbers = true)]
    phi0: Option<f64>,
    /// Of revolution: radius times the derivative of that Laplacian, the same all
    /// along the profile (0)
    #[arg(long, value_name = "P", allow_negative_numbers = true, verbatim_doc_comment)]
    p: Option<f64>,
    /// Of revolution: arc length of the profile (2)
    #[arg(long, value_name = "L")]
    length: Option<f64>,
}

impl ProfileArgs {
    fn is_given(&self) -> bool {
        [self.f0, self.h0, self.c, self.phi0, self.p, self.length]
            .iter()
            .any(Option::is_some)
    }

    /// A band of about `n` free vertices.
    fn band(&self, n: usize, sampling: Sampling, outside: usize) -> Result<Shape, Failure> {
        let [f0, h0] = [self.f0.unwrap_or(1.0), self.h0.unwrap_or(-1.0)];
        let [c, length] = [self.c.unwrap_or(0.5), self.length.unwrap_or(2.0)];
        let [phi0, p] = [self.phi0.unwrap_or(0.0), self.p.unwrap_or(0.0)];
        let profile = HarmonicProfile::biharmonic(f0, h0, c, [phi0, p], length);
        let band = profile.and_then(|profile| revolution_band(&profile, n, sampling, outside));
        band.map_err(|e| {
            let laplacian = if phi0 == 0.0 && p == 0.0 {
                String::new()
            } else {
                format!(" --phi0 {phi0} --p {p}")
            };
            Failure::new(format!(
                "--f0 {f0} --h0 {h0} --c {c}{laplacian} --length {length}: no surface of revolution: {e}"
            ))
        })
    }
}

/// What `fairmesh generate` is asked.
#[derive(Debug, Args)]
pub struct GenerateArgs {
    /// What to make
    #[arg(value_enum)]
    kind: ShapeKind,
    /// Output file: .ply, .obj, .off or .stl, optionally .gz; '-': stdout
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    pipe: PipeArgs,
    /// About how many vertices: all of a blend or tetra thing, the free ones of
    /// the others; 920 for the blend, 500 for the tetra thing, 1000 otherwise
    #[arg(long, value_name = "N", verbatim_doc_comment)]
    vertices: Option<usize>,
    /// How the vertices are distributed
    #[arg(long, value_enum, default_value_t = Triangulation::Regular)]
    triangulation: Triangulation,
    /// Seed of everything random; the same seed gives the same bytes
    #[arg(long, default_value_t = 1, value_name = "S")]
    seed: u64,
    /// Where the free vertices are
    #[arg(long, value_enum, default_value_t = Start::Exact)]
    start: Start,
    /// Deviation of --start noise, in edge lengths
    #[arg(long, default_value_t = 0.15, value_name = "X")]
    noise: f64,
    /// Half-angle of sphere-cap and ellipsoid (1 to 150), sphere-hole (1 to 170; a
    /// small hole is as wide as two and a half edges) and torus (6 to 143), in degrees
    #[arg(long, value_name = "DEGREES", verbatim_doc_comment)]
    angle: Option<f64>,
    /// Of ellipsoid, each from 0.1 to 10 (1,0.8,0.6)
    #[arg(long, value_name = "A,B,C", value_delimiter = ',')]
    semi_axes: Option<Vec<f64>>,
    #[command(flatten)]
    profile: ProfileArgs,
    /// Rings of fixed triangles around the free region, at most 16; blend and
    /// tetra thing have none
    #[arg(long, default_value_t = OUTSIDE, value_name = "N", verbatim_doc_comment)]
    outside: usize,
    /// Add a bump of this height at a place, along the exact normals; a dent if it is
    /// negative. May be repeated; --exact is without
    #[arg(long, value_name = "X,Y,Z,RADIUS,HEIGHT", value_parser = spoiling::<5>, allow_hyphen_values = true, verbatim_doc_comment)]
    raise: Vec<[f64; 5]>,
    /// Cut out the triangles that lie entirely in a ball; may be repeated
    #[arg(long, value_name = "X,Y,Z,RADIUS", value_parser = spoiling::<4>, allow_hyphen_values = true)]
    cut: Vec<[f64; 4]>,
    /// Also write the free vertices, one number per line, for 'fair --free'
    #[arg(long, value_name = "FILE")]
    free: Option<PathBuf>,
    /// Also write the exact boundary normals, for 'fair --normals'
    #[arg(long, value_name = "FILE")]
    normals: Option<PathBuf>,
    /// No summary; errors are still printed
    #[arg(short, long)]
    quiet: bool,
    /// Also write the same mesh with all vertices on the exact surface
    #[arg(long, value_name = "FILE")]
    exact: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &GenerateArgs) -> Result<bool, Failure> {
    check(args)?;
    let shape = cut(make(args)?, &args.cut)?;
    if args.exact.is_some() && shape.surface.is_none() {
        return Err(Failure::new(
            "--exact: there is no exact surface of this kind; its start is smooth, the result is what 'fair' finds",
        ));
    }
    if !args.raise.is_empty() && shape.surface.is_none() {
        return Err(Failure::new("--raise: there are no exact normals of this kind"));
    }
    let mut positions = match args.start {
        Start::Exact => shape.positions.clone(),
        Start::Flat => shape.flat(),
        Start::Noise => shape.noise(args.seed, args.noise),
        Start::Random => shape.random(args.seed),
    };
    for &[x, y, z, radius, height] in &args.raise {
        shape.raise(&mut positions, [x, y, z], radius, height);
    }
    // All names are checked before anything is written.
    let format = Format::of(&args.output, args.pipe.of(&[&args.output])?)?;
    let mut files = vec![(
        Output::prepare_or_stdout(&args.output)?,
        formats::plain(format, &positions, &shape.triangles),
    )];
    if let Some(path) = &args.exact {
        let bytes = formats::plain(Format::of(path, None)?, &shape.positions, &shape.triangles);
        files.push((Output::prepare(path)?, bytes));
    }
    if let Some(path) = &args.free {
        files.push((Output::prepare(path)?, free_list(&shape)));
    }
    if let Some(path) = &args.normals {
        files.push((Output::prepare(path)?, normal_list(&shape)));
    }
    for (output, bytes) in &files {
        output.write(bytes)?;
    }
    let paths = [
        Some(&args.output),
        args.exact.as_ref(),
        args.free.as_ref(),
        args.normals.as_ref(),
    ];
    let written: Vec<&Path> = paths.into_iter().flatten().map(PathBuf::as_path).collect();
    let tell = if is_piped(&args.output) { say_aside } else { say };
    if !args.quiet {
        tell(&summary(args, &shape), &written)?;
    }
    Ok(true)
}

/// The shape without what the balls hold.
fn cut(shape: Shape, balls: &[[f64; 4]]) -> Result<Shape, Failure> {
    let mut rest = shape;
    for &[x, y, z, radius] in balls {
        rest = rest.cut([x, y, z], radius);
    }
    if rest.triangles.is_empty() {
        return Err(Failure::new("--cut: nothing is left"));
    }
    Ok(rest)
}

/// Reads a value of `--raise` or `--cut`: a place, a radius, and what else there is.
fn spoiling<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let numbers = numbers.ok().filter(|n| n.iter().all(|x: &f64| x.is_finite()));
    let numbers: Option<[f64; N]> = numbers.and_then(|numbers| numbers.try_into().ok());
    let numbers = numbers.ok_or_else(|| format!("expected {N} numbers with commas between"))?;
    if numbers[3] > 0.0 {
        Ok(numbers)
    } else {
        Err(format!("the radius {} is not above 0", numbers[3]))
    }
}

/// The free vertices, for `fair --free`.
pub fn free_list(shape: &Shape) -> Vec<u8> {
    let lines = shape.free_vertices().into_iter().map(|v| format!("{v}\n"));
    lines.collect::<String>().into_bytes()
}

/// The exact boundary normals, for `fair --normals`.
pub fn normal_list(shape: &Shape) -> Vec<u8> {
    let normals = shape.boundary_normals();
    let lines = normals.iter().map(|(v, [x, y, z])| format!("{v} {x} {y} {z}\n"));
    lines.collect::<String>().into_bytes()
}

fn check(args: &GenerateArgs) -> Result<(), Failure> {
    if !(args.noise.is_finite() && args.noise >= 0.0) {
        return Err(Failure::new(format!(
            "--noise {}: give a number from 0 on",
            args.noise
        )));
    }
    check_angle(args)?;
    if args.profile.is_given() && args.kind != ShapeKind::Revolution {
        return Err(Failure::new(
            "--f0, --h0, --c, --phi0, --p, --length: only revolution has them",
        ));
    }
    check_semi_axes(args)?;
    let mut paths: Vec<&Path> = [&args.exact, &args.free, &args.normals]
        .into_iter()
        .flatten()
        .map(PathBuf::as_path)
        .collect();
    paths.push(&args.output);
    for (i, path) in paths.iter().enumerate() {
        if paths[..i].contains(path) {
            return Err(Failure::new(format!(
                "{}: named for two different files",
                path.display()
            )));
        }
    }
    Ok(())
}

fn check_semi_axes(args: &GenerateArgs) -> Result<(), Failure> {
    let Some(axes) = &args.semi_axes else {
        return Ok(());
    };
    if args.kind != ShapeKind::Ellipsoid {
        return Err(Failure::new("--semi-axes: only ellipsoid has them"));
    }
    if axes.len() == 3 && axes.iter().all(|a| (0.1..=10.0).contains(a)) {
        return Ok(());
    }
    Err(Failure::new("--semi-axes: give three numbers from 0.1 to 10"))
}

fn check_angle(args: &GenerateArgs) -> Result<(), Failure> {
    let Some(angle) = args.angle else {
        return Ok(());
    };
    let [least, most] = match args.kind {
        ShapeKind::SphereCap | ShapeKind::Ellipsoid => [1.0, 150.0],
        ShapeKind::SphereHole => [1.0, 170.0],
        ShapeKind::Torus => [6.0, 143.0],
        _ => {
            return Err(Failure::new(
                "--angle: only sphere-cap, sphere-hole, ellipsoid and torus have one",
            ));
        }
    };
    if (least..=most).contains(&angle) {
        return Ok(());
    }
    Err(Failure::new(format!(
        "--angle {angle}: give {least} to {most} degrees"
    )))
}

fn make(args: &GenerateArgs) -> Result<Shape, Failure> {
    let sampling = match args.triangulation {
        Triangulation::Regular => Sampling::Regular,
        Triangulation::Irregular => Sampling::Irregular { seed: args.seed },
        Triangulation::Refined => Sampling::locally_refined(),
    };
    let count = |default: usize| args.vertices.unwrap_or(default);
    let (n, outside, angle) = (count(1_000), args.outside, args.angle.unwrap_or(60.0));
    Ok(match args.kind {
        ShapeKind::CylinderBlend => fairmesh_shapes::cylinder_blend_of(count(920), sampling),
        ShapeKind::TetraThing => fairmesh_shapes::tetra_thing_of(count(500), sampling),
        ShapeKind::SphereCap => fairmesh_shapes::sphere_cap(angle, n, sampling, outside),
        ShapeKind::SphereZone => fairmesh_shapes::sphere_zone(-40.0, 50.0, n, sampling, outside),
        ShapeKind::SphereHole => fairmesh_shapes::sphere_with_hole(angle, n, sampling, outside),
        ShapeKind::Cylinder => fairmesh_shapes::cylinder_band(n, sampling, outside),
        ShapeKind::Catenoid => fairmesh_shapes::catenoid_band(n, sampling, outside),
        ShapeKind::Unduloid => fairmesh_shapes::unduloid_band(0.7, 1.0, n, sampling, outside),
        ShapeKind::Revolution => args.profile.band(n, sampling, outside)?,
        ShapeKind::Ellipsoid => ellipsoid(args, n, sampling),
        ShapeKind::Torus => torus_patch(
            1.0,
            0.4,
            args.angle.map_or(1.0, f64::to_radians),
            n,
            sampling,
            outside,
        ),
        ShapeKind::Saddle => fairmesh_shapes::saddle_graph(n, sampling, outside),
    })
}

fn ellipsoid(args: &GenerateArgs, n: usize, sampling: Sampling) -> Shape {
    let axes = match args.semi_axes.as_deref() {
        Some([a, b, c]) => [*a, *b, *c],
        _ => [1.0, 0.8, 0.6],
    };
    fairmesh_shapes::ellipsoid_cap(axes, args.angle.unwrap_or(50.0), n, sampling, args.outside)
}

fn summary(args: &GenerateArgs, shape: &Shape) -> String {
    let surface = match &shape.surface {
        Some(Surface::Sphere) => "the unit sphere about the origin".to_owned(),
        Some(Surface::Cylinder) => "the cylinder of radius 1 about the z axis".to_owned(),
        Some(Surface::Catenoid) => "the catenoid of radius cosh z about the z axis".to_owned(),
        Some(Surface::Unduloid(u)) => format!(
            "the unduloid of mean curvature {} about the z axis, radii {} (at z = 0) to {}",
            u.mean_curvature(),
            u.neck(),
            u.bulge()
        ),
        Some(Surface::Revolution(p)) => {
            let [[r, .., h], [r_end, z_end, _, h_end]] = [p.at(0.0), p.at(p.length())];
            format!(
                "revolution about the z axis, radius {r:.3} to {r_end:.3} at z = 0 to {z_end:.3}, mean curvature {h:.3} to {h_end:.3}"
            )
        }
        Some(Surface::Ellipsoid(_)) => "the ellipsoid about the origin".to_owned(),
        Some(Surface::Torus(_)) => "the torus of radii 1 and 0.4 about the z axis".to_owned(),
        _ => "none".to_owned(),
    };
    format!(
        "Written to {}\n  vertices:       {}\n  free:           {}\n  triangles:      {}\n  exact surface:  {surface}\n",
        args.output.display(),
        shape.positions.len(),
        shape.free_count(),
        shape.triangles.len()
    )
}
