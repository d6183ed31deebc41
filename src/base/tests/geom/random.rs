use approx::assert_abs_diff_eq;
use crossbar_base::geom::random::CounterRng;

#[test]
fn numbers_are_fixed_and_spread() {
    let stream = CounterRng::new(1);
    assert_eq!(stream.bits(3, 4, 5), CounterRng::new(1).bits(3, 4, 5));
    assert_ne!(stream.bits(3, 4, 5), stream.bits(4, 3, 5));
    assert_ne!(stream.bits(3, 4, 5), stream.bits(3, 5, 4));
    let mean = (0..4096).map(|index| stream.unit(index, 0, 0)).sum::<f64>() / 4096.0;
    assert_abs_diff_eq!(mean, 0.5, epsilon = 0.02);
    let mut halves = [0; 2];
    for sample in 0..4096 {
        halves[usize::from(stream.unit(7, sample, 1) < 0.5)] += 1;
    }
    assert!(halves.iter().all(|&count| count > 1900), "{halves:?}");
}
