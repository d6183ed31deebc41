//! Points in groups of near ones, found once for a signal: what holds of a group's center holds of its points, up to
//! their distance from it.

use super::estimate::LANES;
use super::products::Packed;

/// Added to each distance from a center, for the rounding of points to f32; points have at most length 1.
const ROUNDED: f64 = 1.0 / (1u64 << 22) as f64;

/// All points in groups of [`LANES`]; the last group may have fewer.
#[derive(Debug)]
pub(super) struct Groups {
    /// Group by group the numbers of the points.
    order: Vec<u32>,
    points: Packed<f32, LANES>,
    centers: Packed<f32, LANES>,
    /// Upper bound of the distance of each point from the center of its group, in the same order.
    distances: Vec<f32>,
}

/// One of [`Groups`].
#[derive(Clone, Copy, Debug)]
pub(super) struct PointGroup<'a> {
    /// The numbers of the points.
    pub(super) order: &'a [u32],
    /// The points side by side.
    pub(super) points: &'a [[f32; LANES]],
    /// Upper bound of the distance of each from the center.
    pub(super) distances: &'a [f32],
}

impl Groups {
    /// Groups of points of `dimension` numbers, one after another, none longer than 1.
    pub(super) fn new(values: &[f32], dimension: usize) -> Self {
        let point = |at: u32| &values[at as usize * dimension..][..dimension];
        let mut order: Vec<u32> = (0..(values.len() / dimension) as u32).collect();
        bisect(&mut order, dimension, &point);
        let mut distances = Vec::with_capacity(order.len());
        let centers = Packed::new(order.len().div_ceil(LANES), dimension, |group, into| {
            let members = order[group * LANES..].iter().take(LANES);
            let mut mean = vec![0.0; dimension];
            for &member in members.clone() {
                mean.iter_mut().zip(point(member)).for_each(|(sum, &value)| *sum += f64::from(value));
            }
            let count = members.len() as f64;
            into.iter_mut().zip(&mean).for_each(|(into, sum)| *into = (sum / count) as f32);
            distances.extend(members.map(|&member| {
                let differences = point(member).iter().zip(&*into).map(|(&x, &c)| f64::from(x) - f64::from(c));
                let square: f64 = differences.map(|difference| difference * difference).sum();
                ((square.sqrt() + ROUNDED) as f32).next_up()
            }));
        });
        let points = Packed::new(order.len(), dimension, |at, into| into.copy_from_slice(point(order[at])));
        Self { order, points, centers, distances }
    }

    /// The groups, [`LANES`] or fewer at a time, with their centers side by side.
    pub(super) fn batches(&self) -> impl ExactSizeIterator<Item = (&[[f32; LANES]], Vec<PointGroup<'_>>)> {
        let groups = self.points.groups().zip(self.order.chunks(LANES)).zip(self.distances.chunks(LANES));
        let mut groups = groups.map(|((points, order), distances)| PointGroup { order, points, distances });
        self.centers.groups().map(move |centers| (centers, groups.by_ref().take(LANES).collect()))
    }
}

/// Orders points so that those of a group are near each other: halves them at the median of the component that varies
/// most, and each half again.
fn bisect<'a>(order: &mut [u32], dimension: usize, point: &impl Fn(u32) -> &'a [f32]) {
    if order.len() <= LANES {
        return;
    }
    let (mut sums, mut squares) = (vec![0.0; dimension], vec![0.0; dimension]);
    for &at in &*order {
        for ((sum, square), &value) in sums.iter_mut().zip(&mut squares).zip(point(at)) {
            *sum += f64::from(value);
            *square += f64::from(value) * f64::from(value);
        }
    }
    let spread = |j: usize| squares[j] - sums[j] * sums[j] / order.len() as f64;
    let widest = (0..dimension).max_by(|&a, &b| spread(a).total_cmp(&spread(b))).unwrap_or(0);
    let half = order.len().div_ceil(LANES) / 2 * LANES;
    order.select_nth_unstable_by(half, |&a, &b| point(a)[widest].total_cmp(&point(b)[widest]).then(a.cmp(&b)));
    let (low, high) = order.split_at_mut(half);
    bisect(low, dimension, point);
    bisect(high, dimension, point);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::synthetic::torus_signal;

    #[test]
    fn groups_have_every_point_once_and_near_its_center() {
        for (points, dimension) in [(1, 3), (16, 3), (17, 1), (1000, 5)] {
            let signal = torus_signal(points, dimension, 4);
            let values: Vec<f32> = signal.values().iter().map(|value| value / 16.0).collect();
            let groups = Groups::new(&values, dimension);
            let (mut seen, mut far) = (Vec::<u32>::new(), 0.0_f32);
            for (centers, batch) in groups.batches() {
                for (at, group) in batch.iter().enumerate() {
                    for (lane, (&point, &distance)) in group.order.iter().zip(group.distances).enumerate() {
                        let found: Vec<f32> = group.points.iter().map(|values| values[lane]).collect();
                        assert_eq!(found, values[point as usize * dimension..][..dimension]);
                        let square: f32 = found.iter().zip(centers).map(|(x, c)| (x - c[at]) * (x - c[at])).sum();
                        assert!(square.sqrt() <= distance * 1.0001, "{square} and {distance}");
                        far = far.max(distance);
                    }
                    seen.extend(group.order);
                }
            }
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..points as u32));
            assert!(points != 1000 || far < 0.06, "{far}");
        }
    }

    #[test]
    fn equal_points_are_their_center() {
        let groups = Groups::new(&[0.25; 3 * 100], 3);
        assert!(groups.distances.iter().all(|&distance| distance < 3e-7));
    }
}
