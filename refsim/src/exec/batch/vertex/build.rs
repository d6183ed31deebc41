//! Construction of [`Surfaces`] from vertex rows: [`crate::raster`] sets up shapes, once for triangles with equal
//! positions; planes are computed in rows.

use rayon::prelude::*;
use refsim_lanes::SimdLevel;

use super::rows::VertexRows;
use super::surfaces::{PlaneRows, Surfaces, Triangle};
use super::window::{ClipResult, Window};
use crate::event::PrimitiveCounts;
use crate::num::Format;
use crate::raster::{ComponentMask, RasterRules, RasterState, TriangleSetup, Vertex, component_plane, setup, shape};

/// Number of triangles whose shapes a worker sets up at once.
const CHUNK: usize = 1024;
/// Number of recent triangles whose positions are compared with a new one's.
const RECENT: usize = 4;

/// Instances of a triangle list over vertex rows: vertex `v` of instance `i` has index `v * instances + i`.
#[derive(Clone, Copy, Debug)]
pub struct Instances<'a> {
    /// The vertices.
    pub rows: &'a VertexRows,
    /// Number of instances.
    pub count: usize,
    /// Triangles of one instance, as vertex indices.
    pub triangles: &'a [[usize; 3]],
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum ShapeOutcome {
    /// An index into the chunk's shapes.
    Shape(usize),
    Dropped,
    /// Clipped: the resulting triangles depend on the components.
    Cut,
}

impl Instances<'_> {
    fn corners(&self, instance: usize, triangle: usize) -> [usize; 3] {
        self.triangles[triangle].map(|vertex| vertex * self.count + instance)
    }

    /// For each instance, `true` if it has the same positions as the previous instance.
    fn repeats(&self) -> Vec<bool> {
        let mut repeats = vec![true; self.count];
        if let Some(first) = repeats.first_mut() {
            *first = false;
        }
        if self.count > 1 {
            for vertex in self.rows.position.iter().flat_map(|row| row.chunks_exact(self.count)) {
                for (repeats, (now, before)) in repeats[1..].iter_mut().zip(vertex[1..].iter().zip(vertex)) {
                    *repeats &= now == before;
                }
            }
        }
        repeats
    }

    fn positions(&self, corners: [usize; 3]) -> [[u32; 4]; 3] {
        corners.map(|at| [0, 1, 2, 3].map(|c: usize| self.rows.position[c][at]))
    }
}

impl Surfaces {
    /// Sets up all triangles, instance by instance, with the components that are `needed`.
    pub fn build(
        instances: &Instances<'_>,
        state: &RasterState,
        rules: &RasterRules,
        needed: ComponentMask,
        simd: SimdLevel,
    ) -> (Self, PrimitiveCounts) {
        let mut out = Self::new(needed, rules.iterator_format);
        let each = instances.triangles.len();
        let total = each * instances.count;
        let joined = out.planes(instances, simd);
        let window = Window::new(instances.rows, state, rules, simd);
        let repeats = instances.repeats();
        let chunk = |chunk: usize| {
            let range = chunk * CHUNK..((chunk + 1) * CHUNK).min(total);
            shapes((instances, &window, &repeats), range, state, rules)
        };
        // A single chunk is not worth waking other threads.
        let chunks: Vec<_> = match total.div_ceil(CHUNK) {
            few @ 0..2 => (0..few).map(chunk).collect(),
            many => (0..many).into_par_iter().map(chunk).collect(),
        };
        let mut counts = PrimitiveCounts { assembled: total as u64, ..PrimitiveCounts::default() };
        let mut last = None;
        // Indices of a chunk's shapes.
        let mut numbers: Vec<u32> = Vec::new();
        let all = chunks.iter().flat_map(|(outcomes, shapes)| outcomes.iter().map(move |&outcome| (outcome, shapes)));
        for (index, (outcome, shapes)) in all.enumerate() {
            if index % CHUNK == 0 {
                numbers.clear();
            }
            let (instance, triangle) = (index / each, index % each);
            let planes = triangle * instances.count + instance;
            match outcome {
                ShapeOutcome::Shape(i) => {
                    if numbers.len() <= i {
                        numbers.push(out.shape(&shapes[i]));
                    }
                    let shape = numbers[i];
                    let placed = Triangle { shape, planes: planes as u32 };
                    // `joined` compares with the previous triangle of the instance, which must also be the last
                    // emitted.
                    if triangle > 0 && last == Some(index - 1) {
                        out.push_joined(placed, joined[planes]);
                    } else {
                        out.push(placed);
                    }
                    last = Some(index);
                    counts.rasterised += 1;
                }
                ShapeOutcome::Cut => {
                    let emitted = out.cut(instances, instances.corners(instance, triangle), state, rules);
                    counts.culled += u64::from(emitted == 0);
                    counts.clipped += u64::from(emitted > 1);
                    counts.rasterised += u64::from(emitted);
                }
                ShapeOutcome::Dropped => counts.culled += 1,
            }
        }
        (out, counts)
    }

    /// Appends the clipped parts of a triangle; returns their number.
    fn cut(&mut self, instances: &Instances<'_>, corners: [usize; 3], state: &RasterState, rules: &RasterRules) -> u32 {
        let [a, b, c] = corners.map(|at| instances.rows.vertex(at));
        let mut parts = Vec::new();
        let report = setup([&a, &b, &c], state, rules, &mut parts);
        for part in &parts {
            let shape = self.shape(part);
            let planes = self.push_planes(part);
            self.push(Triangle { shape, planes });
        }
        report.emitted
    }

    /// Computes the planes of all triangles, grouped by triangle of the list, then instance. Returns, per triangle,
    /// `true` if the previous triangle of the same instance has the same constant components.
    fn planes(&mut self, instances: &Instances<'_>, simd: SimdLevel) -> Vec<bool> {
        let (count, total) = (instances.count, instances.count * instances.triangles.len());
        let format = self.iterator_format;
        let work = |row: &mut PlaneRows| {
            let values = &instances.rows.components[row.component];
            let part = |corner: usize| &values[corner * count..(corner + 1) * count];
            let same =
                |corners: &[usize; 3]| part(corners[0]) == part(corners[1]) && part(corners[1]) == part(corners[2]);
            if format == Format::FP32 && instances.triangles.iter().all(same) {
                row.base = Vec::with_capacity(total);
                instances.triangles.iter().for_each(|corners| row.base.extend_from_slice(part(corners[0])));
                return None;
            }
            let mut constant = vec![0u8; total];
            (row.base, row.d1, row.d2) = (vec![0; total], vec![0; total], vec![0; total]);
            if format == Format::FP32 && count == 1 {
                let corner =
                    |k: usize| instances.triangles.iter().map(|corners| values[corners[k]]).collect::<Vec<_>>();
                let (corners, to) = ([corner(0), corner(1), corner(2)], (&mut *row.base, &mut *row.d1, &mut *row.d2));
                simd.run(
                    #[inline(always)]
                    || single_planes(corners.each_ref().map(Vec::as_slice), to, &mut constant),
                );
                return Some(constant);
            }
            for (j, corners) in instances.triangles.iter().enumerate() {
                let of = |k: usize| part(corners[k]);
                let here = j * count..(j + 1) * count;
                let to = (&mut row.base[here.clone()], &mut row.d1[here.clone()], &mut row.d2[here.clone()]);
                if format == Format::FP32 {
                    simd.run(
                        #[inline(always)]
                        || single_planes([of(0), of(1), of(2)], to, &mut constant[here]),
                    );
                } else {
                    any_planes([of(0), of(1), of(2)], format, to, &mut constant[here]);
                }
            }
            Some(constant)
        };
        // For each row, 1 for each triangle over which the component is constant; empty if it is constant over all
        // triangles.
        let flags: Vec<Option<Vec<u8>>> = if total <= CHUNK {
            self.rows.iter_mut().map(work).collect()
        } else {
            self.rows.par_iter_mut().map(work).collect()
        };
        let always = self.rows.iter().zip(&flags).filter(|(_, flags)| flags.is_none());
        self.constant = vec![always.fold(0, |mask, (row, _)| mask | 1 << row.component); total];
        let mut joined = vec![true; total];
        for (row, flags) in self.rows.iter().zip(&flags) {
            let Some(flags) = flags else {
                let (before, now) = (&row.base[..total.saturating_sub(count)], &row.base[count.min(total)..]);
                if before != now {
                    let pairs = before.iter().zip(now);
                    joined.iter_mut().skip(count).zip(pairs).for_each(|(joined, (a, b))| *joined &= a == b);
                }
                continue;
            };
            for (mask, &flag) in self.constant.iter_mut().zip(flags) {
                *mask |= u64::from(flag) << row.component;
            }
            // Element `i` is compared with the previous triangle of its instance, `i - count`.
            let (before, now) = (row.base.iter().zip(flags), row.base.iter().zip(flags).skip(count));
            for ((joined, (a, fa)), (b, fb)) in joined.iter_mut().skip(count).zip(before).zip(now) {
                *joined &= (fa == fb) & ((*fa == 0) | (a == b));
            }
        }
        joined
    }
}

/// Sets up the shapes of triangles.
fn shapes(
    (instances, window, repeats): (&Instances<'_>, &Window, &[bool]),
    range: std::ops::Range<usize>,
    state: &RasterState,
    rules: &RasterRules,
) -> (Vec<ShapeOutcome>, Vec<TriangleSetup>) {
    let each = instances.triangles.len();
    let mut outcomes: Vec<ShapeOutcome> = Vec::with_capacity(range.len());
    let mut shapes = Vec::new();
    let mut recent: Vec<([[u32; 4]; 3], ShapeOutcome)> = Vec::with_capacity(RECENT);
    let mut next = 0;
    let mut outcome = |i: usize| {
        let corners = instances.corners(i / each, i % each);
        let positions = instances.positions(corners);
        if let Some((_, outcome)) = recent.iter().find(|(known, _)| *known == positions) {
            return *outcome;
        }
        let standing = corners.map(|vertex| window.clipped(vertex));
        let outcome = if standing.contains(&ClipResult::NotFinite) {
            ShapeOutcome::Dropped
        } else if standing.contains(&ClipResult::Outside) {
            cut_outcome(&positions, state, rules)
        } else if standing.contains(&ClipResult::Lost) {
            ShapeOutcome::Dropped
        } else {
            match shape(corners.map(|vertex| window.corner(vertex)), positions.map(|p| p[3]), state, rules) {
                Ok(shape) => {
                    shapes.push(shape);
                    ShapeOutcome::Shape(shapes.len() - 1)
                }
                Err(_) => ShapeOutcome::Dropped,
            }
        };
        if recent.len() < RECENT {
            recent.push((positions, outcome));
        } else {
            recent[next % RECENT] = (positions, outcome);
            next += 1;
        }
        outcome
    };
    for i in range {
        // An instance with the positions of the previous one has the same outcomes.
        let known = outcomes.len().checked_sub(each).filter(|_| repeats[i / each]);
        let outcome = known.map_or_else(|| outcome(i), |before| outcomes[before]);
        outcomes.push(outcome);
    }
    (outcomes, shapes)
}

/// Outcome of a triangle that a clip plane cuts; it does not depend on the triangle's components.
fn cut_outcome(positions: &[[u32; 4]; 3], state: &RasterState, rules: &RasterRules) -> ShapeOutcome {
    let [a, b, c] = positions.map(|position| Vertex { position, ..Vertex::default() });
    if setup([&a, &b, &c], state, rules, &mut Vec::new()).emitted == 0 {
        ShapeOutcome::Dropped
    } else {
        ShapeOutcome::Cut
    }
}

/// Computes the planes of one component in single precision, and a flag that is 1 where the component is constant.
#[inline(always)]
fn single_planes([v0, v1, v2]: [&[u32]; 3], (base, d1, d2): (&mut [u32], &mut [u32], &mut [u32]), constant: &mut [u8]) {
    let count = v0.len();
    let (v1, v2) = (&v1[..count], &v2[..count]);
    let (base, d1, d2, constant) = (&mut base[..count], &mut d1[..count], &mut d2[..count], &mut constant[..count]);
    base.copy_from_slice(v0);
    for i in 0..count {
        let same = (v0[i] == v1[i]) & (v1[i] == v2[i]);
        constant[i] = u8::from(same);
        d1[i] = if same { 0 } else { less(v1[i], v0[i]) };
        d2[i] = if same { 0 } else { less(v2[i], v0[i]) };
    }
}

/// `a - b` in single precision.
#[inline(always)]
fn less(a: u32, b: u32) -> u32 {
    let difference = f32::from_bits(a) - f32::from_bits(b);
    if difference.is_nan() { 0x7fc0_0000 } else { difference.to_bits() }
}

fn any_planes(
    [v0, v1, v2]: [&[u32]; 3],
    format: Format,
    (base, d1, d2): (&mut [u32], &mut [u32], &mut [u32]),
    constant: &mut [u8],
) {
    for i in 0..v0.len() {
        let (plane, same) = component_plane([v0[i], v1[i], v2[i]], format);
        (base[i], d1[i], d2[i]) = (plane.base, plane.d1, plane.d2);
        constant[i] = u8::from(same);
    }
}
