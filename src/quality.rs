//! Is the result sound: triangles, normals, extent.

/// Figures of the faired region, all measured on the result.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Quality {
    /// The smallest angle of the region's triangles, in degrees.
    pub worst_angle: f64,
    /// The triangle that has it.
    pub worst_triangle: usize,
    /// Triangles whose normal points away from the sum of their vertices' normals.
    pub flipped: Vec<u32>,
    /// Triangles with an angle below one degree.
    pub needles: Vec<u32>,
    /// The smallest and largest mean curvature at free vertices.
    pub h_inside: [f64; 2],
    /// The smallest and largest mean curvature at border vertices.
    pub h_border: [f64; 2],
    /// The largest angle, in degrees, between a prescribed border normal and the normal of the surface there.
    pub normal_deviation: f64,
    /// The border vertex that has it.
    pub normal_deviation_vertex: usize,
    /// The root mean square of those angles, in degrees.
    pub normal_deviation_rms: f64,
}
