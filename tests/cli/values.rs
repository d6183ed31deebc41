//! Values of options with their own syntax: valid ones are accepted, invalid ones refused.

use clap::error::ErrorKind;

/// Returns whether the program's parser accepts a command line whose last word is `value`.
fn takes(command: &str, value: &str) -> bool {
    let words = command.split(' ').chain([value]);
    match crossbar::cli::program().try_get_matches_from(["crossbar"].into_iter().chain(words)) {
        Ok(_) => true,
        Err(error) => {
            assert_eq!(error.kind(), ErrorKind::ValueValidation, "{command} {value}: {error}");
            false
        }
    }
}

#[test]
fn values_are_read_and_bad_ones_refused() {
    let rows: Vec<String> = (0..=102).map(|rows| rows.to_string()).collect();
    let square_or_less = |rows: &&String| {
        let rows: u32 = rows.parse().expect("a number");
        (1..=10).any(|order: u32| rows == order * order || (order > 1 && rows + 1 == order * order))
    };
    let (good_rows, bad_rows): (Vec<&String>, Vec<&String>) = rows.iter().partition(square_or_less);
    let words = |text: &'static str| text.split(' ').collect::<Vec<&str>>();
    let of = |rows: Vec<&'static str>, bad: &[&'static str]| [rows, bad.to_vec()].concat();
    let cases: [(&str, Vec<&str>, Vec<&str>); 5] = [
        (
            "cpca render x.npz --model m.obj --light",
            words("constant constant:1,2,3 disk:0,0,1:30:2,1,0 disk:-1,0,2:180 sky:1,-1,1 red-and-blue probe.hdr"),
            of(
                words("disk disk:0,0,0:30 disk:0,0,1:181 disk:0,0,1:0 constant:-1,0,0 sky:1 sky:nan,0,1 sky:0,0,0"),
                &["", "red-and-blue:1"],
            ),
        ),
        (
            "subsurface m.obj --mm-per-unit 1 --light",
            words(
                "ambient:1,0.5,0 directional:0,0,1:1,1,1 point:0,-1,2:3,3,3 point:0,-1,2:3,3,3:1,0,0 probe.hdr constant \
                 disk:0,0,1:30 sky:1,0,1 red-and-blue",
            ),
            words(
                "ambient ambient:1,2 ambient:-1,0,0 ambient:inf,0,0 sky:1 directional:0,0,0:1,1,1 sun:1,1,1 \
                 point:1,1,1:1,1,1:0,0,0 disk:0,0,0:30 constant:-1,0,0",
            ),
        ),
        ("subsurface m.obj --mm-per-unit 1 --sigma-a 1 --sigma-s", words("2 1,2,3 0"), words("-1 1,2 nan inf")),
        (
            "cpca precompute m.obj --out x.npz --brdf",
            words("lambert:0.5 phong:0.1,0.5,20 ward:0.1,0.3,0.1,0.4 ashikhmin-shirley:0.1,0.5,9,99"),
            words("lambert lambert:2 lambert:0.1,0.2 phong:0.1,0.5,nan ward:0,1,0,0.1 mirror:1"),
        ),
        ("cpca precompute m.obj --out x.npz --tangents", words("any texture 0,0,2 0.1,0,1"), words("0,0,0 some 1,2")),
    ];
    for (command, good, bad) in cases {
        for value in good {
            assert!(takes(command, value), "{command} {value}");
        }
        for value in bad {
            assert!(!takes(command, value), "{command} {value}");
        }
    }
    let command = "cpca precompute m.obj --kind glossy --out x.npz --rows";
    assert!(good_rows.iter().all(|rows| takes(command, rows)), "{good_rows:?}");
    assert!(bad_rows.iter().all(|rows| !takes(command, rows)) && !takes(command, "-1") && !takes(command, ""));
}
