//! Tests how a draw is divided into pieces, which workers take from both ends.

#[path = "../../src/exec/batch/tile/pieces.rs"]
mod division;

use division::{PIECE, Pieces};

#[test]
fn pieces_from_both_ends_are_all_of_them() {
    let order: Vec<u32> = (0..3 * PIECE as u32 + 5).collect();
    let pieces = Pieces::new(&order, 2);
    let ([front, then], back) = ([pieces.first(), pieces.first()], [pieces.last(), pieces.last(), pieces.last()]);
    assert_eq!(front, Some((0, &order[..PIECE])));
    assert_eq!(back, [Some((3, &order[3 * PIECE..])), Some((2, &order[2 * PIECE..3 * PIECE])), None]);
    assert_eq!((then, pieces.first()), (Some((1, &order[PIECE..2 * PIECE])), None));
    assert_eq!(Pieces::new(&order, 1).first(), Some((0, &order[..])));
    assert_eq!(Pieces::new(&[], 1).first(), None);
    assert_eq!([2, 9].map(|workers| Pieces::workers(&order, workers)), [2, 3]);
}
