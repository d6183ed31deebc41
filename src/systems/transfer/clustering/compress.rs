//! Compression: clusters of a signal.

use rayon::prelude::*;
use refsim::exec::batch::SimdLevel;

use super::budget::distribute;
use super::fit::{Fitted, fit};
use super::gram::KeptProducts;
use super::members::{Members, fill_empty};
use super::nearest::Points;
use super::{Clustering, CpcaError, CpcaForm, CpcaMethod, CpcaOptions};
use crate::transfer::Signal;

/// A step of the compression, and its result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CpcaStep {
    /// Largest number of vectors per cluster; their mean number during redistribution.
    pub vectors: usize,
    /// The kind of step.
    pub kind: CpcaStepKind,
    /// Number of points that changed their cluster.
    pub moved: usize,
    /// The squared error of all points after the step. For a fixed number of vectors it does not increase, except by
    /// rounding and by redistribution.
    pub squared_error: f64,
}

/// The kind of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
///
/// # Errors
/// [`CpcaError`] if the options do not fit the signal, or principal components cannot be computed.
pub fn compress(
    signal: &Signal,
    options: &CpcaOptions,
    observe: impl FnMut(&CpcaStep),
) -> Result<Compression, CpcaError> {
    compress_at(SimdLevel::widest(), signal, options, observe)
}

/// [`compress`] with the given vector instructions.
pub(super) fn compress_at(
    level: SimdLevel,
    signal: &Signal,
    options: &CpcaOptions,
    observe: impl FnMut(&CpcaStep),
) -> Result<Compression, CpcaError> {
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
    points: Points<'a>,
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
    fn new(level: SimdLevel, signal: &'a Signal, options: &CpcaOptions, observe: O) -> Result<Self, CpcaError> {
        let start = options.start_points(signal)?;
        let at = |&point: &u32| signal.point(point as usize).iter().map(|&value| f64::from(value)).collect();
        Ok(Self {
            signal,
            points: Points::new(signal, options.form, level),
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
    fn settle(&mut self, iterations: usize) -> Result<(), CpcaError> {
        for _ in 0..iterations {
            if self.classify() == 0 {
                break;
            }
            self.fit(self.vectors)?;
            self.fitted(CpcaStepKind::Fitted);
        }
        Ok(())
    }

    /// Assigns each point to its best cluster; returns the number of points that changed theirs.
    fn classify(&mut self) -> usize {
        let subspaces: Vec<_> = self.clusters.iter().map(|cluster| &cluster.subspace).collect();
        let mut nearest = self.points.nearest(&subspaces);
        fill_empty(&mut nearest.cluster, &mut nearest.squared_error, self.clusters.len());
        let before = std::mem::replace(&mut self.of_point, nearest.cluster);
        // Before the first classification the list is empty: then every point counts as moved.
        let mut moved = self.of_point.len() - before.len();
        for (&from, &to) in before.iter().zip(&self.of_point).filter(|(from, to)| from != to) {
            moved += 1;
            self.changed[from as usize] = true;
            self.changed[to as usize] = true;
        }
        let error = self.signal.sum(|point| nearest.squared_error[point]);
        self.done(CpcaStepKind::Classified, moved, error);
        moved
    }

    /// Fits all clusters with a new number of vectors.
    fn fit_all(&mut self, vectors: usize) -> Result<(), CpcaError> {
        self.vectors = vectors;
        self.changed.fill(true);
        self.fit(vectors)?;
        self.fitted(CpcaStepKind::Fitted);
        Ok(())
    }

    /// Fits the clusters whose points have changed. A cluster without points keeps its mean, which becomes 0 in the
    /// linear form once there are vectors.
    fn fit(&mut self, vectors: usize) -> Result<(), CpcaError> {
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
        failed.map_or(Ok(()), |(cluster, reason)| Err(CpcaError::Factor { cluster, reason }))
    }

    fn fitted(&mut self, kind: CpcaStepKind) {
        let error = self.clusters.iter().map(Fitted::squared_error).sum();
        self.done(kind, 0, error);
    }

    /// The additional iterations of section 4.3.
    fn adapt(&mut self, rounds: usize) -> Result<(), CpcaError> {
        let budget = self.vectors * self.signal.points();
        for _ in 0..rounds {
            let moved = self.classify();
            // Twice the mean number of vectors is enough for most clusters.
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

    fn fit_one(&mut self, cluster: usize, members: &Members, count: usize) -> Result<Fitted, CpcaError> {
        let (points, kept) = (members.of(cluster), &mut self.kept[cluster]);
        let fitted = fit(self.signal, points, count, self.form, self.level, kept);
        fitted.map_err(|reason| CpcaError::Factor { cluster, reason })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::clustering::StartPoints;
    use crate::transfer::synthetic::torus_signal;

    #[test]
    fn bits_do_not_depend_on_threads_or_vector_instructions() {
        for (points, dimension, clusters) in [(700, 30, 9), (2500, 7, 20), (1200, 150, 1)] {
            let signal = torus_signal(points, dimension, 6);
            let method = CpcaMethod::Adaptive { rounds: 3 };
            let options = CpcaOptions {
                clusters,
                vectors: 3,
                vq_iterations: 4,
                iterations: 4,
                method,
                form: CpcaForm::Affine,
                start: StartPoints::Seed(2),
            };
            let widest = compress(&signal, &options, |_| ()).expect("compressed");
            for level in SimdLevel::available() {
                for threads in [1, 3] {
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                    let again = pool.install(|| compress_at(level, &signal, &options, |_| ())).expect("compressed");
                    assert_eq!(again, widest, "{} with {threads} threads", level.name());
                }
            }
        }
    }

    #[test]
    fn every_step_is_observed() {
        let (signal, mut seen) = (torus_signal(90, 4, 0), Vec::new());
        let options = CpcaOptions {
            clusters: 3,
            vectors: 2,
            vq_iterations: 3,
            iterations: 3,
            method: CpcaMethod::Static,
            form: CpcaForm::Affine,
            start: StartPoints::Seed(0),
        };
        let compression = compress(&signal, &options, |step| seen.push(*step)).expect("compressed");
        assert_eq!(compression.steps, seen);
        assert_eq!((seen[0].kind, seen[0].moved), (CpcaStepKind::Classified, 90));
    }
}
