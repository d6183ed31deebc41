//! Speed of the emulated cards: criterion on modelled time.
//!
//! `cargo bench -p crossbar-benches --bench modelled`. The measure is picoseconds of the card, so all samples are equal
//! on every machine, and any change is a change of the model. (Criterion's confidence intervals are single points.) The
//! timed work is what `crossbar reproduce` draws, with the printed figure in each name; for other work, see `crossbar
//! timeline`.

use criterion::{BenchmarkId, Criterion};
use crossbar::study::reproduce::timed;
use refsim_criterion::ModelledTime;

/// Times a unit of work of each system. Printed: 114 M intersections per second on the Radeon 8500; 29.7 Jacobi
/// iterations per second; 1.8, 13.4 and 1.1 ms for the three passes on the head at 512 x 512; frames per second of
/// systems 4 to 6: the bird 45.3, the glossy bunny 5.0, a view of the bunny 97.0 in Table I and 277.9 in Table II.
fn systems(criterion: &mut Criterion<ModelledTime>) {
    let mut group = criterion.benchmark_group("systems");
    for work in timed().expect("the cards take the work") {
        let id = BenchmarkId::new(format!("{} on {}", work.figure, work.device), format!("printed {}", work.printed));
        ModelledTime::measure(&mut group, id, work.items, work.time);
    }
    group.finish();
}

fn main() {
    let mut criterion = ModelledTime::criterion();
    systems(&mut criterion);
    criterion.final_summary();
}
