//! Label positions of a chart: a column to its right, each label as near as possible to the end of its line.

/// Distance of the centres of neighbouring labels, in pixels.
pub(super) const PITCH: i32 = 19;

/// Converts a number of labels or letters to pixel arithmetic; a drawing has far fewer than the maximum.
pub(super) fn signed(count: usize) -> i32 {
    const MOST: i32 = 100_000;
    i32::try_from(count).unwrap_or(MOST).min(MOST)
}

/// Places labels near the heights at which their lines end, in the same order: at least a pitch apart, between `top`
/// and `bottom` if there is room for all, otherwise downward from `top`.
pub(super) fn spread(wanted: &[i32], [top, bottom]: [i32; 2]) -> Vec<i32> {
    let mut order: Vec<usize> = (0..wanted.len()).collect();
    order.sort_by_key(|&n| (wanted[n], n));
    // Labels that touch move together: a group is centered on the mean of its labels' targets.
    let mut groups: Vec<Group> = Vec::new();
    for &n in &order {
        let mut group = Group { labels: vec![n], first: clamped(wanted[n], 1, [top, bottom]) };
        while let Some(above) = groups.pop_if(|above| above.end() > group.first) {
            group = above.joined(group, wanted, [top, bottom]);
        }
        groups.push(group);
    }
    let mut places = vec![0; wanted.len()];
    for group in groups {
        for (n, place) in group.labels.iter().zip((0..).map(|k| group.first + k * PITCH)) {
            places[*n] = place;
        }
    }
    places
}

struct Group {
    labels: Vec<usize>,
    first: i32,
}

impl Group {
    fn end(&self) -> i32 {
        self.first + signed(self.labels.len()) * PITCH
    }

    fn joined(mut self, below: Self, wanted: &[i32], room: [i32; 2]) -> Self {
        self.labels.extend(below.labels);
        let firsts = self.labels.iter().zip(0..).map(|(n, k)| i64::from(wanted[*n]) - i64::from(k * PITCH));
        let mean = firsts.sum::<i64>().div_euclid(i64::from(signed(self.labels.len())));
        self.first = clamped(mean as i32, self.labels.len(), room);
        self
    }
}

/// Position of a group's first label, clamped so that the group fits.
fn clamped(first: i32, labels: usize, [top, bottom]: [i32; 2]) -> i32 {
    first.min(bottom - (signed(labels) - 1) * PITCH).max(top)
}
