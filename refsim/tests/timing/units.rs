//! Clocks and time.

use refsim::timing::{Hertz, Picoseconds};

#[test]
fn time_is_rounded_up_once() {
    let r200 = Hertz::new(275_000_000).expect("not 0");
    // 1 / 275 MHz = 3636.36... ps
    assert_eq!(r200.time_of(1), Picoseconds(3637));
    assert_eq!(r200.time_of(11), Picoseconds(40_000));
    assert_eq!(r200.time_of(0), Picoseconds::ZERO);
    assert_eq!(Hertz::new(1).expect("not 0").time_of(u64::MAX), Picoseconds(u64::MAX));
    assert_eq!(Hertz::new(0), None);
}

#[test]
fn time_never_wraps() {
    let (early, late) = (Picoseconds(3), Picoseconds(5));
    assert_eq!(early.until(late), Picoseconds(2));
    assert_eq!(late.until(early), Picoseconds::ZERO);
    assert_eq!(Picoseconds(u64::MAX) + early, Picoseconds(u64::MAX));
}
