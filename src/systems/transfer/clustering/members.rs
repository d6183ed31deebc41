//! The points of each cluster.

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

/// Each empty cluster, lowest first, takes the point of largest error, the lowest of equals, from a cluster that has
/// others; its error is 0 then. Where no such point has an error, the rest stays empty.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_in_order() {
        let members = Members::new(&[2, 0, 2, 2], 4);
        assert_eq!([0, 1, 2, 3].map(|k| members.of(k)), [&[1][..], &[], &[0, 2, 3], &[]]);
    }

    #[test]
    fn empty_clusters_take_the_worst_points_but_no_last_ones() {
        let (mut of_point, mut errors) = (vec![1, 1, 1, 3], vec![2.0, 5.0, 5.0, 9.0]);
        fill_empty(&mut of_point, &mut errors, 4);
        assert_eq!((of_point, errors), (vec![1, 0, 2, 3], vec![2.0, 0.0, 0.0, 9.0]));
        let mut same = vec![0, 0];
        fill_empty(&mut same, &mut [0.0; 2], 2);
        assert_eq!(same, [0, 0], "points without error stay");
    }
}
