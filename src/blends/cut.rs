//! Rails cut through the triangles: what stays lies where it was.

use super::chain_curve::NEAR;
use super::level::{Entry, Level, Size};
use super::sheet::Sheet;
use crate::mesh::NONE;
use crate::mesh::halfedge::next;
use fairmesh_linear::interrupt::checkpoint;

/// Steps to where an edge crosses the rail.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
const STEPS: usize = 4;
/// Vertices are on a rail, or on the line of a mitre, if they are so near it, of the length wanted there.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
pub(super) const ON: f64 = 1e-3;
/// Vertices that are so near to a rail, of the length wanted there, move onto it.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
const SNAP: f64 = 0.3;
/// What lies in a plane leaves it by at most this, of the length wanted there.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
pub(super) const LEAVES: f64 = 1e-6;
/// Triangles get no smaller than this part of what they were.
/// Half or double, of 13 solids cut from each other: all stay sound, with as many vertices to 1 %.
const SHRINKS: f64 = 0.2;
/// From a place so near on its curve, in points, the nearest one was found already: half of what is looked at to each side.
/// Half or double, of 13 solids cut from each other: none changes.
const SEEN: f64 = 0.5 * NEAR as f64;
/// Distances that differ by less, relative, are the same.
/// Half or double, of 13 solids cut from each other: none changes.
const SAME: f64 = 1e-9;

/// A sheet being cut.
pub(super) struct Cut<'a> {
    pub(super) sheet: Sheet,
    pub(super) level: &'a Level,
    /// How many of the vertices are those of the mesh given.
    pub(super) given: usize,
    /// The face of each triangle given.
    faces: &'a [u32],
    /// Its label; none if all have the same.
    labels: &'a [u32],
    /// Per vertex the sides near it.
    pub(super) near: Vec<Vec<Entry>>,
    /// Per vertex how far outside the band it is.
    pub(super) value: Vec<f64>,
    /// Per triangle whether it is in a band; known when rails are cut.
    pub(super) is_band: Vec<bool>,
    /// Per vertex whether it is on the line of a mitre: it stays there.
    is_on_mitre: Vec<bool>,
    waiting: Vec<u32>,
    is_waiting: Vec<bool>,
}

impl<'a> Cut<'a> {
    pub(super) fn new(sheet: Sheet, level: &'a Level, (faces, labels): (&'a [u32], &'a [u32])) -> Self {
        Self {
            near: vec![Vec::new(); sheet.x.len()],
            value: vec![f64::INFINITY; sheet.x.len()],
            is_band: Vec::new(),
            is_on_mitre: vec![false; sheet.x.len()],
            waiting: Vec::new(),
            is_waiting: vec![false; sheet.triangles.len()],
            given: sheet.x.len(),
            sheet,
            level,
            faces,
            labels,
        }
    }

    /// The half-edge's first vertex lies on the side's curve, there.
    pub(super) fn seed(&mut self, h: u32, side: u32, at: f64) {
        let v = self.sheet.origin(h);
        self.tell(v, h, side, at);
    }

    /// Spreads distances from the curves over the faces; triangles that a rail may pass are split until they are as fine as it.
    pub(super) fn spread(&mut self) {
        while let Some(t) = self.waiting.pop() {
            checkpoint();
            self.is_waiting[t as usize] = false;
            self.visit(t);
        }
    }

    /// The face that a triangle belongs to.
    pub(super) fn face(&self, t: u32) -> u32 {
        self.faces[self.sheet.source[t as usize] as usize]
    }

    /// Whether triangles have labels of their own.
    pub(super) fn has_labels(&self) -> bool {
        !self.labels.is_empty()
    }

    /// The label of a triangle.
    pub(super) fn label(&self, t: u32) -> u32 {
        let source = self.sheet.source[t as usize] as usize;
        self.labels.get(source).copied().unwrap_or(0)
    }

    fn visit(&mut self, t: u32) {
        let face = self.face(t);
        let longest = self.sheet.longest(t);
        let length = self.sheet.squared_length(longest).sqrt();
        for k in 0..3 {
            let v = self.sheet.origin(3 * t + k);
            for i in 0..self.near[v as usize].len() {
                let entry = self.near[v as usize][i];
                let side = &self.level.sides[entry.side as usize];
                if side.face != face || entry.distance > 2.0 * side.widest + length {
                    continue;
                }
                for h in [3 * t + (k + 1) % 3, 3 * t + (k + 2) % 3] {
                    self.tell(self.sheet.origin(h), h, entry.side, entry.at);
                }
            }
        }
        if self.is_too_long(t, length) {
            self.bisect(t);
        }
    }

    /// Vertex `v`, which `h` starts at, is told of a side; whoever is around it then is, too.
    fn tell(&mut self, v: u32, h: u32, side: u32, at: f64) {
        let known = self.near[v as usize].iter().position(|e| e.side == side);
        if known.is_some_and(|i| (self.near[v as usize][i].at - at).abs() < SEEN) {
            return;
        }
        let entry = self.level.entry(side, &self.sheet.x[v as usize], at);
        match known {
            Some(i) if self.near[v as usize][i].distance <= entry.distance * (1.0 + SAME) => return,
            Some(i) => self.near[v as usize][i] = entry,
            None => self.near[v as usize].push(entry),
        }
        self.value[v as usize] = self.level.value(&self.near[v as usize]);
        let Self {
            sheet,
            waiting,
            is_waiting,
            ..
        } = self;
        sheet.fan(h, |g| {
            if !std::mem::replace(&mut is_waiting[g as usize / 3], true) {
                waiting.push(g / 3);
            }
        });
    }

    /// Whether a rail may pass a triangle, which is longer than the rail's edges are to be.
    fn is_too_long(&self, t: u32, length: f64) -> bool {
        let corners = self.sheet.triangles[t as usize];
        let sizes = corners.map(|v| self.level.size(&self.near[v as usize]));
        let least = |of: fn(&Size) -> f64| sizes.iter().flatten().map(of).fold(f64::INFINITY, f64::min);
        if length <= least(|size| size.edge) {
            return false;
        }
        let values = corners.map(|v| self.value[v as usize]);
        let distance = values.map(f64::abs).into_iter().fold(f64::INFINITY, f64::min);
        let most = if values.iter().all(|v| *v > 0.0) {
            dip(least(|size| size.width), length)
        } else if values.iter().all(|v| *v < 0.0) {
            // No point of a triangle is further from all of its corners.
            length / 3.0_f64.sqrt()
        } else {
            length
        };
        distance < most
    }

    /// The edge length that is wanted at a vertex near a rail.
    pub(super) fn wanted(&self, v: u32) -> Option<f64> {
        self.level.size(&self.near[v as usize]).map(|size| size.edge)
    }

    /// Whether a vertex is on a rail of no side: the band goes on from another face, which tells nothing of where it ends on this one.
    pub(super) fn is_lost(&self, v: u32) -> bool {
        self.value[v as usize] == 0.0 && self.near[v as usize].is_empty()
    }

    /// Which part of the way from the chord between its rails to the crease a blend bulges at a vertex in a band.
    pub(super) fn bulge(&self, v: u32) -> f64 {
        let nearest = self.level.nearest(&self.near[v as usize]);
        nearest.map_or(0.0, |nearest| self.level.bulge(nearest))
    }

    /// Halves the longest edge of a triangle, after those that are longer beside it.
    fn bisect(&mut self, t: u32) {
        let h = self.sheet.longest(t);
        let mut longest = h;
        loop {
            let o = self.sheet.across(longest);
            if o == NONE {
                break;
            }
            let other = self.sheet.longest(o / 3);
            if other == o {
                break;
            }
            longest = other;
        }
        self.split(longest, 0.5);
        self.wait(t);
    }

    /// Halves an edge.
    pub(super) fn halve(&mut self, h: u32) {
        self.split(h, 0.5);
    }

    fn wait(&mut self, t: u32) {
        if !std::mem::replace(&mut self.is_waiting[t as usize], true) {
            self.waiting.push(t);
        }
    }

    /// The vertex is on the line of a mitre.
    pub(super) fn set_on_mitre(&mut self, v: u32) {
        self.is_on_mitre[v as usize] = true;
    }

    /// Whether the line of a mitre goes along an edge.
    pub(super) fn is_mitre(&self, h: u32) -> bool {
        [self.sheet.origin(h), self.sheet.target(h)]
            .into_iter()
            .all(|v| self.is_on_mitre(v))
    }

    pub(super) fn is_on_mitre(&self, v: u32) -> bool {
        self.is_on_mitre[v as usize]
    }

    /// Splits an edge; the new vertex knows the sides that its ends know.
    fn split(&mut self, h: u32, t: f64) -> u32 {
        let o = self.sheet.across(h);
        let known = self.known(h);
        let mut near = Vec::new();
        let triangles = self.sheet.triangles.len() as u32;
        self.is_on_mitre.push(self.is_mitre(h));
        let m = self.sheet.split(h, t);
        let value = self.level.value_at(&self.sheet.x[m as usize], &known, &mut near);
        self.near.push(near);
        self.value.push(value);
        self.is_waiting.resize(self.sheet.triangles.len(), false);
        for t in triangles..self.sheet.triangles.len() as u32 {
            self.wait(t);
        }
        self.wait(h / 3);
        if o != NONE {
            self.wait(o / 3);
        }
        m
    }

    /// The sides that the ends of an edge know, of the faces beside it.
    fn known(&self, h: u32) -> Vec<Entry> {
        let o = self.sheet.across(h);
        let faces = [Some(self.face(h / 3)), (o != NONE).then(|| self.face(o / 3))];
        let ends = [self.sheet.origin(h), self.sheet.target(h)];
        let known = ends.iter().flat_map(|&v| &self.near[v as usize]);
        let is_here = |e: &&Entry| faces.contains(&Some(self.level.sides[e.side as usize].face));
        known.filter(is_here).copied().collect()
    }

    /// Splits all edges that cross a rail where they do, but moves vertices that are near it there, if they are none of those given. Afterwards no
    /// triangle has vertices on both sides.
    pub(super) fn cut(&mut self) {
        for v in 0..self.value.len() {
            if self
                .wanted(v as u32)
                .is_some_and(|wanted| self.value[v].abs() <= ON * wanted)
            {
                self.value[v] = 0.0;
            }
        }
        self.slide();
        let mut t = 0;
        while t < self.sheet.triangles.len() as u32 {
            checkpoint();
            match (3 * t..3 * t + 3).find(|&h| self.crosses(h)) {
                Some(h) => self.cross(h),
                None => t += 1,
            }
        }
        self.waiting.clear();
        let value = &self.value;
        let is_inside = |tri: &[u32; 3]| tri.iter().any(|&v| value[v as usize] < 0.0);
        self.is_band = self.sheet.triangles.iter().map(is_inside).collect();
    }

    fn crosses(&self, h: u32) -> bool {
        let [a, b] = [self.sheet.origin(h), self.sheet.target(h)].map(|v| self.value[v as usize]);
        a * b < 0.0
    }

    /// Moves vertices near rails onto them, along edges.
    fn slide(&mut self) {
        let mut outgoing = vec![NONE; self.sheet.x.len()];
        (0..3 * self.sheet.triangles.len() as u32).for_each(|h| outgoing[self.sheet.origin(h) as usize] = h);
        for &h in &outgoing[self.given..] {
            let v = self.sheet.origin(h);
            let Some(wanted) = self.wanted(v).filter(|_| !self.is_on_mitre(v)) else {
                continue;
            };
            let mut ways = Vec::new();
            self.sheet.fan(h, |g| {
                if self.crosses(g) {
                    let t = self.crossing(g);
                    ways.push((t * self.sheet.squared_length(g).sqrt(), g, t));
                }
            });
            ways.retain(|way| way.0 < SNAP * wanted);
            ways.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            if let Some(&(_, g, t)) = ways.iter().find(|way| self.can_slide(way.1, way.2, wanted)) {
                self.move_along(g, t);
                self.value[v as usize] = 0.0;
            }
        }
    }

    /// Moves the vertex where `h` starts by a fraction of the way along it.
    fn move_along(&mut self, h: u32, t: f64) {
        let v = self.sheet.origin(h) as usize;
        self.sheet.slide(h, t);
        let known = std::mem::take(&mut self.near[v]);
        let mut near = Vec::new();
        self.value[v] = self.level.value_at(&self.sheet.x[v], &known, &mut near);
        self.near[v] = near;
    }

    /// Whether the surface stays where it is if the first vertex of `h` moves along `h`.
    fn can_slide(&self, h: u32, t: f64, wanted: f64) -> bool {
        let [a, b] = [self.sheet.origin(h), self.sheet.target(h)];
        let (from, to) = (self.sheet.x[a as usize], self.sheet.x[b as usize]);
        let by = (to - from) * t;
        let mut stays = true;
        let is_closed = self.sheet.fan(h, |g| {
            let [before, after] = [from, from + by].map(|x| self.sheet.cross(g / 3, a, &x));
            let size = before.norm();
            stays &=
                by.dot(&before).abs() <= LEAVES * wanted * size && before.dot(&after) > SHRINKS * size * size;
        });
        stays && is_closed
    }

    /// Splits an edge where it crosses a rail.
    pub(super) fn cross(&mut self, h: u32) {
        let t = self.crossing(h);
        let m = self.split(h, t);
        self.value[m as usize] = 0.0;
    }

    /// Which fraction of the way along an edge a rail is.
    fn crossing(&self, h: u32) -> f64 {
        let ends = [self.sheet.origin(h), self.sheet.target(h)];
        self.zero(h, ends.map(|v| self.value[v as usize]), |near| {
            self.level.value(near)
        })
    }

    /// Puts a vertex where a function of the sides at an edge is zero, which has these values at its ends: one of these if it is near and can move there, or
    /// else a new one. The half-edge of the same triangle that starts there.
    pub(super) fn put_where(&mut self, h: u32, ends: [f64; 2], function: impl Fn(&[Entry]) -> f64) -> u32 {
        self.put_at(h, self.zero(h, ends, function))
    }

    /// The same at a fraction of the way along an edge.
    pub(super) fn put_at(&mut self, h: u32, t: f64) -> u32 {
        let length = self.sheet.squared_length(h).sqrt();
        for (g, along, own) in [(h, t, h), (self.sheet.across(h), 1.0 - t, next(h))] {
            let wanted = self.wanted(self.sheet.origin(own)).unwrap_or(0.0);
            if along * length < SNAP * wanted && self.can_move(g, along, wanted) {
                self.move_along(g, along);
                return own;
            }
        }
        self.split(h, t);
        next(h)
    }

    /// Whether the vertex where `h` starts is none that was given or is to stay, and the surface stays where it is if it moves along `h`.
    fn can_move(&self, h: u32, t: f64, wanted: f64) -> bool {
        let v = self.sheet.origin(h);
        v as usize >= self.given && !self.is_on_mitre(v) && self.can_slide(h, t, wanted)
    }

    /// Which fraction of the way along an edge it is to there.
    fn zero(&self, h: u32, ends: [f64; 2], function: impl Fn(&[Entry]) -> f64) -> f64 {
        let [a, b] = [self.sheet.origin(h), self.sheet.target(h)];
        let [mut low, mut high] = [(0.0, ends[0]), (1.0, ends[1])];
        let (p, q) = (self.sheet.x[a as usize], self.sheet.x[b as usize]);
        let near = self.known(h);
        let mut entries = Vec::new();
        let crossing = |low: (f64, f64), high: (f64, f64)| match (low.1.is_finite(), high.1.is_finite()) {
            (true, true) => low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1),
            _ => 0.5 * (low.0 + high.0),
        };
        for _ in 0..STEPS {
            let t = crossing(low, high);
            self.level.value_at(&(p + (q - p) * t), &near, &mut entries);
            let value = function(&entries);
            if value * low.1 > 0.0 {
                low = (t, value);
            } else {
                high = (t, value);
            }
        }
        crossing(low, high)
    }
}

/// How near to a rail the ends of an edge outside of a band are, if it can pass that edge: around the end of a crease it is a circle of the band's width, which
/// chords come so near to.
fn dip(width: f64, chord: f64) -> f64 {
    libm::hypot(width, 0.5 * chord) - width
}
