use crossbar_ground::names::{did_you_mean, did_you_mean_field, nearest};

const CARDS: [&str; 5] = ["nv20", "r200", "nv25", "r300", "gt200"];

#[test]
fn a_slip_is_understood() {
    for (found, meant) in [("r2000", "r200"), ("R200", "r200"), ("nv2", "nv20"), ("tg200", "gt200"), ("r20", "r200")] {
        assert_eq!(nearest(found, CARDS), Some(meant), "{found}");
    }
}

#[test]
fn what_is_far_from_all_names_means_none() {
    for found in ["", "x", "radeon", "9800", "r2", &"r200".repeat(100_000)] {
        assert_eq!(nearest(found, CARDS), None);
    }
    assert_eq!(did_you_mean("radeon", CARDS), "");
}

#[test]
fn fields_are_read_out_of_the_message() {
    let said = did_you_mean_field("unknown field `fullscreen`, expected one of `primitive`, `full_screen`, `cull`");
    assert_eq!(said, "did you mean `full_screen`? ");
    assert_eq!(did_you_mean_field("missing field `mesh`"), "");
    assert_eq!(did_you_mean_field("unknown field `x`, there are no fields"), "");
}
