//! Compression: clusters of a signal.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::axes::Axes;
use super::fit::{Fitted, fit};
use super::nearest::nearest;
use super::products::KeptProducts;
use super::{Clustering, CpcaForm, CpcaMethod, CpcaOptions, Signal};
use crate::error::{InputError, input_error};

/// A step of the compression, and its result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CpcaStep {
    /// Largest number of vectors per cluster; during redistribution the mean number.
    pub vectors: usize,
    /// The kind of step.
    pub kind: CpcaStepKind,
    /// Number of points that changed their cluster.
    pub moved: usize,
    /// The squared error of all points after the step. For a fixed number of vectors it does not increase, except
    /// through rounding and redistribution.
    pub squared_error: f64,
}

/// The kind of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum CpcaStepKind {
    /// Each point was assigned to the cluster that approximates it best.
    Classified,
    /// The mean and principal vectors of each cluster were fitted to its points.
    Fitted,
    /// Vectors were redistributed among the clusters.
    Redistributed,
}

/// A compressed signal with the steps that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Compression {
    /// The clusters.
    pub clustering: Clustering,
    /// All steps, in order.
    pub steps: Vec<CpcaStep>,
}

/// Compresses a signal. `observe` is called after each step.
pub fn compress(
    signal: &Signal,
    options: &CpcaOptions,
    observe: impl FnMut(&CpcaStep),
) -> Result<Compression, InputError> {
    compress_at(SimdLevel::widest(), signal, options, observe)
}

/// [`compress`] with given vector instructions, for tests that bits do not depend on them.
#[doc(hidden)]
pub fn compress_at(
    level: SimdLevel,
    signal: &Signal,
    options: &CpcaOptions,
    observe: impl FnMut(&CpcaStep),
) -> Result<Compression, InputError> {
    let mut work = Work::new(level, signal, options, observe)?;
    work.settle(options.vq_iterations)?;
    for vectors in options.method.growth(options.vectors) {
        work.fit_all(vectors)?;
        if options.method != CpcaMethod::Static {
            work.settle(options.iterations)?;
        }
    }
    if let CpcaMethod::Adaptive { rounds } = options.method {
        work.adapt(rounds)?;
    }
    let subspaces = work.clusters.into_iter().map(|cluster| cluster.subspace).collect();
    Ok(Compression { clustering: Clustering::project(signal, subspaces, work.of_point), steps: work.steps })
}

struct Work<'a, O> {
    signal: &'a Signal,
    axes: Option<Axes>,
    form: CpcaForm,
    level: SimdLevel,
    clusters: Vec<Fitted>,
    /// Each point's cluster; empty before the first classification.
    of_point: Vec<u32>,
    /// Clusters whose set of points has changed since they were fitted.
    changed: Vec<bool>,
    /// Inner products that each cluster keeps from one fit to the next.
    kept: Vec<KeptProducts>,
    vectors: usize,
    steps: Vec<CpcaStep>,
    observe: O,
}

impl<'a, O: FnMut(&CpcaStep)> Work<'a, O> {
    fn new(level: SimdLevel, signal: &'a Signal, options: &CpcaOptions, observe: O) -> Result<Self, InputError> {
        let start = options.start_points(signal)?;
        let at = |&point: &u32| signal.point(point as usize).iter().map(|&value| f64::from(value)).collect();
        Ok(Self {
            signal,
            axes: Axes::new(signal, options.form, level),
            form: options.form,
            level,
            clusters: start.iter().map(|point| Fitted::at(at(point))).collect(),
            of_point: Vec::new(),
            changed: vec![true; options.clusters],
            kept: vec![KeptProducts::default(); options.clusters],
            vectors: 0,
            steps: Vec::new(),
            observe,
        })
    }

    fn done(&mut self, kind: CpcaStepKind, moved: usize, squared_error: f64) {
        let step = CpcaStep { vectors: self.vectors, kind, moved, squared_error };
        (self.observe)(&step);
        self.steps.push(step);
    }

    /// The generalised LBG algorithm for the current number of vectors.
    fn settle(&mut self, iterations: usize) -> Result<(), InputError> {
        for _ in 0..iterations {
            if self.classify() == 0 {
                break;
            }
            self.fit(self.vectors)?;
            self.fitted(CpcaStepKind::Fitted);
        }
        Ok(())
    }

    /// Assigns each point to its best cluster; returns the number of points that changed clusters.
    fn classify(&mut self) -> usize {
        let subspaces: Vec<_> = self.clusters.iter().map(|cluster| &cluster.subspace).collect();
        let (mut of_point, mut errors) = nearest(self.signal, self.axes.as_ref(), &subspaces, self.level);
        fill_empty(&mut of_point, &mut errors, self.clusters.len());
        let before = std::mem::replace(&mut self.of_point, of_point);
        // Before the first classification the list is empty, and every point counts as moved.
        let mut moved = self.of_point.len() - before.len();
        for (&from, &to) in before.iter().zip(&self.of_point).filter(|(from, to)| from != to) {
            moved += 1;
            self.changed[from as usize] = true;
            self.changed[to as usize] = true;
        }
        let error = self.signal.sum(|point| errors[point]);
        self.done(CpcaStepKind::Classified, moved, error);
        moved
    }

    fn fit_all(&mut self, vectors: usize) -> Result<(), InputError> {
        self.vectors = vectors;
        self.changed.fill(true);
        self.fit(vectors)?;
        self.fitted(CpcaStepKind::Fitted);
        Ok(())
    }

    /// Fits the clusters whose points have changed. A cluster without points keeps its mean, which becomes 0 in the
    /// linear form once there are vectors.
    fn fit(&mut self, vectors: usize) -> Result<(), InputError> {
        let members = Members::new(&self.of_point, self.clusters.len());
        let (signal, form, level) = (self.signal, self.form, self.level);
        let fit_one = |(cluster, ((fitted, changed), kept)): (usize, ((&mut Fitted, &mut bool), &mut KeptProducts))| {
            if std::mem::take(changed) {
                *fitted = match members.of(cluster) {
                    [] if form == CpcaForm::Linear && vectors > 0 => Fitted::at(vec![0.0; signal.dimension()]),
                    [] => Fitted::at(std::mem::take(&mut fitted.subspace.mean)),
                    points => fit(signal, points, vectors, form, level, kept).map_err(|source| (cluster, source))?,
                };
            }
            Ok(())
        };
        let clusters =
            self.clusters.par_iter_mut().zip(&mut self.changed).zip(&mut self.kept).enumerate().with_max_len(1);
        let failed = clusters.map(fit_one).filter_map(Result::err).min_by_key(|&(cluster, _)| cluster);
        failed.map_or(Ok(()), |(cluster, reason)| Err(no_components(cluster, &reason)))
    }

    fn fitted(&mut self, kind: CpcaStepKind) {
        let error = self.clusters.iter().map(Fitted::squared_error).sum();
        self.done(kind, 0, error);
    }

    /// The additional iterations of section 4.3.
    fn adapt(&mut self, rounds: usize) -> Result<(), InputError> {
        let budget = self.vectors * self.signal.points();
        for _ in 0..rounds {
            let moved = self.classify();
            // Most clusters need at most twice the mean number of vectors.
            self.fit(2 * self.vectors + 1)?;
            let members = Members::new(&self.of_point, self.clusters.len());
            let sizes: Vec<usize> = (0..self.clusters.len()).map(|cluster| members.of(cluster).len()).collect();
            let eigenvalues: Vec<_> = self.clusters.iter().map(Fitted::eigenvalues).collect();
            let counts = distribute(&eigenvalues, &sizes, budget);
            let before: Vec<usize> = self.clusters.iter().map(|cluster| cluster.subspace.len()).collect();
            for (cluster, &count) in counts.iter().enumerate() {
                if self.clusters[cluster].subspace.len() < count {
                    self.clusters[cluster] = self.fit_one(cluster, &members, count)?;
                }
                self.clusters[cluster].truncate(count);
            }
            self.fitted(CpcaStepKind::Redistributed);
            if moved == 0 && before == counts {
                break;
            }
        }
        Ok(())
    }

    fn fit_one(&mut self, cluster: usize, members: &Members, count: usize) -> Result<Fitted, InputError> {
        let (points, kept) = (members.of(cluster), &mut self.kept[cluster]);
        let fitted = fit(self.signal, points, count, self.form, self.level, kept);
        fitted.map_err(|reason| no_components(cluster, &reason))
    }
}

fn no_components(cluster: usize, reason: &InputError) -> InputError {
    input_error!("the principal components of cluster {cluster} cannot be found: {reason}")
}

/// Distributes the budget to clusters; returns the number of vectors of each. Vectors are added by decreasing reduction
/// of the squared error per point, D_i^2 / m_k; ties go to the lower cluster. A vector costs one weight per point of
/// its cluster; vectors beyond the budget are skipped.
pub(super) fn distribute(eigenvalues: &[Vec<f64>], sizes: &[usize], budget: usize) -> Vec<usize> {
    let mut ranked: Vec<(f64, usize)> = Vec::new();
    for (cluster, (values, &size)) in eigenvalues.iter().zip(sizes).enumerate() {
        ranked.extend(values.iter().map(|value| (value / size as f64, cluster)));
    }
    // The sort is stable, so a cluster's equal eigenvalues keep their order.
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut counts, mut used) = (vec![0; sizes.len()], 0);
    for (_, cluster) in ranked {
        if used + sizes[cluster] <= budget {
            used += sizes[cluster];
            counts[cluster] += 1;
        }
    }
    counts
}

/// The points of each cluster, in increasing order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Members {
    points: Vec<u32>,
    /// The index of each cluster's first point, followed by the number of points.
    begins: Vec<usize>,
}

impl Members {
    pub(super) fn new(of_point: &[u32], clusters: usize) -> Self {
        let mut begins = vec![0; clusters + 1];
        of_point.iter().for_each(|&cluster| begins[cluster as usize + 1] += 1);
        for cluster in 0..clusters {
            begins[cluster + 1] += begins[cluster];
        }
        let (mut next, mut points) = (begins.clone(), vec![0; of_point.len()]);
        for (point, &cluster) in (0..).zip(of_point) {
            points[next[cluster as usize]] = point;
            next[cluster as usize] += 1;
        }
        Self { points, begins }
    }

    pub(super) fn of(&self, cluster: usize) -> &[u32] {
        &self.points[self.begins[cluster]..self.begins[cluster + 1]]
    }
}

/// Each empty cluster, lowest first, gets the point with the largest error (on ties, the lowest) from a cluster with
/// other points; the point's error becomes 0. If no such point has an error, the remaining clusters stay empty.
pub(super) fn fill_empty(of_point: &mut [u32], errors: &mut [f64], clusters: usize) {
    let mut sizes = vec![0usize; clusters];
    of_point.iter().for_each(|&cluster| sizes[cluster as usize] += 1);
    let empty = (0..clusters).filter(|&cluster| sizes[cluster] == 0).collect::<Vec<_>>();
    if empty.is_empty() {
        return;
    }
    let mut by_error: Vec<usize> = (0..of_point.len()).filter(|&point| errors[point] > 0.0).collect();
    by_error.sort_by(|&a, &b| errors[b].total_cmp(&errors[a]));
    let mut worst = by_error.into_iter();
    for empty in empty {
        let Some(point) = worst.find(|&point| sizes[of_point[point] as usize] > 1) else { return };
        sizes[of_point[point] as usize] -= 1;
        sizes[empty] = 1;
        (of_point[point], errors[point]) = (empty as u32, 0.0);
    }
}
