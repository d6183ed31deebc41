//! Comparison of one case on two sides: two executors, two formats, two devices.

use refsim::{
    event::DrawEvents,
    exec::ResolvedConstants,
    isa::Program,
    machine::{Executor, FragmentTrace},
};
use serde::Serialize;

use super::{CaseError, Loaded, Setup, loaded::constants, run::event_counts};
use crate::compare::{
    FragmentPass, SurfaceDifference, TargetFormats, TraceDifference, TraceSide, TraceStage, depths, differing_corner,
    first_difference, images,
};

/// Number of pixels traced per batch; each batch processes the vertices once.
const TOGETHER: usize = 1024;

/// One side of a comparison: a case with its overrides, and the executor.
#[derive(Clone, Debug)]
pub struct Side<'s> {
    /// The case. Both sides come from the same file.
    pub setup: &'s Setup,
    /// The executor.
    pub executor: Executor,
}

/// Scope of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Results of the draw: targets, depth buffer, counts.
    Results,
    /// Results, and the register writes of every instruction at every pixel.
    Registers,
    /// Results, and the register writes of every instruction at one pixel: column and row.
    Pixel([u32; 2]),
}

/// Result of a comparison.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Every target, then the depth buffer.
    pub surfaces: Vec<SurfaceDifference>,
    /// Number of pixels of the targets.
    pub pixels: u64,
    /// Number of pixels at which some surface differs.
    pub different: u64,
    /// Counts that differ.
    pub counts: Vec<CountDifference>,
    /// Numbers of pixels traced on both sides, and of those that differ.
    pub followed: [u64; 2],
    /// First difference; `None` if there is none.
    pub first: Option<First>,
}

/// A count with different values on the two sides.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CountDifference {
    /// Name of the count.
    pub count: &'static str,
    /// Value on the left.
    pub left: u64,
    /// Value on the right.
    pub right: u64,
}

/// First difference.
#[derive(Clone, Debug)]
pub struct First {
    /// Column and row of the first pixel that differs, row by row from the top left.
    pub pixel: [u32; 2],
    /// First difference of its fragments' traces. `None` if the traces are equal although the results of the draws
    /// differ: then one side's draw differs from its own trace.
    pub difference: Option<TraceDifference>,
}

impl Comparison {
    /// Returns `true` if nothing differs.
    pub fn equal(&self) -> bool {
        self.different == 0 && self.counts.is_empty() && self.first.is_none()
    }
}

/// Runs a case on two sides and compares. Fails if a side cannot be executed, or the pixel of the scope lies outside
/// the targets.
pub fn compare(left: &Side<'_>, right: &Side<'_>, scope: Scope) -> Result<Comparison, CaseError> {
    let mut sides = [DrawnSide::new(left)?, DrawnSide::new(right)?];
    let events = [sides[0].drawn.draw()?, sides[1].drawn.draw()?];
    let surfaces = surfaces(&sides[0].drawn, &sides[1].drawn)?;
    let [width, height] = left.setup.size;
    let differs = |i: usize| surfaces.iter().any(|surface| surface.map.get(i) == Some(&true));
    let count = width as usize * height as usize;
    let differing: Vec<usize> = (0..count).filter(|&i| differs(i)).collect();
    let place = |i: usize| (i as u32 % width, i as u32 / width);
    let mut comparison = Comparison {
        pixels: count as u64,
        different: differing.len() as u64,
        counts: count_differences(&events[0], &events[1]),
        followed: [0; 2],
        first: None,
        surfaces,
    };
    let pixels: Vec<(u32, u32)> = match scope {
        Scope::Pixel([x, y]) => vec![(x, y)],
        Scope::Results if !differing.is_empty() => vec![place(differing[0])],
        // Counts have no position.
        Scope::Results if comparison.counts.is_empty() => Vec::new(),
        Scope::Results | Scope::Registers => (0..count).map(place).collect(),
    };
    for some in pixels.chunks(TOGETHER) {
        follow(&sides, some, &mut comparison)?;
        if scope == Scope::Results && comparison.first.is_some() {
            break;
        }
    }
    if comparison.first.is_none()
        && let Some(&first) = differing.first()
        && !matches!(scope, Scope::Pixel(_))
    {
        let (x, y) = place(first);
        comparison.first = Some(First { pixel: [x, y], difference: None });
    }
    Ok(comparison)
}

/// Side with two cards: one draws; the other keeps the memory from before the draw, for traces.
struct DrawnSide<'s> {
    drawn: Loaded<'s>,
    before: Loaded<'s>,
    setup: &'s Setup,
    constants: ResolvedConstants,
}

impl<'s> DrawnSide<'s> {
    fn new(side: &Side<'s>) -> Result<Self, CaseError> {
        let load = || Loaded::new(side.setup, &side.executor);
        Ok(Self { drawn: load()?, before: load()?, setup: side.setup, constants: constants(side.setup) })
    }

    fn trace<'t>(&'t self, fragments: &'t [FragmentTrace]) -> TraceSide<'t> {
        let program: &Program = &self.setup.pixel;
        TraceSide { program, format: self.setup.profile.rules.format, constants: &self.constants, fragments }
    }
}

/// Traces pixels on both sides, counts those that differ, and stores the first one.
fn follow(sides: &[DrawnSide<'_>; 2], pixels: &[(u32, u32)], comparison: &mut Comparison) -> Result<(), CaseError> {
    let setup = sides[0].setup;
    let shape = TargetFormats { targets: &setup.targets, depth: setup.depth.map(|(format, ..)| format) };
    let traces = [sides[0].before.trace(pixels)?, sides[1].before.trace(pixels)?];
    for (&(x, y), (left, right)) in pixels.iter().zip(traces[0].iter().zip(&traces[1])) {
        comparison.followed[0] += 1;
        let found = first_difference(&sides[0].trace(left), &sides[1].trace(right), &shape);
        if let Some(difference) = found {
            comparison.followed[1] += 1;
            if comparison.first.is_none() {
                let difference = Some(from_vertices(sides, difference)?);
                comparison.first = Some(First { pixel: [x, y], difference });
            }
        }
    }
    Ok(())
}

/// Attributes a difference in coverage or input to the vertex stage if the corners differ.
fn from_vertices(sides: &[DrawnSide<'_>; 2], difference: TraceDifference) -> Result<TraceDifference, CaseError> {
    if !matches!(difference.stage, TraceStage::Coverage { .. } | TraceStage::Input) {
        return Ok(difference);
    }
    let FragmentPass { instance, triangle, .. } = difference.pass;
    let corners = [sides[0].before.corners(instance, triangle)?, sides[1].before.corners(instance, triangle)?];
    Ok(match corners {
        [Some(left), Some(right)] => match differing_corner(&left, &right) {
            Some((corner, values)) => TraceDifference { stage: TraceStage::Vertex { corner }, values, ..difference },
            None => difference,
        },
        _ => difference,
    })
}

/// Compares the surfaces of both sides. Their shapes are equal, since both sides draw the same case.
fn surfaces(left: &Loaded<'_>, right: &Loaded<'_>) -> Result<Vec<SurfaceDifference>, CaseError> {
    let (a, b) = (left.targets()?, right.targets()?);
    let targets = a.iter().zip(b).enumerate();
    let mut found: Vec<SurfaceDifference> =
        targets.filter_map(|(index, (a, b))| images(&format!("target {index}"), a, b)).collect();
    if let (Some(a), Some(b)) = (left.depth()?, right.depth()?) {
        found.extend(depths("depth", a, b));
    }
    Ok(found)
}

fn count_differences(left: &DrawEvents, right: &DrawEvents) -> Vec<CountDifference> {
    let pairs = event_counts(left).into_iter().zip(event_counts(right));
    pairs
        .filter(|((_, a), (_, b))| a != b)
        .map(|((count, left), (_, right))| CountDifference { count, left, right })
        .collect()
}
