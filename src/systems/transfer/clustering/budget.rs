//! The number of vectors of each cluster (section 4.3).

/// Per cluster the number of vectors that the budget allows. Vectors come by decreasing reduction of the squared error
/// per point, D_i^2 / m_k; of equals the lower cluster's first. Each costs a weight per point of its cluster; what
/// exceeds the budget is passed over.
pub(super) fn distribute(eigenvalues: &[Vec<f64>], sizes: &[usize], budget: usize) -> Vec<usize> {
    let mut ranked: Vec<(f64, usize)> = Vec::new();
    for (cluster, (values, &size)) in eigenvalues.iter().zip(sizes).enumerate() {
        ranked.extend(values.iter().map(|value| (value / size as f64, cluster)));
    }
    // A stable sort: of a cluster's equal eigenvalues the first stays the first.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Eight points (+-3, +-2, +-1) and four (+-5, +-1/2): two vectors each are 24 weights and leave an error of 8.
    /// Stopping at the first vector that does not fit would leave 9.
    #[test]
    fn what_exceeds_the_budget_is_passed_over() {
        let eigenvalues = [vec![72.0, 32.0, 8.0], vec![100.0, 1.0]];
        assert_eq!(distribute(&eigenvalues, &[8, 4], 24), [2, 2]);
        assert_eq!(distribute(&eigenvalues, &[8, 4], 23), [2, 1], "4 of 23 are left, but 3 would be enough for none");
        assert_eq!(distribute(&eigenvalues, &[8, 4], 7), [0, 1]);
        assert_eq!(distribute(&eigenvalues, &[8, 4], 1000), [3, 2]);
    }

    #[test]
    fn of_equal_gains_the_lower_cluster_is_first() {
        let eigenvalues = [vec![2.0, 2.0], vec![2.0, 2.0]];
        assert_eq!(distribute(&eigenvalues, &[1, 1], 3), [2, 1]);
    }
}
