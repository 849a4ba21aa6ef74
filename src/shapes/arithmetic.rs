//! Vectors and bounds.

/// `p` scaled to length one; zero stays zero.
pub(super) fn unit(p: [f64; 3]) -> [f64; 3] {
    let length = p[0].hypot(p[1]).hypot(p[2]);
    if length > 0.0 {
        p.map(|x| x / length)
    } else {
        [0.0; 3]
    }
}

/// `a x b`.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The length of a vector.
pub(super) fn length(p: [f64; 3]) -> f64 {
    p[0].hypot(p[1]).hypot(p[2])
}

/// `x` moved into [low, high]; a NaN becomes `low`.
pub(super) fn between(low: f64, x: f64, high: f64) -> f64 {
    if x > low {
        if x < high { x } else { high }
    } else {
        low
    }
}
