//! Which part of the way to the surroundings' curvature is gone along each loop: the longest along which the surface deviates from the
//! boundary normals no more than it may.
//!
//! Whatever was asked for, the same part is found, to a few hundredths of it: who asks for more does not get less.

/// Where a part of the way does not lead to a sound surface, the next shorter of these is tried.
/// Of 1 case, half: 0 change, -7 % iterations; double: 0 change, -9 % iterations.
const SHORTER: [f64; 3] = [0.5, 0.25, 0.125];
/// A longer part is tried only if it is longer by this factor.
/// Of 1 case, half: 1 changes by up to 0.03 edges, +26 % iterations; double: 1 changes by up to 0.7 edges, -24 % iterations.
const WORTH: f64 = 1.02;
/// So much of the way to where the deviation may just be allowed.
/// Of 1 case, half: 1 changes by up to 0.2 edges, +19 % iterations; double: 1 changes by up to 1 edge, -21 % iterations.
const SAFE: f64 = 0.99;

/// The way of one loop.
#[derive(Debug)]
struct LoopBlend {
    /// The part that is tried.
    part: f64,
    /// The longest part found to be short enough, and the deviation there, in degrees,
    good: (f64, f64),
    /// and the shortest found to be too long.
    bad: Option<(f64, f64)>,
}

/// The ways of all loops.
#[derive(Debug)]
pub(in crate::solve) struct BlendSearch {
    ways: Vec<LoopBlend>,
    allowed: f64,
}

impl BlendSearch {
    /// What is asked of each loop, and how far the tangent-continuous surface deviates along it; `allowed` is how far a surface may.
    pub(in crate::solve) fn new(asked: impl Iterator<Item = (f64, f64)>, allowed: f64) -> Self {
        let ways = asked.map(|(part, deviation)| LoopBlend {
            part,
            good: (0.0, deviation),
            bad: None,
        });
        Self {
            ways: ways.collect(),
            allowed,
        }
    }

    /// The parts that are tried.
    pub(in crate::solve) fn parts(&self) -> Vec<f64> {
        self.ways.iter().map(|way| way.part).collect()
    }

    /// Takes note of the deviation along each loop. Tells whether all are allowed.
    pub(in crate::solve) fn note(&mut self, deviations: impl Iterator<Item = f64>) -> bool {
        let mut are_allowed = true;
        for (way, deviation) in self.ways.iter_mut().zip(deviations) {
            let found = (way.part, deviation);
            if deviation <= self.allowed {
                way.good = found;
            } else {
                way.bad = Some(found);
                are_allowed = false;
            }
        }
        are_allowed
    }

    /// Goes on between what was short enough and what was too long. Tells whether that is worth a trial.
    pub(in crate::solve) fn narrow(&mut self) -> bool {
        let mut is_worth = false;
        for way in &mut self.ways {
            let Some(bad) = way.bad else { continue };
            let slope = (bad.1 - way.good.1) / (bad.0 - way.good.0);
            let next = way.good.0 + SAFE * (self.allowed - way.good.1).max(0.0) / slope;
            let is_longer = next > WORTH * way.good.0 && next < bad.0;
            way.part = if is_longer { next } else { way.good.0 };
            is_worth |= is_longer;
        }
        is_worth
    }

    /// Stays with the tangent-continuous surface along these loops. Tells whether there is a way left along others.
    pub(in crate::solve) fn leave(&mut self, loops: &[usize]) -> bool {
        for &k in loops {
            let way = &mut self.ways[k];
            (way.part, way.bad) = (0.0, None);
        }
        self.ways.iter().any(|way| way.part > 0.0)
    }

    /// Goes less of the way along all loops. Tells whether there is a way left.
    pub(in crate::solve) fn shorten(&mut self) -> bool {
        for way in &mut self.ways {
            let below = SHORTER.into_iter().find(|shorter| *shorter < way.part);
            way.part = below.unwrap_or(0.0);
        }
        self.ways.iter().any(|way| way.part > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where deviations grow with the part, convexly.
    fn reached(asked: f64) -> f64 {
        let deviation = |part: f64| 3.0 + part + part * part;
        let mut ways = BlendSearch::new([(asked, 3.0)].into_iter(), 3.5);
        let mut best = 0.0;
        for _ in 0..6 {
            let part = ways.parts()[0];
            if ways.note([deviation(part)].into_iter()) {
                best = part;
            }
            if !ways.narrow() {
                break;
            }
        }
        best
    }

    #[test]
    fn the_longest_part_is_found_whatever_is_asked() {
        // Of part + part^2 = 0.5.
        let longest = 0.5 * (3f64.sqrt() - 1.0);
        assert_eq!(reached(0.2), 0.2);
        assert_eq!(reached(0.3), 0.3);
        for asked in [0.4, 0.6, 0.8, 1.0] {
            let found = reached(asked);
            assert!(found <= longest && found > 0.93 * longest, "{asked} {found}");
        }
    }

    #[test]
    fn parts_grow_shorter_by_rule() {
        let mut ways = BlendSearch::new([(1.0, 1.0), (0.3, 1.0)].into_iter(), 2.0);
        assert!(ways.shorten());
        assert_eq!(ways.parts(), [0.5, 0.25]);
        assert!(ways.shorten());
        assert!(ways.shorten());
        assert_eq!(ways.parts(), [0.125, 0.0]);
        assert!(!ways.shorten());
    }

    #[test]
    fn loops_are_left() {
        let mut ways = BlendSearch::new([(1.0, 1.0), (0.3, 1.0)].into_iter(), 2.0);
        assert!(ways.leave(&[0]));
        assert_eq!(ways.parts(), [0.0, 0.3]);
        assert!(!ways.leave(&[1]));
    }

    /// Only the loop whose normals are missed stays behind.
    #[test]
    fn a_loop_stays_behind_alone() {
        let mut ways = BlendSearch::new([(1.0, 1.0), (1.0, 1.0)].into_iter(), 2.0);
        assert!(!ways.note([1.5, 3.0].into_iter()));
        assert!(ways.narrow());
        let parts = ways.parts();
        assert!(parts[0] == 1.0 && (0.45..0.5).contains(&parts[1]), "{parts:?}");
    }
}
