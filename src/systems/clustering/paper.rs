//! Compression by plain loops in f64, which shares no arithmetic with the fast path: every step refits every cluster by
//! nalgebra's eigenvectors of C^T C, and compares every point with every cluster. It is for tests, because its time
//! grows with the cube of the dimension.

use super::{AffineSubspace, Clustering, CpcaForm, CpcaMethod, CpcaOptions, Signal};
use crate::error::InputError;
use crate::linalg::{Matrix, SymmetricEigen};

/// Threshold relative to the squared distance from the mean, below which an error counts as 0.
const NO_ERROR: f64 = 9.094_947_017_729_282e-13;
/// Threshold relative to the largest eigenvalue; eigenvalues up to it get no vector.
const NO_EIGENVALUE: f64 = 5.684_341_886_080_802e-14;

/// Compresses a signal. Fails if the options do not fit the signal.
pub fn compress(signal: &Signal, options: &CpcaOptions) -> Result<Clustering, InputError> {
    let start = options.start_points(signal)?;
    let mut plain = Plain {
        points: (0..signal.points()).map(|p| signal.point(p).iter().map(|&v| f64::from(v)).collect()).collect(),
        clusters: Vec::new(),
        of_point: vec![usize::MAX; signal.points()],
        linear: false,
    };
    plain.clusters = start.iter().map(|&p| Plain::alone(plain.points[p as usize].clone())).collect();
    plain.settle(0, options.vq_iterations);
    plain.linear = options.form == CpcaForm::Linear;
    match options.method {
        CpcaMethod::Static => plain.fit(options.vectors),
        CpcaMethod::Iterative | CpcaMethod::Adaptive { .. } => {
            for vectors in 1..=options.vectors {
                plain.fit(vectors);
                plain.settle(vectors, options.iterations);
            }
        }
        CpcaMethod::Doubling => {
            let mut vectors = 0;
            while vectors < options.vectors {
                vectors = (2 * vectors).clamp(1, options.vectors);
                plain.fit(vectors);
                plain.settle(vectors, options.iterations);
            }
        }
    }
    if let CpcaMethod::Adaptive { rounds } = options.method {
        plain.adapt(options.vectors, rounds);
    }
    Ok(plain.clustering())
}

struct PlainCluster {
    mean: Vec<f64>,
    vectors: Vec<Vec<f64>>,
    eigenvalues: Vec<f64>,
}

struct Plain {
    points: Vec<Vec<f64>>,
    clusters: Vec<PlainCluster>,
    of_point: Vec<usize>,
    /// True if the fitted clusters are linear, from the first vector on.
    linear: bool,
}

impl Plain {
    fn alone(mean: Vec<f64>) -> PlainCluster {
        PlainCluster { mean, vectors: Vec::new(), eigenvalues: Vec::new() }
    }

    fn settle(&mut self, vectors: usize, iterations: usize) {
        for _ in 0..iterations {
            if self.classify() == 0 {
                break;
            }
            self.fit(vectors);
        }
    }

    fn classify(&mut self) -> usize {
        let (mut of_point, mut errors) = (Vec::new(), Vec::new());
        for point in &self.points {
            let (mut best, mut least) = (0, f64::INFINITY);
            for (k, cluster) in self.clusters.iter().enumerate() {
                let error = squared_error(point, cluster);
                if error < least {
                    (best, least) = (k, error);
                }
            }
            of_point.push(best);
            errors.push(least);
        }
        for empty in 0..self.clusters.len() {
            let size = |k: usize| of_point.iter().filter(|&&other| other == k).count();
            if size(empty) > 0 {
                continue;
            }
            let mut worst = None;
            for p in 0..of_point.len() {
                if size(of_point[p]) > 1 && errors[p] > worst.map_or(0.0, |worst: usize| errors[worst]) {
                    worst = Some(p);
                }
            }
            if let Some(p) = worst {
                of_point[p] = empty;
                errors[p] = 0.0;
            }
        }
        let moved = (0..of_point.len()).filter(|&p| of_point[p] != self.of_point[p]).count();
        self.of_point = of_point;
        moved
    }

    fn fit(&mut self, vectors: usize) {
        let counts = vec![vectors; self.clusters.len()];
        self.fit_each(&counts);
    }

    fn fit_each(&mut self, counts: &[usize]) {
        for (k, &count) in counts.iter().enumerate() {
            let members: Vec<&Vec<f64>> =
                self.points.iter().zip(&self.of_point).filter(|(_, of)| **of == k).map(|(point, _)| point).collect();
            self.clusters[k] = if members.is_empty() {
                let mean = self.clusters[k].mean.clone();
                Self::alone(if self.linear { vec![0.0; mean.len()] } else { mean })
            } else {
                let mut cluster = principal_components(&members, self.linear);
                cluster.vectors.truncate(count);
                cluster.eigenvalues.truncate(count);
                cluster
            };
        }
    }

    fn adapt(&mut self, vectors: usize, rounds: usize) {
        for _ in 0..rounds {
            let moved = self.classify();
            let before: Vec<usize> = self.clusters.iter().map(|cluster| cluster.vectors.len()).collect();
            let all = vec![usize::MAX; before.len()];
            self.fit_each(&all);
            let counts = self.allocated(vectors * self.points.len());
            self.fit_each(&counts);
            if moved == 0 && counts == before {
                break;
            }
        }
    }

    /// The number of vectors of each cluster: the vector with the largest gain per point is added repeatedly while the
    /// budget allows.
    fn allocated(&self, budget: usize) -> Vec<usize> {
        let sizes: Vec<usize> =
            (0..self.clusters.len()).map(|k| self.of_point.iter().filter(|&&of| of == k).count()).collect();
        let (mut counts, mut used) = (vec![0; sizes.len()], 0);
        loop {
            let mut best: Option<(f64, usize)> = None;
            for (k, cluster) in self.clusters.iter().enumerate() {
                if counts[k] < cluster.eigenvalues.len() && used + sizes[k] <= budget {
                    let gain = cluster.eigenvalues[counts[k]] / sizes[k] as f64;
                    if best.is_none_or(|(largest, _)| gain > largest) {
                        best = Some((gain, k));
                    }
                }
            }
            let Some((_, k)) = best else { return counts };
            counts[k] += 1;
            used += sizes[k];
        }
    }

    fn clustering(self) -> Clustering {
        let mut weights = Vec::new();
        for (point, &k) in self.points.iter().zip(&self.of_point) {
            for vector in &self.clusters[k].vectors {
                let mut weight = 0.0;
                for j in 0..point.len() {
                    weight += (point[j] - self.clusters[k].mean[j]) * vector[j];
                }
                weights.push(weight);
            }
        }
        let subspace = |cluster: PlainCluster| AffineSubspace {
            mean: cluster.mean,
            vectors: cluster.vectors.concat(),
            eigenvalues: cluster.eigenvalues,
        };
        let of_point = self.of_point.iter().map(|&k| k as u32).collect();
        Clustering::new(self.clusters.into_iter().map(subspace).collect(), of_point, weights)
            .expect("every cluster was fitted to finite points")
    }
}

/// The squared error by section 4.2's formula.
fn squared_error(point: &[f64], cluster: &PlainCluster) -> f64 {
    let mut distance = 0.0;
    for (x, mean) in point.iter().zip(&cluster.mean) {
        distance += (x - mean) * (x - mean);
    }
    let mut error = distance;
    for vector in &cluster.vectors {
        let mut along = 0.0;
        for (j, component) in vector.iter().enumerate() {
            along += (point[j] - cluster.mean[j]) * component;
        }
        error -= along * along;
    }
    if error <= distance * NO_ERROR { 0.0 } else { error }
}

/// The mean of some points and all principal components above the threshold; in the linear form, mean 0 and the
/// components of the points without subtraction of a mean.
fn principal_components(points: &[&Vec<f64>], linear: bool) -> PlainCluster {
    let dimension = points[0].len();
    let mean_of = |j: usize| points.iter().map(|point| point[j]).sum::<f64>() / points.len() as f64;
    let mean: Vec<f64> = (0..dimension).map(|j| if linear { 0.0 } else { mean_of(j) }).collect();
    let mut matrix = Matrix::zeros([dimension; 2]).expect("a small matrix");
    for i in 0..dimension {
        for (j, value) in matrix.row_mut(i).iter_mut().enumerate() {
            *value = points.iter().map(|point| (point[i] - mean[i]) * (point[j] - mean[j])).sum();
        }
    }
    let SymmetricEigen { values, vectors } = SymmetricEigen::new(&matrix).expect("finite products");
    let kept = values.iter().take_while(|&&value| value > values[0].max(0.0) * NO_EIGENVALUE);
    let kept = if points.len() > 1 || linear { kept.count() } else { 0 };
    let vectors = vectors.rows().take(kept).map(<[f64]>::to_vec).collect();
    PlainCluster { mean, vectors, eigenvalues: values[..kept].to_vec() }
}
